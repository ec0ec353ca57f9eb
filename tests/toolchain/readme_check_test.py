#!/usr/bin/env python3
"""A small tree whose pages are true, then with one fault of each kind."""

import unittest

from readme_check import ARCHITECTURE, EQUATIONS, INDEX, PAPER, PROMISE, README_LINES, SETTINGS, ZONES, check
from planted import Planted

SAFETY = "host/share/doc/safety.md"
TREE = {
    "README.md": """# X
    toolchain/never_checked in a listing
See `hal/a.hpp`, then `b.hpp`; [more](host/share/doc/live.md). Not a path: `X/Y`, `-f a/b`, [far](https://x.y/z.md).
""",
    INDEX: """# Documentation
[live](live.md), [code](architecture.md), [paper](paper_to_code.md), [safe](safety.md), [a](../../../hal/a.hpp)
""",
    ARCHITECTURE: """# Code
## Ten minutes of reading
1. `hal/a.hpp`: they include 1 more, `live.md`.
""",
    PAPER: """# Paper
| paper | in words | code | test |
|---|---|---|---|
| II | words | `recon::carve` | `Carve.*`, `table.reaches`, `toolchain/long drift` |
""",
    "tests/results/robustness.md": """| what was done | test |
|---|---|
| zeros | `Carve.Cuts` |
""",
    SAFETY: PROMISE.replace(" does", "\n  does"),
    EQUATIONS: "    sigma < kGate, `firmware/recon/models/carve.hpp`\nBelow `kGate`.\n",
    "hal/a.hpp": '#include "hal/b.hpp"\n',
    "hal/b.hpp": "",
    "host/share/doc/live.md": "# How it `runs`, now\n[up](#how-it-runs-now) [paper](paper_to_code.md#paper) `[code](nowhere)`\n",
    ZONES: "alert.stop: 0.25 m, alert.warn: 0.5 m, alert.notice: 1 m",
    SETTINGS: '{"alert.stop", "m", 2, 25}, {"alert.warn", "m", 2, 50}, {"alert.notice", "m", 2, 100}',
    "firmware/recon/models/carve.hpp": "void carve();\ninline constexpr float kGate = 3.0F;\n",
    "tests/carve_test.cpp": "TEST(Carve, Cuts) {}\n",
    "tests/CMakeLists.txt": "add_test(NAME table.reaches\n  COMMAND x)\n",
    "toolchain/long": "part_drift() {\n",
}
FAULTS = [
    ("README.md", "See `hal/a.hpp`", "See `hal/gone.hpp`", "README.md:3: there is no hal/gone.hpp"),
    ("README.md", "`b.hpp`", "`c.hpp`", "README.md:3: there is no host/share/doc/c.hpp"),
    ("README.md", "(host/share/doc/live.md)", "(host/share/doc/gone.md)", "README.md:3: there is no host/share/doc/gone.md"),
    ("README.md", "[more](host/share/doc/live.md)", "`host/share/doc/live.md`", "README.md:3: host/share/doc/live.md is no link"),
    ("README.md", "# X\n", "# X\n" * README_LINES, f"README.md: {README_LINES + 2} lines, at most {README_LINES}"),
    ("README.md", "# X", "# X" + "x" * 120, "README.md:1: 123 columns, at most 120"),
    (INDEX, "[live](live.md), ", "", f"{INDEX}: nothing leads to live.md"),
    (INDEX, "[live](live.md)", "[live](alive.md)", f"{INDEX}:2: there is no host/share/doc/alive.md"),
    (ARCHITECTURE, "include 1 more", "include 0 more", f"{ARCHITECTURE}: the reading path includes 1 more headers, at most 8: hal/b.hpp"),
    (ARCHITECTURE, "include 1 more", "include all", f"{ARCHITECTURE}: no reading path that says how many more headers it includes"),
    (PAPER, "`recon::carve`", "`recon::cut`", f"{PAPER}:4: recon::cut is declared nowhere"),
    (PAPER, "`Carve.*`", "`Carver.*`", f"{PAPER}:4: no test is called Carver.*"),
    (PAPER, "`table.reaches`", "`table.fails`", f"{PAPER}:4: no test is called table.fails"),
    (PAPER, "long drift", "long walk", f"{PAPER}:4: toolchain/long has no part walk"),
    (EQUATIONS, "sigma < kGate", "sigma < kFence", f"{EQUATIONS}:1: kFence is declared nowhere"),
    ("host/share/doc/live.md", "#paper", "#papers", "host/share/doc/live.md:2: paper_to_code.md has no heading #papers"),
    ("host/share/doc/live.md", "(#how", "(#now", "host/share/doc/live.md:2: host/share/doc/live.md has no heading #now-it-runs-now"),
    ("host/share/doc/live.md", "paper_to_code", "code_to_paper", "host/share/doc/live.md:2: a link to code_to_paper.md#paper, which is not there"),
    (ZONES, "0.5 m", "0.6 m", f"{ZONES}: it does not say: alert.warn: 0.5 m"),
    (SETTINGS, "100", "80", f"{ZONES}: it does not say: alert.notice: 0.8 m"),
    (SAFETY, PROMISE.replace(" does", "\n  does"), "No alert never means that the way is free.", f"{SAFETY}: it does not say: {PROMISE}"),
]


class ReadmeCheck(Planted):
    FILES = TREE

    def test_true_ones_have_no_faults_and_were_compared(self):
        self.assertEqual(check(self.root), ([], 30))

    def test_each_planted_fault_is_found_where_it_is(self):
        for name, there, instead, expected in FAULTS:
            with self.subTest(instead=instead):
                self.assertEqual(TREE[name].count(there), 1)
                (self.root / name).write_text(TREE[name].replace(there, instead))
                self.assertIn(expected, check(self.root)[0])
                (self.root / name).write_text(TREE[name])


if __name__ == "__main__":
    unittest.main()
