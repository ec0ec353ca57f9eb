"""What is used of an ELF file: its segments and symbols."""

import pathlib
import struct
import subprocess


def segments(path):
    """[(address it is loaded at, bytes)]"""
    data = pathlib.Path(path).read_bytes()
    offset, = struct.unpack_from("<I", data, 28)
    size, count = struct.unpack_from("<HH", data, 42)
    found = []
    for n in range(count):
        kind, at, _, physical, length = struct.unpack_from("<5I", data, offset + n * size)
        if kind == 1 and length:
            found.append((physical, data[at:at + length]))
    return found


def symbols(path):
    """{name: address}"""
    lines = subprocess.run(["arm-none-eabi-nm", str(path)], capture_output=True, text=True, check=True).stdout
    return {name: int(address, 16) for address, _, name in (line.split(" ", 2) for line in lines.splitlines())
            if address.strip()}
