#!/usr/bin/env python3
"""usage: wheel_test.py CC SOURCE_FOLDER BUILD_FOLDER

The wheel of what this build has made: its form, and its structures against the C header. Then package_test.py runs in a
fresh environment that has the wheel and nothing else.
"""
import base64
import csv
import ctypes
import hashlib
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import venv
import zipfile

CC, SOURCE, BUILD = sys.argv[1], *(pathlib.Path(word).resolve() for word in sys.argv[2:4])
HERE = pathlib.Path(__file__).parent
sys.path[:0] = [str(SOURCE / "toolchain"), str(SOURCE / "host/share/python")]
import wheel  # noqa: E402
from fencepost import _interface  # noqa: E402


def run(*command, **more):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **more)
    if done.returncode != 0:
        raise AssertionError(f"{command}\nexit {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def make(folder):
    return pathlib.Path(run(sys.executable, "-B", SOURCE / "toolchain/wheel.py", SOURCE, BUILD, folder).strip())


class Wheel(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.folder.name)
        cls.wheel = make(cls.root / "one")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def test_record_lists_what_is_inside(self):
        with zipfile.ZipFile(self.wheel) as archive:
            names = archive.namelist()
            (record,) = (name for name in names if name.endswith(".dist-info/RECORD"))
            rows = list(csv.reader(archive.read(record).decode().splitlines()))
            self.assertEqual([row[0] for row in rows], names)
            for name, digest, size in rows[:-1]:
                data = archive.read(name)
                made = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip("=")
                self.assertEqual((digest, int(size)), (f"sha256={made}", len(data)), name)
            self.assertEqual(rows[-1], [record, "", ""])
            about = archive.read(record.replace("RECORD", "WHEEL")).decode()
        self.assertIn("Tag: " + self.wheel.stem.split("-", 2)[2], about)
        self.assertIn("fencepost/_install/share/fencepost/page/fencepost.html", names)

    def test_same_bytes_twice(self):
        self.assertEqual(make(self.root / "two").read_bytes(), self.wheel.read_bytes())

    def test_this_build_links_the_systems_libraries_and_says_so(self):
        self.assertRegex(self.wheel.name, r"^fencepost-[\d.]+-py3-none-linux_\w+\.whl$")

    def test_libraries_go_along_that_other_systems_may_lack(self):
        beside = wheel.libraries_beside([BUILD / "host/cli/fencepost"])
        self.assertTrue(any(name.startswith("libfmt.so") for name in beside), beside)
        self.assertFalse(set(beside) & wheel.SYSTEM)
        for library in beside.values():
            self.assertTrue(wheel.licence_of(library).is_file(), library)

    def test_tag_is_by_the_newest_symbol(self):
        source = self.root / "old.c"
        source.write_text("int f(void) { return 1; }\n")
        run(CC, "-shared", "-fPIC", source, "-o", self.root / "old.so")
        self.assertEqual(wheel.needed_glibc([self.root / "old.so"]), (2, 17))
        source.write_text("#define _GNU_SOURCE\n#include <unistd.h>\nint f(void) { return close_range(3, 4, 0); }\n")
        run(CC, "-shared", "-fPIC", source, "-o", self.root / "newer.so")
        self.assertEqual(wheel.needed_glibc([self.root / "old.so", self.root / "newer.so"]), (2, 34))

    def test_structures_are_those_of_the_header(self):
        names = {"camera": _interface.Camera, "pose": _interface.Pose, "point": _interface.Point, "box": _interface.Box,
                 "alert": _interface.Alert, "object": _interface.Object, "way": _interface.Way,
                 "passing_rule": _interface.PassingRule}
        prints = []
        for name, of in names.items():
            prints.append(f'printf("{name} %zu\\n", sizeof(fencepost_{name}));')
            prints += [f'printf("{name}.{field} %zu %zu\\n", offsetof(fencepost_{name}, {field}), sizeof(((fencepost_{name}*)0)->{field}));'
                       for field, _ in of._fields_]
        prints.append('printf("%d %d %d %d %s\\n", FENCEPOST_MAX_BOXES, FENCEPOST_MAX_CORNERS, FENCEPOST_SECTORS, FENCEPOST_WAYS, FENCEPOST_VERSION);')
        source = self.root / "layout.c"
        source.write_text("#include <fencepost/fencepost.h>\n#include <stdio.h>\nint main(void) {\n" + "\n".join(prints) + "\n}\n")
        run(CC, f"-I{SOURCE / 'firmware'}", source, "-o", self.root / "layout")
        mine = []
        for name, of in names.items():
            mine.append(f"{name} {ctypes.sizeof(of)}")
            mine += [f"{name}.{field} {getattr(of, field).offset} {getattr(of, field).size}" for field, _ in of._fields_]
        *theirs, constants = run(self.root / "layout").splitlines()
        self.assertEqual(theirs, mine)
        *numbers, version = constants.split()
        self.assertEqual([int(n) for n in numbers], [_interface.MAX_BOXES, _interface.MAX_CORNERS, _interface.SECTORS,
                                                    _interface.WAYS])
        self.assertTrue(version.startswith(_interface.HEADER + "."))

    def test_installed_where_nothing_else_is(self):
        place = self.root / "venv"
        venv.create(place, with_pip=True)
        environment = {name: value for name, value in os.environ.items() if not name.startswith(("FENCEPOST", "PYTHON"))}
        run(place / "bin/python", "-m", "pip", "install", "-q", "--no-index", "--disable-pip-version-check", self.wheel,
            env=environment)
        test = pathlib.Path(self.root / "package_test.py")
        test.write_bytes((HERE / "package_test.py").read_bytes())  # away from the sources
        run(place / "bin/python", "-I", "-B", "-W", "error", test, SOURCE / "host/share/doc/python.md", cwd=self.root, env=environment)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
