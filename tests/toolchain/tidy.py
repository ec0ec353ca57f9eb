#!/usr/bin/env python3
"""usage: tidy.py BUILD_DIR FOLDER...

Runs clang-tidy on every source of the folders, by the commands of BUILD_DIR/compile_commands.json. Exit status 1 if
it has anything to say, or if a source of the folders is not in there.
"""

import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

GCC_ONLY = re.compile(r" -(?:Wno-restrict|fcallgraph-info\S*)(?= )")

# Registers of parts: only a cross compiler can compile these.
BOARDS = re.compile(r"/hal/(?:mcu|boards/(?!template/))")

HOST = re.compile(r"/host/[^/]+/[^/]+$")


def one_command_per_file(database):
    """Some sources are compiled twice, for another purpose; the first command stands for all."""
    chosen = {}
    for entry in database:
        chosen.setdefault(entry["file"], entry | {"command": GCC_ONLY.sub("", entry["command"])})
    return chosen


def tidy(folder, source):
    command = ["clang-tidy", "--quiet", "--use-color=0", "-p", folder, source]
    if not HOST.search(source):
        command.insert(1, "--checks=misc-no-recursion")  # the robot's stack has a bound
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    chatter = re.compile(r"^\d+ warnings? .*generated\.\n", re.MULTILINE)
    return done.returncode, done.stdout + chatter.sub("", done.stderr)


def main():
    if len(sys.argv) < 3:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    database = one_command_per_file(json.loads((pathlib.Path(sys.argv[1]) / "compile_commands.json").read_text()))
    wanted = sorted(str(path.resolve()) for folder in sys.argv[2:] for path in pathlib.Path(folder).rglob("*.cpp")
                    if not BOARDS.search(str(path.resolve())))
    missing = [path for path in wanted if path not in database]
    for path in missing:
        print(f"{path}: not in the compile database")
    bad = len(missing)
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "compile_commands.json").write_text(json.dumps(list(database.values())))
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for status, output in pool.map(lambda path: tidy(folder, path), [p for p in wanted if p in database]):
                if status != 0:
                    bad += 1
                    print(output.strip())
    print(f"{len(wanted)} sources checked, {bad} with faults")
    return 1 if bad or not wanted else 0


if __name__ == "__main__":
    sys.exit(main())
