#!/usr/bin/env python3
"""Plants a badly formatted file, and expects format_check.py to name it."""

import pathlib
import shutil
import subprocess
import sys
import unittest

from planted import Planted

HERE = pathlib.Path(__file__).parent


class FormatCheck(Planted):
    def setUp(self):
        super().setUp()
        shutil.copy(HERE.parents[1] / ".clang-format", self.root)
        (self.root / "hal").mkdir()

    def check(self):
        command = [sys.executable, "-B", str(HERE / "format_check.py"), str(self.root)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout

    def test_formatted_code_passes(self):
        (self.root / "hal/a.hpp").write_text("int half(int x) { return x / 2; }\n")
        self.assertEqual(self.check(), (0, "1 files checked\n"))

    def test_a_badly_formatted_file_is_named(self):
        (self.root / "hal/a.cpp").write_text("int half( int x ){ return x/2; }\n")
        status, output = self.check()
        self.assertEqual(status, 1)
        self.assertIn("hal/a.cpp:1:", output)

    def test_no_files_is_a_fault(self):
        self.assertEqual(self.check()[0], 1)


if __name__ == "__main__":
    unittest.main()
