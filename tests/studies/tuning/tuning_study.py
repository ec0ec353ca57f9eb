#!/usr/bin/env python3
"""usage: tuning_study.py SOURCES FOLDER [--world FOLDER] [--first-seed S] [--blocks B] [NAME...]

Judges each number of firmware/recon/**/tuning.hpp, or those with a NAME, at half and at twice its value. SOURCES (a
checkout) is copied to FOLDER/tree, its numbers are made switchable (switchable.py), and six studies are built once. They
judge on B blocks of seeds from S on, the same for each setting. The world's drives are shared out among the blocks.
Prints a table for each folder. FOLDER/figures_S.json keeps what has been measured; nothing is measured twice.
"""

import argparse
import functools
import json
import math
import os
import pathlib
import re
import statistics
import subprocess
import sys
import textwrap
import zlib

sys.dont_write_bytecode = True  # a checkout stays as it is
import switchable  # noqa: E402

FACTORS = (0.5, 2.0)
FEWEST_BLOCKS = 2
CLEAR = 2.0  # standard errors of a paired difference from which on it is marked
LONGEST = 100  # s; a block takes one or two: a number that makes it hang is reported to fail
TODAY = "today 1"
TARGETS = ("hybrid_table", "path_table", "alert_study", "hazard_table", "drift_study", "world_study")
COLUMNS = {"hybrid": 1, "past": 1, "cylinder": 1, "late": 1, "false": 1, "broken": 1, "lens": 1, "pose": 0, "small": 0,
           "colours": 1, "detector": 1}  # and their decimals; less is better in all
SAFETY, ROUND, CARS, POSE = ("late", "false", "broken"), ("past", "cylinder"), ("colours", "detector"), ("pose", "small")
# The columns that judge a number, by its folder: it changes hardly any other.
JUDGED_BY = {"guard": SAFETY, "track": SAFETY + CARS, "models": SAFETY + ROUND + CARS, "observe": SAFETY + ROUND + CARS + POSE,
             "hybrid": ("hybrid", "past", "pose"), "localize": ("late", "false") + POSE}


def rows_of(text, first):
    """The cells of the rows of Markdown tables whose first cell matches."""
    rows = [[cell.strip() for cell in line.strip("|\n").split("|")] for line in text.split("\n") if line.startswith("|")]
    return [row for row in rows if re.match(first, row[0])]


def numbers_of(cell):
    return [float(number) for number in re.findall(r"\d+(?:\.\d+)?", cell)]


def hybrid(text):  # R + P, %, with inferred flags
    row = rows_of(text[text.index("inferred flags"):], "2$")[0]
    return {"hybrid": statistics.fmean(sum(numbers_of(cell)[:2]) for cell in row[1:])}


def paths(text):  # R + P, %, of hybrid and cylinder
    rows = rows_of(text, "(?!path|---)")
    return {"past": statistics.fmean(sum(numbers_of(row[2])) for row in rows),
            "cylinder": statistics.fmean(float(row[-1]) for row in rows)}


def alerts(text):  # obstacles stopped for too late or never, and false stops
    row = [numbers_of(cell) for cell in rows_of(text, "2$")[0]]
    return {"late": row[5][0] + row[6][0], "false": row[9][0]}


def hazards(column, text):  # broken promises, %
    rows = [row for row in rows_of(text, "") if row[1] == "fencepost"]
    return {column: sum((100 - float(row[3])) * int(row[4]) for row in rows) / sum(int(row[4]) for row in rows)}


def drift(column, text):  # error of the corrected position, mm
    return {column: numbers_of(rows_of(text, "3 %")[-1][2])[0]}


def world(column, text):  # parked cars that are missed, and objects that are no parked car
    row = rows_of(text, "one signature|detector")[0]
    found, seen = numbers_of(row[2])
    return {column: seen - found + numbers_of(row[3])[0]}


def judges(seed, block, drives):
    """(program below tests/studies, its arguments, what reads its figures, their columns) for one block"""
    def seeds(number, word="--scenes"):
        return [word, str(number), "--first-seed", str(seed + 1000 * block)]
    yield "tables/hybrid_table", ["--levels", "2", "--views", "sequential", *seeds(3)], hybrid, ["hybrid"]
    yield "paths/path_table", ["--drift", "off", *seeds(2)], paths, ["past", "cylinder"]
    yield "alerts/alert_study", ["--levels", "2", *seeds(60, "--approaches")], alerts, ["late", "false"]
    for families, column in (("walls,movers,removal,bases,turning", "broken"), ("cameras", "lens")):
        yield ("hazards/hazard_table", ["--who", "fencepost", "--family", families, *seeds(1, "--runs")],
               functools.partial(hazards, column), [column])
    for profile, column in (("full", "pose"), ("small", "small")):
        yield ("drift/drift_study", ["--drifts", "3", "--loops", "1", "--no-judgement", "--profile", profile, *seeds(5)],
               functools.partial(drift, column), [column])
    for row, column in (("one signature, pitch 0", "colours"), ("detector, pitch 0", "detector")) if drives.is_dir() else ():
        yield ("world/world_study", ["--only", row, "--correct", "auto", "--data", str(drives)],
               functools.partial(world, column), [column])


def prepare(sources, tree):
    """Brings the switchable copy up to date, and builds it; its numbers."""
    listed = subprocess.run(["git", "-C", sources, "ls-files", "-z", "-co", "--exclude-standard"], check=True,
                            capture_output=True).stdout
    tree.mkdir(parents=True, exist_ok=True)
    subprocess.run(["xargs", "-0", "cp", "-u", "--parents", "-t", tree.resolve()], input=listed, cwd=sources, check=True)
    names = [name for name in listed.decode().split("\0") if name.endswith((".hpp", ".cpp"))]
    code, numbers = switchable.tree({name: (sources / name).read_text(encoding="utf-8") for name in names})
    for name, text in code.items():
        if not (tree / name).is_file() or (tree / name).read_text(encoding="utf-8") != text:
            (tree / name).write_text(text, encoding="utf-8")
    for step in (["--preset", "release", "-DCMAKE_UNITY_BUILD=ON", "-DCMAKE_CXX_FLAGS=-w"],
                 ["--build", "--preset", "release", "--target", *TARGETS]):
        subprocess.run(["cmake", *step], cwd=tree, check=True, stdout=sys.stderr)
    return numbers


def share_out(world, into, blocks):
    drives = sorted((world / "kitti").glob("*")) if world else []
    if not drives:
        print("SKIPPED: NO RECORDING OF OTHERS JUDGES; --world names ../shared/data/world", file=sys.stderr)
    for i, drive in enumerate(drives):
        link = into / str(i % blocks) / "kitti" / drive.name
        link.parent.mkdir(parents=True, exist_ok=True)
        if not link.is_symlink():
            link.symlink_to(drive.resolve())


def measure(programs, setting, judged, wanted):
    """The figures of a block by column; None where a program fails."""
    name, factor = setting.split()
    figures = {}
    for program, arguments, read, columns in judged:
        if wanted.isdisjoint(columns):
            continue
        try:
            done = subprocess.run([programs / program, *arguments], capture_output=True, text=True, timeout=LONGEST,
                                  env=os.environ | {"TUNING_NAME": name, "TUNING_FACTOR": factor})
            figures |= read(done.stdout)
            said = re.sub(r"[\d.]+ \|$", "", done.stdout, flags=re.M)  # the last column of hazards is seconds
            figures |= {f"said {column}": zlib.crc32(said.encode()) for column in columns}
        except (subprocess.TimeoutExpired, IndexError, ValueError, ZeroDivisionError):
            figures |= dict.fromkeys(columns)
    return figures


def changed(today, other, column):
    """Whether a judge has to go on: a setting that changes not a digit in FEWEST_BLOCKS is taken to change none."""
    blocks = [block for block in other if column in other[block]]
    said = f"said {column}"
    return len(blocks) < FEWEST_BLOCKS or any(other[block].get(said) != today[block].get(said) for block in blocks)


def error_of(values):
    return statistics.stdev(values) / math.sqrt(len(values))


def cell(today, other, column):
    """The mean change of a figure, in bold where it is clear."""
    pairs = [(today[block][column], figures[column]) for block, figures in other.items() if column in figures]
    if any(figure is None for _, figure in pairs):
        return "fails"
    changes = [figure - before for before, figure in pairs]
    if not any(changes):
        return "="
    text = f"{statistics.fmean(changes):+.{COLUMNS[column]}f}"
    return f"**{text}**" if abs(statistics.fmean(changes)) > CLEAR * error_of(changes) else text


def columns_of(number):
    return JUDGED_BY[number.folder] + (("lens",) if number.name.startswith("kLens") else ())


def table(figures, folder, numbers):
    today = figures[TODAY]
    judged = {column for number in numbers for column in columns_of(number)}
    columns = [column for column in COLUMNS if any(column in block for block in today.values()) and column in judged]
    yield f"\n## {folder}\n\n| number | today | " + " | ".join(columns) + " |\n|---|---|" + "---|" * len(columns)
    row = "| all as today | |"
    for column in columns:
        values = [block[column] for block in today.values() if column in block]
        row += f" {statistics.fmean(values):.{COLUMNS[column]}f} ± {error_of(values):.{COLUMNS[column]}f} |"
    yield row
    unchanged = []
    for number in numbers:
        cells = [" / ".join(cell(today, figures[f"{number.name} {factor}"], column) for factor in FACTORS)
                 if column in columns_of(number) else "" for column in columns]
        if set(cells) <= {"= / =", ""}:
            unchanged.append(number.name)
        else:
            yield f"| {number.name} | {number.value} | " + " | ".join(cells).replace("= / =", "=") + " |"
    if unchanged:
        yield "\n" + textwrap.fill("Not a digit changes by half or double " + ", ".join(unchanged) + ".", 120)


def main(arguments):
    parser = argparse.ArgumentParser(usage=__doc__.removeprefix("usage: "), add_help=False)
    parser.add_argument("sources", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--world", type=pathlib.Path)
    parser.add_argument("--first-seed", type=int, default=700001)
    parser.add_argument("--blocks", type=int, default=4)
    parser.add_argument("names", nargs="*")
    given = parser.parse_intermixed_args(arguments)
    tree, drives = given.folder.resolve() / "tree", given.folder.resolve() / f"drives_{given.blocks}"
    numbers = [number for number in prepare(given.sources.resolve(), tree)
               if number.name in given.names or not given.names and not number.derived]
    share_out(given.world, drives, given.blocks)
    kept = given.folder / f"figures_{given.first_seed}.json"
    figures = json.loads(kept.read_text()) if kept.is_file() else {}
    settings = [(TODAY, COLUMNS)] + [(f"{number.name} {factor}", columns_of(number)) for number in numbers for factor in FACTORS]
    for setting, columns in settings:
        for block in range(given.blocks):
            known = figures.setdefault(setting, {}).setdefault(str(block), {})
            wanted = {column for column in columns if column not in known
                      and (setting == TODAY or changed(figures[TODAY], figures[setting], column))}
            if wanted:
                known |= measure(tree / "build/release/tests/studies", setting,
                                 judges(given.first_seed, block, drives / str(block)), wanted)
                kept.with_suffix(".new").write_text(json.dumps(figures))
                kept.with_suffix(".new").replace(kept)  # whole, whenever the study is ended
    for folder in dict.fromkeys(number.folder for number in numbers):
        print("\n".join(table(figures, folder, [number for number in numbers if number.folder == folder])))


if __name__ == "__main__":
    main(sys.argv[1:])
