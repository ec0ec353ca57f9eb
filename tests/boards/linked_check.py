#!/usr/bin/env python3
"""usage: linked_check.py IMAGE.map [--without ALLOWANCE]

An image links all of firmware/recon but what ALLOWED names: the linker's list of discarded sections has nothing else.
--without takes one allowance away, to see the check fail. Names are mangled, sizes in bytes.
"""

import pathlib
import re
import sys

# Parts of names, and why such a function may be in no board's program.
ALLOWED = {
    "ILj32E": "the solver of profile micro",
    "LowOrderFitILj5E": "the series of profile micro",
    "clip_convex": "outlines for programs that link the library",
    "careful_cut": "outlines for programs that link the library",
    "outline_polygon": "outlines for programs that link the library",
}
# bytes. A smaller function may be part of those that call it.
MIN_SIZE = 350
SECTION = re.compile(r"^ \.text\.(\S+)\s+0x[0-9a-f]+\s+0x([0-9a-f]+)\s+\S*fencepost_recon\.a", re.MULTILINE)


def discarded(text):
    begin = text.index("\nDiscarded input sections")
    sections = text[begin : text.index("\nMemory Configuration")]
    return {name: int(size, 16) for name, size in SECTION.findall(sections)}


def main(arguments):
    allowed = set(ALLOWED)
    if "--without" in arguments:
        allowed.remove(arguments.pop(arguments.index("--without") + 1))
        arguments.remove("--without")
    if len(arguments) != 1:
        sys.exit(__doc__)
    found = discarded(pathlib.Path(arguments[0]).read_text())
    if not found:
        sys.exit(f"{arguments[0]}: no discarded section of firmware/recon: is it the map of an image without -flto?")
    idle = [name for name, size in found.items() if size >= MIN_SIZE and not any(part in name for part in allowed)]
    for name in idle:
        print(f"{name}: {found[name]} bytes in firmware/recon that the image does not link: move it to host")
    print(f"{len(found)} functions of firmware/recon are not linked, {len(idle)} of them without an allowance")
    return 1 if idle else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
