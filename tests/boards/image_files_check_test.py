#!/usr/bin/env python3
"""usage: image_files_check_test.py BUILD_DIR ADDRESS [KIND...]

image_files_check.py finds each file that was damaged, and each that is missing.
"""

import pathlib
import shutil
import sys
import tempfile
import unittest

import image_files_check

BUILD, ADDRESS, KINDS = pathlib.Path(sys.argv[1]), int(sys.argv[2], 0), sys.argv[3:]


class ImageFiles(unittest.TestCase):
    def faults(self, kind="", change=None, address=ADDRESS):
        """Of a copy in which the bytes of one file were changed."""
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for one in ("elf", "bin", "hex", *KINDS):
                shutil.copy(BUILD / f"fencepost.{one}", folder)
            file = folder / f"fencepost.{kind}"
            if change is None and kind:
                file.unlink()
            elif kind:
                file.write_bytes(change(bytearray(file.read_bytes())))
            return image_files_check.check(folder, address, KINDS)

    def test_as_built_there_is_none(self):
        self.assertEqual(self.faults(), [])

    def test_a_missing_file(self):
        for kind in ("hex", *KINDS):
            self.assertIn(f"there is no fencepost.{kind}", self.faults(kind))

    def test_a_changed_byte(self):
        def flip(data):
            data[610] ^= 1
            return data
        for kind in ("bin", "hex", *KINDS):
            self.assertTrue(self.faults(kind, flip), kind)

    def test_an_end_that_is_missing(self):
        for kind in ("bin", "hex", *KINDS):
            self.assertTrue(self.faults(kind, lambda data: data[:-40]), kind)

    def test_another_address(self):
        self.assertTrue(any("elf" in fault for fault in self.faults(address=ADDRESS + 0x1000)))
        self.assertTrue(any("hex" in fault for fault in self.faults(address=ADDRESS + 0x1000)))


unittest.main(argv=sys.argv[:1])
