#!/usr/bin/env python3
"""usage: format_check.py ROOT

Every C++ file of the five code folders is as clang-format writes it. To mend one: clang-format -i FILE.
"""

import concurrent.futures
import os
import pathlib
import subprocess
import sys

FOLDERS = ["hal", "drivers", "firmware", "host", "tests"]
BATCH = 32


def complaints(files):
    command = ["clang-format", "--dry-run", "--Werror", *files]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.returncode, done.stderr


def main():
    if len(sys.argv) != 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    root = pathlib.Path(sys.argv[1])
    files = [str(f) for folder in FOLDERS for f in sorted((root / folder).rglob("*")) if f.suffix in {".cpp", ".hpp"}]
    batches = [files[i : i + BATCH] for i in range(0, len(files), BATCH)]
    bad = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for status, output in pool.map(complaints, batches):
            bad |= status
            print(output, end="")
    print(f"{len(files)} files checked")
    return 1 if bad or not files else 0


if __name__ == "__main__":
    sys.exit(main())
