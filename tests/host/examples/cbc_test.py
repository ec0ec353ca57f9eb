"""Runs the CBC's program on results as its vision shares them.

usage: cbc_test.py COMPILER EXAMPLES
"""
import binascii
import os
import pathlib
import select
import struct
import subprocess
import sys
import tempfile
import unittest

EXAMPLES, COMPILER = (sys.argv.pop() for _ in range(2))
SIZE = 1872
CHANNEL = 464


def results(frame, ms, channels, n_channels=4):
    """channels: lists of (area, x, y, left, top, right, bottom), by the offsets of the document."""
    data = bytearray(SIZE)
    struct.pack_into("=4i", data, 0, frame, ms, ms - 33, n_channels)
    for c, blobs in enumerate(channels):
        at = 16 + CHANNEL * c
        struct.pack_into("=6i", data, at, len(blobs), 0, 30, 100, 100, 0)
        for i, (area, x, y, left, top, right, bottom) in enumerate(blobs):
            struct.pack_into("=i3f4i3f", data, at + 24 + 44 * i, area, x, y, 0.9, left, top, right, bottom, 0.1, 9, 5)
    return bytes(data)


def line(body):
    return ("$%s*%04X\r\n" % (body, binascii.crc_hqx(body.encode(), 0xFFFF))).encode()


class Cbc(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name) / "color_tracking_results"
        program = pathlib.Path(self.folder.name) / "cbc_frames"
        subprocess.run([COMPILER, "-x", "c", "-std=gnu99", "-Wall", "-Wextra", "-Werror", "-O1", "-o", program,
                        pathlib.Path(EXAMPLES) / "cbc_frames.c"], check=True)
        self.program = subprocess.Popen([program, self.path], stdout=subprocess.PIPE)
        self.said = b""

    def tearDown(self):
        self.program.kill()
        self.program.wait()
        self.program.stdout.close()
        self.folder.cleanup()

    def share(self, data):
        """In place, as the vision does."""
        with open(self.path, "r+b" if self.path.exists() else "wb") as file:
            file.write(data)

    def next_line(self, wait=5.0):
        while b"\n" not in self.said:
            if not select.select([self.program.stdout], [], [], wait)[0]:
                return None
            self.said += os.read(self.program.stdout.fileno(), 4096)
        one, _, self.said = self.said.partition(b"\n")
        return one + b"\n"

    def test_each_image_is_a_line(self):
        self.assertIsNone(self.next_line(0.1), "the vision has not started")
        self.share(results(7, 12345, [[(600, 40.04, 30.5, 30, 20, 50, 41)], [(900, 80, 60, 70, 50, 90, 70)], [], []]))
        self.assertEqual(self.next_line(), line("FPFRM,12.3450,7,2,2,70,50,90,70,80.0,60.0,900,,1,30,20,50,41,40.0,30.5,600,"))
        self.assertIsNone(self.next_line(0.1), "the same image")
        self.share(results(8, 12378, [[], [], [], []]))
        self.assertEqual(self.next_line(), line("FPFRM,12.3780,8,0"))

    def test_the_largest_sixteen(self):
        many = [[(10 * c + i + 1, 5, 5, 0, 0, 9, 9) for i in range(10)] for c in range(4)]
        self.share(results(1, 1000, many))
        fields = self.next_line().decode().split(",")
        self.assertEqual(fields[3], "16")
        self.assertEqual([int(area) for area in fields[11::9]], list(range(40, 24, -1)))
        self.assertEqual([int(signature) for signature in fields[4::9] if signature[0] != "*"], [4] * 10 + [3] * 6)

    def test_what_cannot_be_is_passed_over(self):
        good = [(600, 40, 30, 30, 20, 50, 41)]
        bad = [(600, 40, 30, 30, 20, 160, 41), (600, float("nan"), 30, 30, 20, 50, 41), (0, 40, 30, 30, 20, 50, 41),
               (600, 40, 30, 51, 20, 50, 41)]
        self.share(results(1, 1000, [good], n_channels=5))
        self.share(results(2, 1000, [good], n_channels=0))
        torn = bytearray(results(3, 1000, [good]))
        struct.pack_into("=i", torn, 16, 11)
        self.share(bytes(torn))
        self.assertIsNone(self.next_line(0.1))
        self.share(results(4, 1000, [bad + good]))
        self.assertEqual(self.next_line(), line("FPFRM,1.0000,4,1,1,30,20,50,41,40.0,30.0,600,"))


if __name__ == "__main__":
    unittest.main()
