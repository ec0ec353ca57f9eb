"""The command line of a check that compares a document with the tree: one folder, or this one."""

import pathlib
import sys


def run(doc, check, unit):
    """`check(root)` gives faults and how many `unit` were compared. The exit status: 1 for a fault, or for nothing compared."""
    if len(sys.argv) > 2 or "-h" in sys.argv or "--help" in sys.argv:
        print(doc.strip())
        return 2
    root = pathlib.Path(sys.argv[1] if len(sys.argv) == 2 else pathlib.Path(__file__).parents[2]).resolve()
    faults, compared = check(root)
    for fault in faults:
        print(fault)
    print(f"{compared} {unit} compared, {len(faults)} faults")
    return 1 if faults or compared == 0 else 0
