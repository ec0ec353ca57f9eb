#!/usr/bin/env python3
"""usage: image_check.py IMAGE BUILD_DIR SIZES.csv [--context-words N]

The linked image of one board, IMAGE being its row of SIZES.csv. It has no symbol of a heap, of exceptions, run-time
types, guarded statics, printf or of a libm function that differs between C libraries. Flash, static memory and
worst-case stack, in bytes, are no larger than in the table. The stack is the deepest path from start-up, with one
interrupt on top.
"""

import csv
import os
import pathlib
import re
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "toolchain"), str(HERE.parent / "stack")]
import symbol_check  # noqa: E402
import worst_case  # noqa: E402

# Ours, and harmless: a trap (hal/mcu/support.cpp).
ALLOWED = {"abort"}
# Words that the core pushes when an interrupt comes: 8, with the float unit 26, and one to align (Armv7-M B1.5.7).
CONTEXT_WORDS = 27
# Functions of the compiler's library: allowances for their frames, by their code (12.2: at most 10 words and a callee).
LIBGCC = re.compile(r"__(?:aeabi_\w+|popcount\w+|clz\w+|ctz\w+|gnu_\w+|\w*div\w*|\w*mod\w*|[a-z]+[sd]f\w*)$|sqrtf?$")
LIBGCC_FRAME = 96
RAM = 0x20000000  # of every Cortex-M (Armv7-M B3.1)
# The boot ROM of an RP2040 or RP2350, through pointers that it gives: an allowance.
ROM_CALLER = re.compile(r"mcu::rp2\w*::(?:Flash::|read_unique_id\(|rom_address\(|start_boot_loader\()")
ROM_STACK = 256
# Written in assembly (hal/mcu/division/aeabi.cpp, hal/mcu/soft_float/armv6m.cpp): their own bytes of stack, and what
# they call.
ASSEMBLY = {"__aeabi_uldivmod": (32, "fencepost_uldivmod"), "__aeabi_ldivmod": (32, "fencepost_ldivmod"),
            "__aeabi_fadd": (24, "fencepost_add"), "__aeabi_fsub": (24, "fencepost_add"),
            "__aeabi_fmul": (24, "fencepost_multiply")}
# Beside the sums, without stack and calls.
ASSEMBLY_LEAVES = ["__aeabi_fcmplt", "__aeabi_fcmple", "__aeabi_fcmpge", "__aeabi_fcmpgt"]
STACK_GUARD = 64  # hal/mcu/cortex_m/startup.cpp: 32 bytes, aligned
STARTS = ["fencepost_start", "image_main"]
INTERRUPT = re.compile(r"\w+_interrupt$")


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def symbol_faults(elf):
    names = [line.split(" ", 2)[2] for line in run("arm-none-eabi-nm", "-C", "--defined-only", elf).splitlines()]
    faults = [f"{name}: {why}" for name in names for why, pattern in symbol_check.BANNED.items()
              if pattern.match(name) and name not in ALLOWED]
    return faults, len(names)


def sizes(elf):
    """(bytes of flash, bytes of static memory) by the sections that are loaded or reserved; code in memory is both."""
    flash = ram = 0
    for line in run("arm-none-eabi-readelf", "-SW", elf).splitlines():
        match = re.match(r"\s*\[ *\d+\] (\S+)\s+(\S+)\s+([0-9a-f]+) [0-9a-f]+ ([0-9a-f]+) [0-9a-f]+\s+(\S*A\S*)", line)
        if not match or match.group(1) == ".stack":
            continue
        size = int(match.group(4), 16)
        if match.group(2) != "NOBITS":
            flash += size
        if "W" in match.group(5) or int(match.group(3), 16) >= RAM:
            ram += size
    return flash, ram


def other_names(elf):
    """{symbol: all symbols at its address}: functions that the compiler found to be the same have one body."""
    at = {}
    for line in run("arm-none-eabi-nm", "--defined-only", elf).splitlines():
        address, kind, name = line.split(" ", 2)
        if kind in "tTwW":
            at.setdefault(address, []).append(name)
    return {name: names for names in at.values() for name in names}


class ImageDepths(worst_case.Depths):
    def __init__(self, graph, same):
        super().__init__(graph)
        self.same = same
        self.titles = {worst_case.short(title): title for title in self.frames}
        for name, (frame, callee) in ASSEMBLY.items():
            if callee in self.frames:
                self.frames[name] = frame
                self.kinds[name] = "static"
                self.calls.setdefault(name, set()).add(callee)
        if "fencepost_add" in self.frames:
            for name in ASSEMBLY_LEAVES:
                self.frames[name] = 0
                self.kinds[name] = "static"

    def outside(self, function, path):
        for name in self.same.get(worst_case.short(function), ()):
            if name in self.titles:
                return self.of(self.titles[name], path)
        if LIBGCC.match(worst_case.short(function)):
            return LIBGCC_FRAME, [function]
        if function == "__indirect_call" and path and ROM_CALLER.search(self.labels.get(path[-1], "")):
            return ROM_STACK, ["boot ROM"]
        if path and path[-1] == "fencepost_start":  # the table of constructors: each is a root of its own
            return 0, []
        return super().outside(function, path)


def board_of(build):
    """That of the build's first image."""
    cache = (pathlib.Path(build) / "CMakeCache.txt").read_text()
    return re.search(r"^FENCEPOST_BOARD:\w+=(\w+)$", cache, re.MULTILINE).group(1)


def stack(elf, build, context_words):
    # Images of other choices and boards lie beside this one, with functions of the same names.
    others = rf"fencepost_program_|fencepost_board_(?!{board_of(build)}\.dir)"
    depths = ImageDepths(worst_case.read_graph(build, without=others), other_names(elf))
    names = {worst_case.short(title): title for title in depths.frames}
    missing = [root for root in STARTS if root not in names]
    if missing:
        sys.exit(f"image_check: {', '.join(missing)} not in the call graph of {build}")
    constructors = [title for title in depths.frames if "_GLOBAL__sub_I" in title]
    below = max(depths.of(title)[0] for title in [*(names[s] for s in STARTS[1:]), *constructors])
    start = depths.frames[names[STARTS[0]]]
    interrupts = {name: depths.of(title)[0] for name, title in names.items() if INTERRUPT.match(name)}
    if not interrupts:
        sys.exit("image_check: no interrupts in the call graph")
    deepest = max(interrupts, key=interrupts.get)
    print(f"stack: start-up {start}, loop {below}, {deepest} {interrupts[deepest]} and {4 * context_words} pushed")
    for title in depths.of(names["image_main"])[1]:
        print(f"  {depths.frames.get(title, LIBGCC_FRAME):6} {depths.labels.get(title, title)[:120]}")
    return start + below + interrupts[deepest] + 4 * context_words, sorted(set(depths.faults))


def reserved_stack(elf):
    """Bytes of stack that the linker script keeps free for it at least."""
    for line in run("arm-none-eabi-nm", elf).splitlines():
        value, _, name = line.split(" ")
        if name == "image_stack_size":
            return int(value, 16)
    return 0


def main():
    if len(sys.argv) not in (4, 6):
        sys.exit(__doc__.strip())
    image, build, table = sys.argv[1:4]
    context_words = int(sys.argv[5]) if len(sys.argv) == 6 else CONTEXT_WORDS
    elf = str(pathlib.Path(build) / "fencepost.elf")
    rows = {row["image"]: row for row in csv.DictReader(pathlib.Path(table).read_text().splitlines())}
    if image not in rows:
        sys.exit(f"image_check: {table} has no row for {image}")
    faults, symbols = symbol_faults(elf)
    flash, ram = sizes(elf)
    deepest, stack_faults = stack(elf, build, context_words)
    faults += stack_faults
    for name, measured in (("flash", flash), ("ram", ram), ("stack", deepest)):
        committed = int(rows[image][name])
        print(f"{name}: {measured} of {committed} bytes")
        if measured > committed:
            faults.append(f"{name}: {measured} bytes, {committed} in {table}: explain the growth and change the table")
        if measured == 0:
            faults.append(f"{name}: nothing was measured")
    if "FENCEPOST_FIGURES" in os.environ:  # for record_figures.py
        (pathlib.Path(os.environ["FENCEPOST_FIGURES"]) / f"{image}.sizes").write_text(f"flash {flash}\nram {ram}\nstack {deepest}\n")
    room = reserved_stack(elf) - STACK_GUARD
    if deepest > room:
        faults.append(f"stack: {deepest} bytes, the linker script keeps {room}")
    if symbols == 0:
        faults.append("no symbols were checked")
    print(*faults, sep="\n", end="\n" if faults else "")
    print(f"{image}: {symbols} symbols, {len(faults)} faults")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
