#!/usr/bin/env python3
"""usage: uf2_test.py

toolchain/uf2.py: what it writes, by the UF2 specification, and that it refuses what neither part would start.
"""

import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest

TOP = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = TOP / "toolchain" / "uf2.py"
sys.path.insert(0, str(SCRIPT.parent))
import uf2  # noqa: E402


def image(size):
    boot2 = bytes(range(252))
    return boot2 + struct.pack("<I", uf2.crc32_mpeg2(boot2)) + bytes(i % 251 for i in range(size - 256))


class Uf2(unittest.TestCase):
    def convert(self, data):
        with tempfile.TemporaryDirectory() as folder:
            source, target = pathlib.Path(folder, "a.bin"), pathlib.Path(folder, "a.uf2")
            source.write_bytes(data)
            done = subprocess.run([sys.executable, "-B", str(SCRIPT), str(source), str(target)], capture_output=True,
                                  text=True, check=False)
            return done, target.read_bytes() if target.exists() else None

    def test_crc_is_that_of_the_catalogue(self):
        # CRC-32/MPEG-2 of "123456789", by the catalogue of parametrised CRC algorithms.
        self.assertEqual(uf2.crc32_mpeg2(b"123456789"), 0x0376E6E7)

    def test_blocks_hold_the_image(self):
        data = image(1000)  # four blocks, the last not full
        done, blocks = self.convert(data)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(len(blocks), 4 * 512)
        flash = b""
        for n in range(4):
            block = blocks[512 * n:512 * (n + 1)]
            self.assertEqual(struct.unpack_from("<8I", block), (0x0A324655, 0x9E5D5157, 0x2000, 0x10000000 + 256 * n, 256, n,
                                                                4, 0xE48BFF56))
            self.assertEqual(struct.unpack_from("<I", block, 508)[0], 0x0AB16F30)
            self.assertEqual(block[32 + 256:508], bytes(508 - 288))
            flash += block[32:32 + 256]
        self.assertEqual(flash, data + b"\xff" * 24)

    def test_an_image_of_an_rp2350_says_so(self):
        done, blocks = self.convert(bytes(8) + uf2.IMAGE_DEF + bytes(600))
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({struct.unpack_from("<I", blocks, at + 28)[0] for at in range(0, len(blocks), 512)}, {0xE48BFF59})
        self.assertNotEqual(self.convert(bytes(4096 - 19) + uf2.IMAGE_DEF)[0].returncode, 0, "too far for its boot ROM")

    def test_what_would_not_start_is_refused(self):
        wrong = bytearray(image(1000))
        right = struct.unpack_from("<I", wrong, 252)[0]
        wrong[3] ^= 1
        done, blocks = self.convert(bytes(wrong))
        self.assertNotEqual(done.returncode, 0)
        self.assertIsNone(blocks)
        self.assertIn(f"the image has 0x{right:08x}", done.stderr)
        self.assertNotEqual(self.convert(image(256))[0].returncode, 0)
        self.assertNotEqual(self.convert(b"")[0].returncode, 0)


unittest.main()
