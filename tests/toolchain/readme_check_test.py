#!/usr/bin/env python3
"""A small tree with a README that is true, then with one fault of each kind."""

import pathlib
import tempfile
import unittest

from readme_check import PROMISE, check

README = """# X
    toolchain/never_checked in a listing
See `hal/a.hpp`, then `b.hpp`; [more](host/share/doc/live.md), `live.md`. Not a path: `X/Y`, `-f a/b`.

## Ten minutes of reading
1. `hal/a.hpp`: they include 1 more.

| paper | in words | code | test |
|---|---|---|---|
| II | words | `recon::carve` | `Carve.*`, `table.reaches`, `toolchain/long drift` |
"""
ROBUSTNESS = """| what was done | test |
|---|---|
| zeros | `Carve.Cuts` |
"""
TREE = {
    "README.md": README,
    "host/share/doc/robustness.md": ROBUSTNESS,
    "host/share/doc/safety.md": PROMISE.replace(" does", "\n  does"),
    "hal/a.hpp": '#include "hal/b.hpp"\n',
    "hal/b.hpp": "",
    "host/share/doc/live.md": "",
    "firmware/recon/models/carve.hpp": "void carve();",
    "tests/carve_test.cpp": "TEST(Carve, Cuts) {}\n",
    "tests/CMakeLists.txt": "add_test(NAME table.reaches\n  COMMAND x)\n",
    "toolchain/long": "part_drift() {\n",
}
FAULTS = [
    ("See `hal/a.hpp`", "See `hal/gone.hpp`", "README.md:3: there is no hal/gone.hpp"),
    ("`b.hpp`", "`c.hpp`", "README.md:3: there is no host/share/doc/c.hpp"),
    ("(host/share/doc/live.md)", "(host/share/doc/gone.md)", "README.md:3: there is no host/share/doc/gone.md"),
    ("include 1 more", "include 0 more", "README.md: the reading path includes 1 more headers, at most 8: hal/b.hpp"),
    ("include 1 more", "include all", "README.md: no reading path that says how many more headers it includes"),
    ("`recon::carve`", "`recon::cut`", "README.md:10: recon::cut is declared nowhere"),
    ("`Carve.*`", "`Carver.*`", "README.md:10: no test is called Carver.*"),
    ("`table.reaches`", "`table.fails`", "README.md:10: no test is called table.fails"),
    ("long drift", "long walk", "README.md:10: toolchain/long has no part walk"),
]


class ReadmeCheck(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        for name, text in TREE.items():
            path = self.root / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(text)

    def test_a_true_one_has_no_faults_and_was_compared(self):
        self.assertEqual(check(self.root), ([], 12))

    def test_the_promise_must_stand_there(self):
        (self.root / "host/share/doc/safety.md").write_text("No alert never means that the way is free.")
        self.assertEqual(check(self.root)[0], [f"host/share/doc/safety.md: it does not say: {PROMISE}"])

    def test_each_planted_fault_is_found_where_it_is(self):
        for there, instead, expected in FAULTS:
            with self.subTest(instead=instead):
                self.assertEqual(README.count(there), 1)
                (self.root / "README.md").write_text(README.replace(there, instead))
                self.assertIn(expected, check(self.root)[0])


if __name__ == "__main__":
    unittest.main()
