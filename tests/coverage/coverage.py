#!/usr/bin/env python3
"""usage: coverage.py BUILD_DIR [--least PERCENT] [--jobs N] [--lines]

Runs the unit tests of hal, drivers and firmware in BUILD_DIR, a build by g++ -O0 --coverage -fprofile-abs-path. Prints
which share of each folder's lines they run, and the branches of the decoders in drivers/ that never go one way.
Exit status 1 if a test fails, a folder has less than PERCENT (95) of its lines, or a source is in no test. It is also 1
if a decoder has such a branch that DECIDED does not explain. --lines: each line that is not run, too.

Start-up code, registers and images count as far as a test at the desk compiles them. Code that asks a kernel for its
buses is tested on one (tests/guest) and counted apart. A template counts as run where one of its instances was;
branches that are exceptions' are none.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import time

FOLDERS = ("hal", "drivers", "firmware")
# Only a cross compiler builds these.
FOR_BOARDS = re.compile(r"^(hal/(mcu|boards)/|firmware/image/)")
# Stands in for a library that is there wherever tests are built.
STAND_IN = re.compile(r"_missing\.cpp$")
# Code that asks a kernel for CAN, I2C, SPI and USB is tested on one, in an emulator (tests/guest): counted apart.
ON_A_KERNEL = re.compile(r"^hal/linux/(can|can_sender|can_socket|i2c|i2c_adapter|spi|usb_device)\.[ch]pp$")
# Bytes to messages: what the walks of tests/drivers/states go through.
DECODERS = re.compile(
    r"^drivers/(\w+/(decoder|stream_decoder|protocol|frames|registers|serial|telegram|signal|wheels|chirp|measure)\.[ch]pp"
    r"|pixy1/(pixy1|usb)\.[ch]pp|wire/\w+\.hpp|nxt/framed_link\.hpp)$")

# Of branches never taken: words of the line, how many ways it may lack, and why there is no other.
DECIDED = {
    "FENCEPOST_CHECK": (9, "the other way is a trap: a bug, not an input"),
    "switch (": (1, "the compiler's, of a value that the enumeration does not have"),
    "fits = request.push_back(byte) && fits": (2, "there is room for our own requests; a trap if not"),
    "!version.type.push_back": (1, "sixteen bytes of a version hold ten of its type, which has room for ten"),
    "complete = images_.take(message, first_byte) || complete": (1, "damage takes back what one byte completed"),
    "complete = take_message(message, first_byte, now) || complete": (1, "one byte completes one message"),
    "(!fresh_ && size_ > 0)": (1, "a line that has begun has a character"),
    "outside || left > right || top > bottom": (2, "edges are sorted before"),
    "if (!is_digit(c)) return std::nullopt": (1, "its callers cut out digits"),
    "if (end_ < bytes_.size())": (1, "a read is begun once all of the one before is taken: room for two"),
    "if (bytes.size() < text.size()) return false": (1, "both halves have the eight characters"),
}

# Hours on bad cables: what they reach by chance is tested by nobody, and they take minutes.
NO_UNIT_TESTS = ("hostile_test", "golden_hours_test")
# 2,800 worlds, a study: without optimisation more than the 25 minutes that it was given on a busy machine. What it runs
# the others of its program run, too.
LEFT_OUT = {"recon_pose_test": "Constellation.FindsItsPlaceInWorldsNeverSeen:Constellation.KnowsThatItIsElsewhere"}
LONGEST = 3600  # s, of one program; without optimisation and on a busy machine one takes a quarter of an hour


class Coverage:
    """Lines and branches of one file, over all programs and all instances of its templates."""

    def __init__(self):
        self.lines = collections.defaultdict(int)
        self.branches = collections.defaultdict(dict)  # of a line: how often each was taken, by its place in the line

    def add(self, lines):
        for line in lines:
            number = line["line_number"]
            self.lines[number] += line["count"]
            for place, count in enumerate(decisions(line.get("branches", []))):
                self.branches[number][place] = self.branches[number].get(place, 0) + count

    def ran(self):
        return sum(1 for count in self.lines.values() if count)

    def never(self):
        """Lines with ways never taken: [(line, how many, of how many)]."""
        counted = [(n, sum(1 for c in ways.values() if not c), len(ways)) for n, ways in sorted(self.branches.items())]
        return [row for row in counted if row[1]]


def decisions(branches):
    """How often each way was taken; a call that may throw is a pair of branches, and none of the source's."""
    ways = []
    for branch in branches:
        if not branch["throw"]:
            ways.append(branch["count"])
        elif ways:
            ways.pop()
    return ways


def sources(root):
    """Of the folders, as far as a desk compiles them."""
    found = [path.relative_to(root) for folder in FOLDERS for path in sorted((root / folder).rglob("*.cpp"))]
    left_out = (FOR_BOARDS.match, ON_A_KERNEL.match, STAND_IN.search)
    return [str(path) for path in found if not any(matches(str(path)) for matches in left_out)]


def programs(build):
    """The unit tests' programs: hal, drivers and firmware."""
    found = []
    for folder in FOLDERS:
        for path in sorted((build / "tests" / folder).rglob("*_test")):
            if path.is_file() and os.access(path, os.X_OK) and path.name not in NO_UNIT_TESTS:
                found.append(path)
    return found


def run(program):
    begin = time.monotonic()
    command = [program, "--gtest_brief=1", "--gtest_filter=-" + LEFT_OUT.get(program.name, "")]
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=LONGEST)
    except subprocess.TimeoutExpired:
        print(f"{program.name}: longer than {LONGEST} s", file=sys.stderr)
        return False
    if done.returncode:
        print(done.stdout[-4000:], done.stderr[-2000:], file=sys.stderr)
    print(f"{program.name}: {time.monotonic() - begin:.0f} s", file=sys.stderr)
    return done.returncode == 0


def collect(documents, root):
    """`documents`: what gcov says of each object, as JSON."""
    files = collections.defaultdict(Coverage)
    for document in documents:
        for entry in document["files"]:
            name = pathlib.Path(os.path.normpath(os.path.join(document["current_working_directory"], entry["file"])))
            if name.is_relative_to(root) and str(name.relative_to(root)).split("/")[0] in FOLDERS:
                files[str(name.relative_to(root))].add(entry["lines"])
    return files


def counted(build):
    """The report of gcov on each object that ran."""
    for counts in sorted(build.rglob("*.gcda")):
        done = subprocess.run(["gcov", "--json-format", "--stdout", "--branch-probabilities", counts], cwd=build,
                              check=True, capture_output=True, text=True)
        for line in done.stdout.splitlines():
            yield json.loads(line)


def compiled(build, root):
    """Sources in objects that ran, also those without a line of their own: data, or a template's instances."""
    found = set()
    for counts in build.rglob("*.gcda"):
        source = counts.with_suffix("")  # where it is many in one, that is in the build and includes them
        if source.exists():
            found.update(re.findall(r'^#include "(.*)"', source.read_text(), re.MULTILINE))
        else:
            place = re.sub(r"CMakeFiles/[^/]*[.]dir/", "", str(source.relative_to(build)))
            found.add(str(root / place))
    return {str(pathlib.Path(name).relative_to(root)) for name in found if pathlib.Path(name).is_relative_to(root)}


def shares(files):
    """Of each folder: lines that ran, lines that can."""
    total = {folder: [0, 0] for folder in FOLDERS}
    total["hal, by tests/guest"] = [0, 0]
    for name, coverage in files.items():
        counts = total["hal, by tests/guest" if ON_A_KERNEL.match(name) else name.split("/")[0]]
        counts[0] += coverage.ran()
        counts[1] += len(coverage.lines)
    return total


def undecided(files, root):
    """Branches of decoders that are never taken: [(place, how many, of how many, source)]."""
    found = []
    for name in sorted(filter(DECODERS.match, files)):
        text = (root / name).read_text().splitlines()
        for line, never, ways in files[name].never():
            may_lack = max((most for words, (most, _) in DECIDED.items() if words in text[line - 1]), default=0)
            if never > may_lack:
                found.append((f"{name}:{line}", never, ways, text[line - 1].strip()))
    return found


def lines_not_run(files, root):
    for name in sorted(files):
        text = (root / name).read_text().splitlines()
        for line in (line for line, count in sorted(files[name].lines.items()) if not count):
            yield f"{name}:{line}: {text[line - 1].strip()}"


def report(files, root, least, known):
    """Prints all; true: enough. `known`: the sources that have to be there."""
    enough = True
    print("| folder | lines | run | % |\n|---|---|---|---|")
    for folder, (ran, lines) in shares(files).items():
        percent = 100 * ran / lines if lines else 0
        enough = enough and (percent >= least or folder not in FOLDERS)
        print(f"| {folder} | {lines} | {ran} | {percent:.1f} |")
    missing = {name: len(coverage.lines) - coverage.ran() for name, coverage in files.items()}
    for name in sorted(filter(missing.get, missing), key=missing.get, reverse=True)[:12]:
        print(f"{name}: {missing[name]} lines not run")
    unknown = [name for name in known if name not in files]
    for name in unknown:
        print(f"{name}: in no unit test")
    left = undecided(files, root)
    for place, never, ways, source in left:
        print(f"{place}: {never} of {ways} branches never taken: {source}")
    decoders = [name for name in files if DECODERS.match(name)]
    branches = sum(len(ways) for name in decoders for ways in files[name].branches.values())
    print(f"{branches} branches in {len(decoders)} files of decoders, never taken {sum(row[1] for row in left)}")
    return enough and not left and not unknown


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--least", type=float, default=95)
    parser.add_argument("--jobs", type=int, default=1, help="programs at once")
    parser.add_argument("--lines", action="store_true")
    arguments = parser.parse_args()
    root = pathlib.Path(__file__).resolve().parents[2]
    build = arguments.build.resolve()
    all_programs = programs(build)
    if not all_programs:
        sys.exit(f"no test programs in {build}/tests: build tests/hal/all, tests/drivers/all, tests/firmware/all")
    for counts in build.rglob("*.gcda"):  # of earlier runs
        counts.unlink()
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:  # their counts go to the same files, in turn
        failed = [program.name for program, passed in zip(all_programs, pool.map(run, all_programs)) if not passed]
    for name in failed:
        print(f"{name}: FAILED", file=sys.stderr)
    files = collect(counted(build), root)
    without_lines = compiled(build, root) - files.keys()
    enough = report(files, root, arguments.least, [name for name in sources(root) if name not in without_lines])
    if arguments.lines:
        print(*lines_not_run(files, root), sep="\n")
    sys.exit(0 if enough and not failed else 1)


if __name__ == "__main__":
    main()
