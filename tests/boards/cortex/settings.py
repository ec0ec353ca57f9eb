"""Settings as a board keeps them (firmware/config/settings_store.hpp)."""

import binascii
import struct


def page_with(*settings):
    """The first page's begin, with these: "camera,pixy2_i2c"."""
    def pair(value):
        return struct.pack("<HH", value, value ^ 0xFFFF)

    page = pair(1)
    for setting in settings:
        body = f"FPCFG,{setting}".encode()
        line = b"$" + body + b"*%04X" % binascii.crc_hqx(body, 0xFFFF)
        page += pair(len(line)) + line + b"\xff" * (-len(line) % 4) + pair(binascii.crc_hqx(line, 0xFFFF))
    return page
