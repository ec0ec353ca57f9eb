"""The README's picture is what the program makes of the demo's recording: python3 picture.py FENCEPOST SOURCES [--write]."""

import subprocess
import sys
import tempfile
from pathlib import Path

RECORDING = "host/share/recordings/approach_stop.log"  # as in `fencepost demo`
PICTURE = "host/share/doc/demo.svg"
MOST = 20_000  # bytes, of a page that everybody loads


def main(program, sources, *options):
    with tempfile.TemporaryDirectory() as folder:
        made = Path(folder) / "demo.svg"
        subprocess.run([program, "export", sources / RECORDING, "-o", made], check=True)
        now = made.read_bytes()
    shown = sources / PICTURE
    if "--write" in options:
        shown.write_bytes(now)
    if f"]({PICTURE})" not in (sources / "README.md").read_text(encoding="utf-8"):
        return f"README.md shows no {PICTURE}"
    if len(now) > MOST:
        return f"{PICTURE}: {len(now)} bytes are too many"
    return 0 if shown.read_bytes() == now else f"{PICTURE} is not what 'fencepost export {RECORDING}' makes now"


sys.exit(main(Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), *sys.argv[3:]))
