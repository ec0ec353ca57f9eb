#!/usr/bin/env python3
"""Plants a fault that no compiler warning sees, and expects tidy.py to stop on it; and on a source it cannot see."""

import json
import pathlib
import shutil
import subprocess
import sys
import unittest

from planted import Planted

HERE = pathlib.Path(__file__).parent


class Tidy(Planted):
    def setUp(self):
        super().setUp()
        shutil.copy(HERE.parents[1] / ".clang-tidy", self.root)
        (self.root / "hal").mkdir()
        self.source = self.root / "hal/a.cpp"
        self.describe([self.source])

    def describe(self, files):
        entries = [{"directory": str(self.root), "command": f"g++ -std=c++20 -Wno-restrict -c {f}", "file": str(f)} for f in files]
        (self.root / "compile_commands.json").write_text(json.dumps(entries))

    def run_tidy(self, folder="hal"):
        command = [sys.executable, "-B", str(HERE / "tidy.py"), str(self.root), str(self.root / folder)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout

    def test_clean_code_passes(self):
        self.source.write_text("int half(int x) { return x / 2; }\n")
        self.assertEqual(self.run_tidy(), (0, "1 sources checked, 0 with faults\n"))

    def test_a_planted_fault_is_found(self):
        self.source.write_text("double half(int x) { return x / 2; }\n")
        status, output = self.run_tidy()
        self.assertEqual(status, 1)
        self.assertIn("a.cpp:1:", output)
        self.assertIn("bugprone-integer-division", output)

    def test_recursion_is_found(self):
        self.source.write_text("int fact(int x) { return x < 2 ? 1 : x * fact(x - 1); }\n")
        self.assertIn("misc-no-recursion", self.run_tidy()[1])

    def test_a_fault_is_found_where_sources_are_compiled_together(self):
        self.source.write_text("double half(int x) { return x / 2; }\n")
        unit = self.root / "Unity/unity_0_cxx.cxx"
        unit.parent.mkdir()
        unit.write_text(f'#include "{self.source}"\n')
        self.describe([unit])
        status, output = self.run_tidy()
        self.assertEqual(status, 1)
        self.assertIn("a.cpp:1:", output)

    def test_a_source_that_is_not_built_is_found(self):
        self.source.write_text("")
        self.describe([])
        status, output = self.run_tidy()
        self.assertEqual(status, 1)
        self.assertIn("not in the compile database", output)

    def test_nothing_to_check_is_a_fault(self):
        self.assertEqual(self.run_tidy("gone")[0], 1)


if __name__ == "__main__":
    unittest.main()
