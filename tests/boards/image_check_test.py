#!/usr/bin/env python3
"""usage: image_check_test.py IMAGE BUILD_DIR SIZES.csv SCRIPT.ld

The check of an image can fail, and so can its link: each fault is planted and has to be reported.
"""

import csv
import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).with_name("image_check.py")
TOP = pathlib.Path(__file__).resolve().parents[2]
IMAGE, BUILD, TABLE, SCRIPT = sys.argv[1:5]

PROGRAM = """
extern "C" void* malloc(unsigned);
extern "C" void reset_handler() { %s for (;;) {} }
extern "C" [[gnu::section(".vectors"), gnu::used]] void (*const table[])() = {reset_handler};
"""


class ImageCheck(unittest.TestCase):
    def check(self, **changes):
        row = next(row for row in csv.DictReader(pathlib.Path(TABLE).read_text().splitlines()) if row["image"] == IMAGE)
        with tempfile.TemporaryDirectory() as folder:
            table = pathlib.Path(folder, "sizes.csv")
            with table.open("w", encoding="utf-8") as file:
                writer = csv.DictWriter(file, row.keys())
                writer.writeheader()
                writer.writerow({**row, **changes})
            done = subprocess.run([sys.executable, "-B", str(CHECK), IMAGE, BUILD, str(table)], capture_output=True,
                                  text=True, check=False)
            return done.returncode, done.stdout + done.stderr

    def test_growth_is_seen(self):
        self.assertEqual(self.check()[0], 0)
        for name in ("flash", "ram", "stack"):
            code, output = self.check(**{name: 100})
            self.assertEqual(code, 1)
            self.assertRegex(output, f"{name}: \\d+ bytes, 100 in ")

    def test_an_unknown_image_is_no_success(self):
        self.assertNotEqual(self.check(image="other")[0], 0)

    def test_banned_symbols_are_seen(self):
        sys.path.insert(0, str(CHECK.parent))
        import image_check
        for name in ("snprintf", "sinf", "__cxa_guard_acquire", "malloc", "operator new(unsigned int)"):
            self.assertTrue(any(p.match(name) for p in image_check.symbol_check.BANNED.values()), name)

    def link(self, body):
        with tempfile.TemporaryDirectory() as folder:
            source = pathlib.Path(folder, "x.cpp")
            source.write_text(PROGRAM % body)
            return subprocess.run(["arm-none-eabi-g++", "-mcpu=cortex-m0", "-mthumb", "-nostartfiles", "--specs=nano.specs",
                                   "--specs=nosys.specs", f"-L{TOP}", f"-L{BUILD}/generated", f"-T{SCRIPT}", str(source),
                                   "-o", str(pathlib.Path(folder, "x.elf"))], capture_output=True, text=True, check=False)

    def test_a_heap_does_not_link(self):
        self.assertEqual(self.link("").returncode, 0)
        planted = self.link("*static_cast<volatile char*>(malloc(4)) = 1;")
        self.assertNotEqual(planted.returncode, 0)
        self.assertIn("a heap is linked: malloc", planted.stderr)


unittest.main(argv=sys.argv[:1])
