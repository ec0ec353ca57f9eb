#!/usr/bin/env python3
"""usage: run.py SOURCES FOLDER [--mutants N] [--seed S] [--jobs J] [--minutes M]
              [--under PATH[,PATH...]] [--only ID[,ID...]]

Mutation testing of the robot's code. SOURCES (a checkout) is copied to FOLDER, every mutant is written into the copy
(mutate.py), and its unit tests are built once. N mutants drawn from S (default 1000 and 1) are judged by those tests that
reach them (judge.py). A mutant is killed if a test fails, crashes or takes five times as long; one that no test reaches
has survived. After M minutes of judging the rest is left: figures are of the mutants that were judged. FOLDER is used
again: only what has changed is mutated, built and measured anew. --under draws only mutants of files whose path begins so.
Ends with the share killed and the survivors, by file; FOLDER/survivors.txt has them, FOLDER/results.json all. Exit status
1 below 90 %.
"""

import argparse
import collections
import concurrent.futures
import hashlib
import json
import os
import pathlib
import random
import subprocess
import sys
import time

sys.dont_write_bytecode = True  # a checkout stays as it is
import judge  # noqa: E402

ROOMS = ("firmware/recon", "firmware/alert", "firmware/record", "firmware/loop", "firmware/console", "firmware/config", "drivers")
JUDGES = ("tests/firmware/", "tests/drivers/")
NO_JUDGE = "_no_allocation_test"  # replaces the allocator, which the note of what it reaches needs
ENOUGH = 0.90


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, **options)


def write_if_other(path, content):
    if not path.is_file() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def with_switch(flags):
    # A shared library, so that no order of linking matters. Indices are checked, as the build with sanitizers does.
    return flags + (b"\nset(FENCEPOST_MUTATED ON)\n"
                    b"add_subdirectory(${PROJECT_SOURCE_DIR}/tests/mutation ${PROJECT_BINARY_DIR}/mutation)\n"
                    b"target_link_libraries(fencepost_flags INTERFACE fencepost_mutation)\n"
                    b"target_compile_options(fencepost_flags INTERFACE -w -Wno-error -g0 -O1 -D_GLIBCXX_ASSERTIONS)\n")


def copy_mutated(sources, folder):
    """Brings FOLDER/tree up to date; mutates anew only if a mutated source, or mutate.py, is another than last time."""
    tree, stamp = folder / "tree", folder / "mutated.sha256"
    listed = run("git", "-C", sources, "ls-files", "-z", "--cached", "--others", "--exclude-standard",
                 capture_output=True).stdout.decode().split("\0")
    names = sorted(name for name in listed if name and (sources / name).is_file())
    mutated = [name for name in names if name.startswith(tuple(room + "/" for room in ROOMS)) and name[-4:] in (".cpp", ".hpp")]
    digest = hashlib.sha256()
    for name in ["tests/mutation/mutate.py", *mutated]:
        digest.update(name.encode() + b"\0" + (sources / name).read_bytes())
    again = not stamp.is_file() or stamp.read_text() != digest.hexdigest()
    stamp.unlink(missing_ok=True)
    for name in names:
        content = (sources / name).read_bytes()
        if name == "toolchain/cmake/FencepostFlags.cmake":
            content = with_switch(content)
        if again or name not in set(mutated):
            write_if_other(tree / name, content)
    if again:
        run("/usr/bin/python3", "-B", tree / "tests/mutation/mutate.py", tree, folder / "mutants.json", *mutated)
    stamp.write_text(digest.hexdigest())


def judges(programs):
    """Of the tree's test programs, by folder and name, those whose tests judge."""
    return [pathlib.Path(program).name for program in programs.split() if program.startswith(JUDGES) and not program.endswith(NO_JUDGE)]


def build(folder, jobs):
    tree, made = folder / "tree", folder / "build"
    run("cmake", "--preset", "host", "-S", tree, "-B", made, "-DCMAKE_UNITY_BUILD=ON", cwd=tree, stdout=subprocess.DEVNULL)
    tests = judges((made / "test_programs.txt").read_text())
    run("cmake", "--build", made, "--parallel", jobs, "--target", *tests, stdout=subprocess.DEVNULL)
    found = {path.name: path for path in made.rglob("*_test") if path.is_file()}
    return [found[name] for name in tests]


def table(results, of):
    judged, killed = collections.Counter(map(of, results)), collections.Counter()
    for result in results:
        killed[of(result)] += result["killed_by"] is not None
    return [f"{name:18} {killed[name]:5} of {judged[name]:5} killed, {100 * killed[name] / judged[name]:5.1f} %" for name in sorted(judged)]


def report(results, sources, folder):
    survivors = sorted((result for result in results if result["killed_by"] is None), key=lambda mutant: (mutant["file"], mutant["line"]))
    lines = []
    for mutant in survivors:
        text = (sources / mutant["file"]).read_text().splitlines()[mutant["line"] - 1].strip()
        reached = f"{mutant['tests']} tests" if mutant["tests"] else "no test reaches it"
        lines.append(f"{mutant['id']} {mutant['file']}:{mutant['line']}: {mutant['what']} ({reached}): {text}")
    (folder / "survivors.txt").write_text("".join(line + "\n" for line in lines))
    (folder / "results.json").write_text(json.dumps(results))
    print("\n".join(lines))
    print("\n".join(table(results, lambda result: next(room for room in ROOMS if result["file"].startswith(room)))))
    print("\n".join(table(results, lambda result: result["operator"])))
    killed = len(results) - len(survivors)
    unreached = sum(not mutant["tests"] for mutant in survivors)
    slow = sum(mutant["killed_by"] == judge.TOO_SLOW for mutant in results)
    print(f"{killed} of {len(results)} mutants killed, {100 * killed / len(results):.1f} %; {slow} of them by taking too long; "
          f"{unreached} of the survivors are reached by no test")
    return killed >= ENOUGH * len(results)


def within(mutants, beginnings):
    """Those of files whose path begins so."""
    chosen = [mutant for mutant in mutants if mutant["file"].startswith(tuple(beginnings))]
    if not chosen:
        sys.exit(f"no mutant is in a file that begins with {' or '.join(beginnings)}; try --under firmware/recon/")
    return chosen


def cpu_seconds():
    times = os.times()
    return times.user + times.system + times.children_user + times.children_system


def main():
    parser = argparse.ArgumentParser(usage=__doc__.replace("%", "%%"))
    parser.add_argument("sources", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--mutants", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--minutes", type=float, default=float("inf"))
    parser.add_argument("--under", default="", help="draws only from mutants of files whose path begins so")
    parser.add_argument("--only", help="these mutants of FOLDER/mutants.json, not a sample")
    asked = parser.parse_args()
    sources, folder = asked.sources.resolve(), asked.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    took = [(time.monotonic(), cpu_seconds(), "")]

    def stage(name):
        took.append((time.monotonic(), cpu_seconds(), name))
        print(f"{name}: {took[-1][0] - took[-2][0]:.0f} s, {took[-1][1] - took[-2][1]:.0f} s of CPU", flush=True)

    copy_mutated(sources, folder)
    stage("mutating")
    programs = build(folder, asked.jobs)
    stage("building")
    known, none = judge.baseline(programs, folder, asked.jobs)
    stage(f"{len(known)} tests without a mutant")
    mutants = [mutant for mutant in json.loads((folder / "mutants.json").read_text()) if mutant["id"] not in none]
    mutants = within(mutants, asked.under.split(","))
    if asked.only:
        only = set(map(int, asked.only.split(",")))
        chosen = [mutant for mutant in mutants if mutant["id"] in only]
    else:
        chosen = random.Random(asked.seed).sample(mutants, min(asked.mutants, len(mutants)))
    jury, results = judge.Jury(known), []
    until = time.monotonic() + 60 * asked.minutes
    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        verdicts = pool.map(lambda mutant: jury.verdict(mutant) if time.monotonic() < until else None, chosen)
        for mutant, verdict in zip(chosen, verdicts):
            if verdict is not None:
                results.append({**mutant, **verdict})
            if len(results) % 50 == 0:
                print(f"{len(results)} of {len(chosen)} after {time.monotonic() - took[-1][0]:.0f} s", file=sys.stderr, flush=True)
    good = report(results, sources, folder)
    stage(f"judging {len(results)} of {len(chosen)} drawn from {len(mutants)} mutants by seed {asked.seed}")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
