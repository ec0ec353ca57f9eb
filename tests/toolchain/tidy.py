#!/usr/bin/env python3
"""usage: tidy.py BUILD_DIR FOLDER...

Runs clang-tidy on every source of the folders, by the commands of BUILD_DIR/compile_commands.json. Sources that a unity
build compiles together are checked together, in half the time. Exit status 1 if it has anything to say, or if a source
of the folders is not in there.
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

# Registers of parts, and what a page calls: only a cross compiler can compile these.
BOARDS = re.compile(r"/(?:hal/(?:mcu|boards/(?!template/))|host/web/wasm/)")

HOST = re.compile(r"/host/[^/]+/[^/]+$")
UNITED = re.compile(r"/Unity/unity_[^/]*$")
INCLUDED = re.compile(r'^#include "(.*)"$', re.MULTILINE)
# As .clang-tidy has it, and the sources themselves, which are included where they are compiled together.
FINDINGS_IN = r"/(hal|drivers|firmware|host)/[^ ]*\.[ch]pp$"


def one_command_per_file(database):
    """Some sources are compiled twice, for another purpose; the first command stands for all."""
    chosen = {}
    for entry in database:
        chosen.setdefault(entry["file"], entry | {"command": GCC_ONLY.sub("", entry["command"])})
    return chosen


def sources_of(unit):
    """The sources that are compiled by this command: one, or those of a unity build."""
    return INCLUDED.findall(pathlib.Path(unit).read_text()) if UNITED.search(unit) else [unit]


def tidy(folder, unit):
    # The robot's stack has a bound; and a unity build includes sources.
    checks = "" if any(HOST.search(source) for source in sources_of(unit)) else "misc-no-recursion,"
    command = ["clang-tidy", "--quiet", "--use-color=0", "--extra-arg=-Wno-unused-command-line-argument",  # GCC's
               f"--checks={checks}-bugprone-suspicious-include",
               f"--header-filter={FINDINGS_IN}", "-p", folder, unit]
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
    unit_of = {}
    for unit in database:
        for source in sources_of(unit):
            unit_of.setdefault(source, unit)
    missing = [path for path in wanted if path not in unit_of]
    for path in missing:
        print(f"{path}: not in the compile database")
    units = sorted({unit_of[path] for path in wanted if path in unit_of})
    bad = len(missing)
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "compile_commands.json").write_text(json.dumps(list(database.values())))
        with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
            for status, output in pool.map(lambda unit: tidy(folder, unit), units):
                if status != 0:
                    bad += 1
                    print(output.strip())
    print(f"{len(wanted)} sources checked, {bad} with faults")
    return 1 if bad or not wanted else 0


if __name__ == "__main__":
    sys.exit(main())
