#!/usr/bin/env python3
"""usage: record_figures.py FOLDER SIZES.csv STAGES.csv

Writes the figures that the tests of the boards have measured into the tables that they compare with. Prints each figure
that changed. FOLDER is FENCEPOST_FIGURES of their run. Instructions are rounded up to three digits, bytes to 16: the
next small change may cost that much without an explanation. Rows are those of the tables; each has to be measured.
"""

import csv
import pathlib
import sys


def rounded(value):
    step = 10 ** max(0, len(str(value)) - 3)
    return -(-value // step) * step


def read(path):
    """{name: [numbers]}"""
    return {name: [int(number) for number in numbers]
            for name, *numbers in (line.split() for line in path.read_text().splitlines())}


def stage_figures(folder, row):
    frame, worst = read(folder / f"{row['image']}-{row['pose']}.counts")[row["stage"]]
    return {"frame": rounded(frame), "worst": rounded(worst)}


def size_figures(folder, row):
    sizes = read(folder / f"{row['image']}.sizes")
    figures = {name: -(-sizes[name][0] // 16) * 16 for name in ("flash", "ram", "stack")}
    if row["frame"]:  # its frames are counted
        frame, worst = read(folder / f"{row['image']}-off.counts")["input"]
        figures |= {"frame": rounded(frame), "worst_frame": rounded(worst)}
    return figures


def record(folder, table, figures_of):
    with table.open(newline="") as file:
        reader = csv.DictReader(file)
        names, rows = reader.fieldnames, list(reader)
    for row in rows:
        for name, figure in figures_of(folder, row).items():
            if row[name] != str(figure):
                label = ",".join(value for key, value in row.items() if key in ("image", "pose", "stage"))
                print(f"{table.name} {label} {name}: {row[name]} -> {figure}")
                row[name] = str(figure)
    with table.open("w", newline="") as file:
        writer = csv.DictWriter(file, names, lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)


def main():
    if len(sys.argv) != 4:
        sys.exit(__doc__.strip())
    folder, sizes, stages = map(pathlib.Path, sys.argv[1:])
    try:
        record(folder, sizes, size_figures)
        record(folder, stages, stage_figures)
    except (FileNotFoundError, KeyError) as error:
        sys.exit(f"record_figures: not measured: {error}")


if __name__ == "__main__":
    main()
