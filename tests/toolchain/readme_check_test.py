#!/usr/bin/env python3
"""A small tree with a README that is true, then with one fault of each kind."""

import pathlib
import tempfile
import unittest

from readme_check import check

README = """# X
    toolchain/never_checked in a listing
See `hal/a.hpp`, then `b.hpp`; [more](host/share/doc/live.md), `live.md`. Not a path: `X/Y`, `-f a/b`.

| paper | in words | code | test |
|---|---|---|---|
| II | words | `recon::carve` | `Carve.*`, `table.reaches`, `toolchain/long drift` |
"""
TREE = {
    "README.md": README,
    "hal/a.hpp": "",
    "hal/b.hpp": "",
    "host/share/doc/live.md": "",
    "firmware/recon/models/carve.hpp": "void carve();",
    "tests/carve_test.cpp": "TEST(Carve, Cuts) {}\n",
    "tests/CMakeLists.txt": "add_test(NAME table.reaches\n  COMMAND x)\n",
    "toolchain/long": "part_drift() {\n",
}
FAULTS = [
    ("`hal/a.hpp`", "`hal/gone.hpp`", "README.md:3: there is no hal/gone.hpp"),
    ("`b.hpp`", "`c.hpp`", "README.md:3: there is no host/share/doc/c.hpp"),
    ("(host/share/doc/live.md)", "(host/share/doc/gone.md)", "README.md:3: there is no host/share/doc/gone.md"),
    ("`recon::carve`", "`recon::cut`", "README.md:7: recon::cut is declared nowhere"),
    ("`Carve.*`", "`Carver.*`", "README.md:7: no test is called Carver.*"),
    ("`table.reaches`", "`table.fails`", "README.md:7: no test is called table.fails"),
    ("long drift", "long walk", "README.md:7: toolchain/long has no part walk"),
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
        self.assertEqual(check(self.root), ([], 8))

    def test_each_planted_fault_is_found_where_it_is(self):
        for there, instead, expected in FAULTS:
            with self.subTest(instead=instead):
                self.assertEqual(README.count(there), 1)
                (self.root / "README.md").write_text(README.replace(there, instead))
                self.assertIn(expected, check(self.root)[0])


if __name__ == "__main__":
    unittest.main()
