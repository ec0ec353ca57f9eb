#!/usr/bin/env python3
"""Gives toolchain/matrix programs that agree, differ, fail or say too little, in the place of real builds."""

import pathlib
import subprocess
import unittest

from planted import Planted

MATRIX = pathlib.Path(__file__).parents[2] / "toolchain/matrix"


class Matrix(Planted):
    def compare(self, *scripts, lines=2):
        command = [str(MATRIX), "--only", "none", "--lines", str(lines)]
        for number, script in enumerate(scripts):
            program = self.root / f"probe{number}"
            program.write_text(f"#!/bin/sh\n{script}\n")
            program.chmod(0o755)
            command += ["--with", f"build{number}={program}"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def test_equal_lines_pass(self):
        same = "echo trig 1; echo replay 2"
        status, output = self.compare(same, same, same)
        self.assertEqual(status, 0)
        self.assertIn("3 builds print the same 2 lines", output)

    def test_one_different_line_is_shown(self):
        status, output = self.compare("echo trig 1; echo replay 2", "echo trig 1; echo replay 3")
        self.assertEqual(status, 1)
        self.assertIn("-replay 2\n+replay 3\n", output)
        self.assertIn("1 of 2 builds differ from build0", output)

    def test_a_missing_line_is_a_difference(self):
        self.assertEqual(self.compare("echo a; echo b; echo c", "echo a; echo b")[0], 1)

    def test_too_few_lines_are_a_fault(self):
        status, output = self.compare("echo trig 1", "echo trig 1")
        self.assertEqual(status, 1)
        self.assertIn("1 lines printed, 2 expected", output)

    def test_one_build_alone_compares_nothing(self):
        status, output = self.compare("echo a; echo b")
        self.assertEqual(status, 1)
        self.assertIn("nothing was compared", output)

    def test_a_failing_program_is_a_fault(self):
        self.assertEqual(self.compare("echo a; echo b", "echo a; echo b; exit 3")[0], 1)

    def test_unknown_builds_and_bad_usage_are_refused(self):
        for arguments in (["--only", "msvc-O9", "--lines", "1", "x"], ["x"], ["--lines", "0", "x"], ["--lines", "1"]):
            self.assertNotEqual(subprocess.run([MATRIX, *arguments], capture_output=True, check=False).returncode, 0)


if __name__ == "__main__":
    unittest.main()
