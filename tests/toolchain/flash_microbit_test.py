#!/usr/bin/env python3
"""Putting an image onto a micro:bit's drive: it is copied to the generation that it is for, and to no other."""

import pathlib
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "toolchain/cmake/flash_microbit.cmake"
# As the interface chip's firmware writes it: the board's number is the first four digits.
NUMBERS = {1: ["9900", "9901"], 2: ["9903", "9904", "9905", "9906"]}


class FlashMicrobit(unittest.TestCase):
    def flash(self, version, number):
        """(status, what it said, whether the image is on the drive)"""
        with tempfile.TemporaryDirectory() as folder:
            top = pathlib.Path(folder)
            drive = top / "MICROBIT"
            drive.mkdir()
            if number:
                (drive / "DETAILS.TXT").write_text(f"# DAPLink Firmware\r\nUnique ID: {number}360249624e45005160190000003b\r\n")
            (top / "mounts").write_text(f"/dev/sda {drive} vfat rw 0 0\n")
            (top / "fencepost.hex").write_text(":00000001FF\n")
            done = subprocess.run(["cmake", f"-DMOUNTS={top / 'mounts'}", "-DIMAGE=fencepost.hex", f"-DVERSION={version}", "-P",
                                   str(SCRIPT)], cwd=folder, capture_output=True, text=True, check=False)
            return done.returncode, " ".join((done.stdout + done.stderr).split()), (drive / "fencepost.hex").exists()

    def test_it_goes_to_its_own_generation(self):
        for version, numbers in NUMBERS.items():
            for number in numbers:
                self.assertEqual(self.flash(version, number)[::2], (0, True), number)

    def test_it_does_not_go_to_the_other_one(self):
        for version, numbers in NUMBERS.items():
            for number in numbers:
                status, said, there = self.flash(3 - version, number)
                self.assertNotEqual(status, 0, number)
                self.assertIn(f"is a micro:bit v{version}, and fencepost.hex is for a v{3 - version}", said)
                self.assertFalse(there)

    def test_a_drive_that_does_not_say_is_believed(self):
        for number in ("", "9902"):
            self.assertEqual(self.flash(2, number)[::2], (0, True), number)


unittest.main()
