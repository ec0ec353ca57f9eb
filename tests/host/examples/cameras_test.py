"""Runs the cameras' scripts with stub cameras, on MicroPython and, what is made for it, on CPython too.

usage: cameras_test.py NODE FOLDER_WITH_MICROPYTHON EXAMPLES
"""
import ast
import binascii
import pathlib
import runpy
import subprocess
import sys
import unittest

EXAMPLES, MICROPYTHON, NODE = (pathlib.Path(sys.argv.pop()) for _ in range(3))
STUBS = pathlib.Path(__file__).parent / "cameras" / "stubs.py"
PICTURES = runpy.run_path(str(STUBS))["PICTURES"]
MOST_LINES = 60
MOST_BLOBS = 16
LONGEST = 1024  # characters of a record, its end included


def sealed(body):
    return "$%s*%04X\r\n" % (body, binascii.crc_hqx(body.encode(), 0xFFFF))


def expected(fields, first_ms):
    """The lines of the stub's pictures, by what a script tells of a blob: centre and pixels."""
    lines = []
    for number, picture in enumerate(PICTURES, 1):
        told = [(blob, *fields(blob)) for blob in picture]
        told.sort(key=lambda one: -(one[3] or one[0][2] * one[0][3]))
        blobs = ""
        for (x, y, w, h, signature, _, _), cx, cy, pixels in told[:MOST_BLOBS]:
            blobs += ",%d,%d,%d,%d,%d,%.1f,%.1f,%d," % (signature, x, y, x + w - 1, y + h - 1, cx, cy, pixels)
        lines.append(sealed("FPFRM,%d.%04d,%d,%d%s" % (5, first_ms * 10 + (number - 1) * 400, number, min(len(told), MOST_BLOBS), blobs)))
    return lines


def rounded(blob):
    return int(blob[6][0] + 0.5), int(blob[6][1] + 0.5), blob[5]


def middle(blob):
    return blob[0] + (blob[2] - 1) / 2, blob[1] + (blob[3] - 1) / 2, 0


FIELDS = {"openmv": lambda blob: (*blob[6], blob[5]), "maixcam": rounded, "vex": middle}
ON_CPYTHON = ["maixcam"]
OTHER_FIRMWARE = {"openmv": "openmv5"}


def script(name):
    return EXAMPLES / f"{name}_frames.py"


def run(command):
    """(what it printed, what it wrote to a serial port)"""
    done = subprocess.run(command, capture_output=True, timeout=60)
    if done.returncode != 0:
        raise AssertionError(done.stderr.decode())
    lines = done.stdout.decode().replace("\r\n", "\n").splitlines()
    printed = [line + "\r\n" for line in lines if not line.startswith("uart ")]
    return printed, [ast.literal_eval(line[5:]) for line in lines if line.startswith("uart ")]


class Scripts(unittest.TestCase):
    def expect_lines(self, name, said):
        printed, written = said
        # A snapshot of the Brain's is taken after its time.
        wanted = expected(FIELDS[name], 0 if name == "vex" else 40)
        self.assertEqual(len(wanted), 3)
        for where in ([printed, written] if name == "openmv" else [written] if name == "maixcam" else [printed]):
            self.assertEqual(where, wanted)
        self.assertLess(max(map(len, wanted)), LONGEST)

    def test_they_print_frames_on_micropython(self):
        for name, camera in [(name, name) for name in FIELDS] + list(OTHER_FIRMWARE.items()):
            with self.subTest(camera):
                self.expect_lines(name, run([NODE, MICROPYTHON / "micropython.mjs", STUBS, script(name), camera]))

    def test_they_print_frames_on_cpython(self):
        program = "import runpy, sys; runpy.run_path(sys.argv[1])['run'](open(sys.argv[2]).read(), sys.argv[3])"
        for name in ON_CPYTHON:
            with self.subTest(name):
                self.expect_lines(name, run([sys.executable, "-c", program, STUBS, script(name), name]))

    def test_they_are_short(self):
        for name in FIELDS:
            self.assertLessEqual(len(script(name).read_text().splitlines()), MOST_LINES, name)


if __name__ == "__main__":
    unittest.main()
