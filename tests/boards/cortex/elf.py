"""The parts of an ELF file that tests use: its segments, symbols, and where it sleeps."""

import functools
import pathlib
import re
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
    lines = output_of("arm-none-eabi-nm", path)
    return {name: int(address, 16) for address, _, name in (line.split(" ", 2) for line in lines.splitlines())
            if address.strip()}


def sleeps(path):
    """[address of each WFI]"""
    return [int(address, 16) for address in re.findall(r"^ *([0-9a-f]+):\twfi", output_of("arm-none-eabi-objdump", path), re.M)]


@functools.lru_cache(maxsize=None)
def output_of(tool, path):
    options = ["-d", "--no-show-raw-insn"] if tool.endswith("objdump") else []
    return subprocess.run([tool, *options, str(path)], capture_output=True, text=True, check=True).stdout
