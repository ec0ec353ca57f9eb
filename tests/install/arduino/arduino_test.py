#!/usr/bin/env python3
"""usage: arduino_test.py SOURCE_FOLDER rules|PART
       arduino_test.py SOURCE_FOLDER desk CXX LIBFENCEPOST_CORE

The library for Arduino. rules: the registry's rules, and that each of them is checked. desk: the examples on the desk,
in a world. PART: the library and the examples for one such as cortex-m4/fpv4-sp-d16-hard, in place of a board's core.
"""

import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv[1]).resolve()
sys.path.insert(0, str(SOURCE / "toolchain/arduino"))
import check  # noqa: E402
import package  # noqa: E402

HERE = pathlib.Path(__file__).parent
WARNINGS = ["-Wall", "-Wextra", "-Werror", "-Wno-psabi"]
SECONDS = 60  # of one processor, for the whole library: what a first sketch takes
# (flash, RAM) of a small board of the kind: Arduino Zero, Feather M4, Portenta H7, an STM32U5's.
ROOM = {"cortex-m0plus": (256 << 10, 32 << 10), "cortex-m4": (512 << 10, 192 << 10), "cortex-m7": (1 << 20, 512 << 10),
        "cortex-m33": (512 << 10, 256 << 10)}


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False)
    assert done.returncode == 0, f"{command}\nexit {done.returncode}\n{done.stdout}\n{done.stderr}"
    return done.stdout


def sketch_in(folder, example):
    """The source that Arduino makes of a sketch: it begins with the core's header."""
    source = folder / f"{example.stem}.cpp"
    source.write_text(f'#include <Arduino.h>\n#line 1 "{example.name}"\n' + example.read_text(encoding="utf-8"))
    return source


class Library(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)
        self.library = self.root / "Fencepost"
        package.write_library(SOURCE, self.library)
        self.examples = sorted((self.library / "examples").glob("*/*.ino"))
        self.assertGreaterEqual(len(self.examples), 2)


class Rules(Library):
    def test_library_has_no_faults(self):
        self.assertEqual(check.faults_of(self.library), [])

    def edit(self, name, old, new):
        path = self.library / name
        text = path.read_text(encoding="utf-8")
        self.assertIn(old, text)
        path.write_text(text.replace(old, new), encoding="utf-8")

    def test_each_planted_fault_is_found(self):
        properties = "library.properties"
        plants = {
            "a link": lambda: (self.library / "src/x.h").symlink_to("Fencepost.h"),
            "nothing of this kind": lambda: (self.library / "extras/tool.exe").write_text(""),
            "characters that a file": lambda: (self.library / "src/a b.h").write_text(""),
            "nothing of this name": lambda: (self.library / ".development").write_text(""),
            "LICENSE is missing": lambda: (self.library / "LICENSE").unlink(),
            "no sketch of its name": lambda: (self.library / "examples/Other").mkdir(),
            "says arduino or library": lambda: self.edit(properties, "name=Fencepost", "name=FencepostLibrary"),
            "is not MAJOR": lambda: self.edit(properties, "version=", "version=v"),
            "category": lambda: self.edit(properties, "category=Sensors", "category=Robots"),
            "author is missing": lambda: self.edit(properties, "author=The Fencepost authors\n", ""),
            "architectures": lambda: self.edit(properties, "architectures=*", "architectures=SAMD AVR"),
            "which is not in src": lambda: self.edit(properties, "includes=Fencepost.h", "includes=Fence.h"),
            "no field is called": lambda: self.edit(properties, "url=", "urls="),
            "precompiled is": lambda: self.edit(properties, "precompiled=full", "precompiled=yes"),
            "keywords.txt:": lambda: self.edit("keywords.txt", "Camera\tKEYWORD1", "Camera KEYWORD1"),
            "version is not that": lambda: self.edit("library.json", '"version": "', '"version": "1'),
            "bytes: at most": lambda: (self.library / "extras/large").write_bytes(bytes(check.MOST_BYTES)),
        }
        whole = shutil.copytree(self.library, self.root / "whole")
        for says, plant in plants.items():
            with self.subTest(says):
                plant()
                faults = check.faults_of(self.library)
                self.assertTrue(any(says in fault for fault in faults), faults)
            shutil.rmtree(self.library)
            shutil.copytree(whole, self.library)

    def test_two_zips_are_the_same_bytes(self):
        for name in ("a", "b"):
            package.write_zip(self.library, "Fencepost", self.root / name)
        self.assertEqual((self.root / "a").read_bytes(), (self.root / "b").read_bytes())

    def test_keywords_are_of_the_header(self):
        header = (self.library / "src/firmware/fencepost/fencepost.hpp").read_text(encoding="utf-8")
        for line in (self.library / "keywords.txt").read_text(encoding="utf-8").splitlines():
            if not line.startswith("#"):
                self.assertRegex(header, rf"\b{line.split(chr(9))[0]}\b")


class Desk(Library):
    """With the library of this build: what it computes does not depend on how it was packed."""

    def test_examples_stop_before_the_box(self):
        for example in self.examples:
            program = self.root / example.stem
            run(sys.argv[3], "-std=gnu++11", *WARNINGS, "-I", HERE / "core", "-I", self.library / "src", sketch_in(self.root, example),
                HERE / "world.cpp", sys.argv[4], "-o", program)
            said = run(program).splitlines()
            levels = list(dict.fromkeys(line.split()[0] for line in said if line[:1].isupper()))
            self.assertEqual(levels[-3:], ["NOTICE", "WARN", "STOP"], said)
            self.assertRegex("\n".join(said), r"STOP    red  0\.[23]\d m")
            if example.stem == "StopBeforeABox":
                self.assertRegex(said[-1], r"^0\.[23]\d m before the box$")


class Part(Library):
    def test_library_and_examples(self):
        part = sys.argv[2]
        flags = package.PARTS[part]
        archive = self.library / "src" / part / "libFencepost.a"
        begun = resource.getrusage(resource.RUSAGE_CHILDREN)
        package.compile_part(self.library, [*flags, *WARNINGS], archive)
        ended = resource.getrusage(resource.RUSAGE_CHILDREN)
        seconds = ended.ru_utime + ended.ru_stime - begun.ru_utime - begun.ru_stime
        print(f"{part}: the library takes {seconds:.0f} s")
        self.assertLess(seconds, SECONDS)
        for example in self.examples:
            program = self.root / (example.stem + ".elf")
            run("arm-none-eabi-g++", *flags, "-mthumb", "-std=gnu++11", "-Os", "-fno-exceptions", "-fno-rtti", "-ffunction-sections",
                "-fdata-sections", *WARNINGS, "-I", HERE / "core", "-I", self.library / "src", sketch_in(self.root, example),
                HERE / "board.cpp", archive, "--specs=nano.specs", "--specs=nosys.specs", "-Wl,--gc-sections", "-o", program)
            flash, ram = self.sizes(program)
            print(f"{part}: {example.stem} takes {flash} bytes of flash, {ram} of RAM")
            self.assertLess(flash, ROOM[part.split("/")[0]][0])
            self.assertLess(ram + 4096, ROOM[part.split("/")[0]][1], "with its stack")
            heap = re.findall(r"\b(?:malloc|_malloc_r|_Znwj|free)\b", run("arm-none-eabi-nm", "-C", archive))
            self.assertEqual(heap, [])

    @staticmethod
    def sizes(program):
        text, data, bss = (int(n) for n in run("arm-none-eabi-size", program).splitlines()[1].split()[:3])
        return text + data, data + bss


if __name__ == "__main__":
    CASE = {"rules": Rules, "desk": Desk}.get(sys.argv[2], Part)
    RESULT = unittest.TextTestRunner().run(unittest.defaultTestLoader.loadTestsFromTestCase(CASE))
    sys.exit(0 if RESULT.wasSuccessful() else 1)
