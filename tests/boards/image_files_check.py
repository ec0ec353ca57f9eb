#!/usr/bin/env python3
"""usage: image_files_check.py BUILD_DIR ADDRESS [KIND...]

The files of one board as programs that we did not write read them: fencepost.hex by srecord and IntelHex, the .dfu by
dfu-suffix and dfuse-pack. The .uf2 is read by its specification. All hold the bytes of fencepost.bin, from ADDRESS on,
where the ELF file has them. KIND: the files that there have to be beside .bin and .hex.
"""

import pathlib
import re
import struct
import subprocess
import sys
import tempfile

from intelhex import IntelHex


def run(*command, where=None):
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=where)
    return done.returncode, done.stdout + done.stderr


def elf_start(elf):
    """The lowest address that is loaded; what begins with the ELF header itself is memory that nothing is loaded into."""
    _, text = run("arm-none-eabi-readelf", "-lW", str(elf))
    loads = [line.split() for line in text.splitlines() if line.strip().startswith("LOAD")]
    return min(int(words[3], 16) for words in loads if int(words[4], 16) > 0 and int(words[1], 16) > 0)


def hex_faults(file, image, address):
    code, said = run("srec_info", str(file), "-intel")
    if code != 0:
        yield f"srec_info: {said.strip()}"
    # Gaps are filled in the .bin, as erased flash is.
    filled = ["(", str(file), "-intel", "-offset", f"-{address}", "-fill", "0xFF", "0", str(len(image)), ")"]
    code, said = run("srec_cmp", str(file.with_suffix(".bin")), "-binary", *filled)
    if code != 0:
        yield f"srec_cmp: it is not what the .bin has: {said.strip()}"
    try:
        read = IntelHex(str(file))
    except Exception as fault:  # of its own kinds, all of which say what is wrong
        yield f"IntelHex: {fault}"
        return
    if read.minaddr() != address or read.tobinstr(size=len(image)) != image or read.maxaddr() >= address + len(image):
        yield f"IntelHex: other bytes, {read.minaddr():#x} to {read.maxaddr():#x}"


def dfu_faults(file, image, address):
    """DfuSe 1.1a, for the boot loader of STMicroelectronics' parts."""
    _, said = run("dfu-suffix", "-c", str(file))
    facts = dict(re.findall(r"^(Vendor ID|Product ID|BCD DFU):\s+(0x\w+)", said, re.MULTILINE))
    if facts != {"Vendor ID": "0x0483", "Product ID": "0xDF11", "BCD DFU": "0x011A"}:
        yield f"dfu-suffix: {said.strip().splitlines()[-1] if said.strip() else 'nothing'}, {facts}"
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder, "a.dfu")
        copy.write_bytes(file.read_bytes())
        code, said = run("dfuse-pack", "-d", str(copy))
        parts = list(pathlib.Path(folder).glob("*.bin"))
        if code != 0 or "ERROR" in said or f"address: {address:#010x}" not in said:
            yield f"dfuse-pack: {said.strip()}"
        elif len(parts) != 1 or parts[0].read_bytes() != image:
            yield "dfuse-pack: other bytes than in the .bin"


def uf2_faults(file, image, address):
    """Blocks of 512 bytes, in order, for the part (the UF2 specification, the families that picotool has)."""
    part = 0xE48BFF59 if struct.pack("<I", 0xFFFFDED3) in image[:4096] else 0xE48BFF56  # RP2350, RP2040
    blocks = file.read_bytes()
    count = len(blocks) // 512
    held = b""
    for n in range(count):
        block = blocks[512 * n:512 * (n + 1)]
        first, second, flags, at, size, number, of, family = struct.unpack_from("<8I", block)
        if (first, second, flags, number, of, family) != (0x0A324655, 0x9E5D5157, 0x2000, n, count, part) or \
                struct.unpack_from("<I", block, 508)[0] != 0x0AB16F30 or at != address + len(held) or size > 476:
            yield f"block {n} is none"
            return
        held += block[32:32 + size]
    if len(blocks) % 512 or held[:len(image)] != image or held[len(image):].strip(b"\xff"):
        yield "other bytes than in the .bin"


def gba_faults(file, image, _address):
    """The header as a console's BIOS wants it (GBATEK, GBA Cartridge Header), its maker's picture apart."""
    if file.read_bytes() != image:
        yield "other bytes than in the .bin"
    if image[3] != 0xEA or image[0xB2] != 0x96 or any(image[0xB5:0xBC]) or (sum(image[0xA0:0xBE]) + 0x19) & 0xFF:
        yield "its header is none"


READERS = {"hex": hex_faults, "dfu": dfu_faults, "uf2": uf2_faults, "gba": gba_faults}


def check(folder, address, kinds):
    image = (folder / "fencepost.bin").read_bytes()
    faults = [] if image else ["fencepost.bin is empty"]
    if elf_start(folder / "fencepost.elf") != address:
        faults.append(f"fencepost.elf begins at {elf_start(folder / 'fencepost.elf'):#x}")
    for kind in ("hex", *kinds):
        file = folder / f"fencepost.{kind}"
        if not file.is_file():
            faults.append(f"there is no {file.name}")
        else:
            faults += [f"{file.name}: {fault}" for fault in READERS[kind](file, image, address)]
    return faults


def main():
    if len(sys.argv) < 3 or not set(sys.argv[3:]) <= set(READERS):
        sys.exit(__doc__.strip())
    faults = check(pathlib.Path(sys.argv[1]), int(sys.argv[2], 0), sys.argv[3:])
    print(*faults, sep="\n", end="\n" if faults else "")
    print(f"{sys.argv[1]}: bin, hex {' '.join(sys.argv[3:])}: {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
