#!/usr/bin/env python3
"""usage: uf2.py IMAGE.bin IMAGE.uf2

Makes a UF2 file, which the USB disk of an RP2040 or RP2350 takes, of an image from the start of the flash on. That of an
RP2350 has a block within 4 KB that says so; that of an RP2040 begins with its second boot stage. An image whose boot
stage has a wrong CRC would never start: it is refused, and the right CRC printed.
"""

import pathlib
import struct
import sys

FLASH = 0x10000000
RP2040, RP2350 = 0xE48BFF56, 0xE48BFF59  # families; the second is that of its Arm cores, secure
IMAGE_DEF = struct.pack("<5I", 0xFFFFDED3, 0x10210142, 0x000001FF, 0, 0xAB123579)  # RP2350 datasheet 5.9.5.1
BLOCK_WITHIN = 4096  # where the boot ROM looks for it
FAMILY_PRESENT = 0x2000
PAYLOAD = 256
BOOT2 = 252


def crc32_mpeg2(data):
    """Polynomial 04C11DB7, not reflected, begun with ones (RP2040 datasheet 2.8.1.3.1)."""
    crc = 0xFFFFFFFF
    for byte in data:
        crc ^= byte << 24
        for _ in range(8):
            crc = (crc << 1) ^ (0x04C11DB7 if crc & 0x80000000 else 0)
            crc &= 0xFFFFFFFF
    return crc


def boot2_fault(image):
    """Why the boot ROM would not start it, or None."""
    if len(image) <= BOOT2 + 4:
        return "there is nothing behind the boot stage"
    right = crc32_mpeg2(image[:BOOT2])
    stored = struct.unpack_from("<I", image, BOOT2)[0]
    return None if right == stored else f"the CRC of the boot stage is 0x{right:08x}, the image has 0x{stored:08x}"


def family_of(image):
    return RP2350 if IMAGE_DEF in image[:BLOCK_WITHIN] else RP2040


def uf2(image):
    family = family_of(image)
    image += b"\xff" * (-len(image) % PAYLOAD)
    count = len(image) // PAYLOAD
    blocks = []
    for n in range(count):
        head = struct.pack("<8I", 0x0A324655, 0x9E5D5157, FAMILY_PRESENT, FLASH + PAYLOAD * n, PAYLOAD, n, count, family)
        blocks.append(head + image[PAYLOAD * n:PAYLOAD * (n + 1)] + bytes(476 - PAYLOAD) + struct.pack("<I", 0x0AB16F30))
    return b"".join(blocks)


def main():
    if len(sys.argv) != 3:
        sys.exit(__doc__.strip())
    image = pathlib.Path(sys.argv[1]).read_bytes()
    fault = boot2_fault(image) if family_of(image) == RP2040 else None
    if fault:
        sys.exit(f"uf2: {sys.argv[1]}: {fault}")
    pathlib.Path(sys.argv[2]).write_bytes(uf2(image))


if __name__ == "__main__":
    main()
