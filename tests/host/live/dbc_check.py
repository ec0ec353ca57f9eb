"""Holds the frames of can_alert_frames against the DBC file, as another program reads it.

usage: dbc_check.py DBC PROGRAM
"""
import subprocess
import sys

try:
    import canmatrix.formats
except ImportError:
    print("SKIPPED: python3-canmatrix is missing; toolchain/setup test installs it")
    sys.exit(77)


def decoded(frame, data):
    """Signal name to text: the name of a value where the file has one, else its number."""
    found = {}
    for name, signal in frame.decode(data).items():
        named = signal.signal.values.get(int(signal.raw_value))
        found[name] = named if named is not None else float(signal.phys_value)
    return found


def same(expected, got):
    return expected == got if isinstance(got, str) else abs(float(expected) - got) < 1e-6


def main():
    database = canmatrix.formats.loadp_flat(sys.argv[1])
    lines = subprocess.run([sys.argv[2]], check=True, capture_output=True, text=True).stdout.splitlines()
    wrong = 0
    for line in lines:
        number, data, *words = line.split()
        frame = database.frame_by_id(canmatrix.ArbitrationId(int(number, 16)))
        if frame is None:
            sys.exit(f"{sys.argv[1]} has no frame {number}")
        found = decoded(frame, bytearray.fromhex(data))
        expected = dict(word.split("=") for word in words)
        if set(expected) != set(found):
            sys.exit(f"signals {sorted(found)}, not {sorted(expected)}")
        for name, value in expected.items():
            if not same(value, found[name]):
                print(f"{data}: {name} reads as {found[name]}, not {value}")
                wrong += 1
    print(f"{len(lines)} frames, {wrong} signals read otherwise")
    return 1 if wrong or not lines else 0


sys.exit(main())
