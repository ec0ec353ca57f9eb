"""Renders two of the bundled views again and compares the bytes: render_check.py SOURCES FOLDER. Exit status 77: not tested.

FOLDER holds what is to be compared, the bundled blocks_16 or a copy with a fault.
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

NOT_TESTED = 77
VIEWS = (0, 9)


def main(sources, bundled):
    if not shutil.which("povray"):
        print("NOT TESTED: povray is not on this machine; toolchain/setup render installs it")
        return NOT_TESTED
    blocks = Path(sources) / "host/share/blocks"
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([sys.executable, "-B", blocks / "render.py", blocks / "blocks_16.json", folder, "--views",
                        ",".join(map(str, VIEWS))], check=True, stderr=subprocess.DEVNULL)
        names = ["poses.csv", *(f"view_{view:03}.png" for view in VIEWS)]
        differ = [name for name in names if (Path(folder) / name).read_bytes() != (Path(bundled) / name).read_bytes()]
    for name in differ:
        print(f"{name} is not what render.py makes of blocks_16.json; render the set again")
    return 1 if differ else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
