#!/usr/bin/env python3
"""usage: run.py SOURCES FOLDER [--mutants N] [--seed S] [--jobs J]

Mutation testing of the robot's code: SOURCES (a checkout) is copied to FOLDER, every mutant written into the copy
(mutate.py), its unit tests built once, and N mutants drawn from S (default 1000 and 1) judged by those tests that reach
them. A mutant is killed if a test fails, crashes or takes five times as long. Ends with the share killed and the
survivors, by file; FOLDER/survivors.txt has them, FOLDER/results.json all. Exit status 1 below 90 %.
"""

import argparse
import collections
import concurrent.futures
import json
import os
import pathlib
import random
import shutil
import subprocess
import sys
import time

ROOMS = ("firmware/recon", "firmware/alert", "firmware/record", "firmware/loop", "drivers")
TESTS = ("hal_base_test", "hal_sensor_test", "alert_test", "record_test", "loop_test", "console_test", "library_test",
         "recon_test", "recon_guard_test", "recon_hybrid_test", "recon_pose_test", "recon_sheaf_test", "recon_exactness_test",
         "can_wheels_test", "cmucam_test", "cognachrome_test", "create_test", "huskylens_test", "jevois_test", "nxt_test",
         "nxtcam_test", "odometry_test", "pixy1_test", "pixy2_test", "xbc_test", "serial_test", "wire_test")
ENOUGH = 0.90


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, **options)


def copy(sources, tree):
    if tree.exists():
        shutil.rmtree(tree)
    listed = subprocess.run(["git", "-C", sources, "ls-files", "-z", "--cached", "--others", "--exclude-standard"], check=True,
                            capture_output=True).stdout.decode().split("\0")
    for name in filter(None, listed):
        if (sources / name).is_file():
            (tree / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(sources / name, tree / name)


def mutate(tree, mutants):
    paths = sorted(str(path.relative_to(tree)) for room in ROOMS for path in (tree / room).rglob("*.?pp"))
    run("/usr/bin/python3", "-B", tree / "tests/mutation/mutate.py", tree, mutants, *paths)
    flags = tree / "toolchain/cmake/FencepostFlags.cmake"
    # A shared library, so that no order of linking matters.
    flags.write_text(flags.read_text() + "\nset(FENCEPOST_MUTATED ON)\n"
                     "add_subdirectory(${PROJECT_SOURCE_DIR}/tests/mutation ${PROJECT_BINARY_DIR}/mutation)\n"
                     "target_link_libraries(fencepost_flags INTERFACE fencepost_mutation)\n"
                     "target_compile_options(fencepost_flags INTERFACE -w -Wno-error -g0 -O1)\n")


def build(tree, folder, jobs):
    run("cmake", "--preset", "host", "-S", tree, "-B", folder / "build", "-DCMAKE_UNITY_BUILD=ON", cwd=tree,
        stdout=subprocess.DEVNULL)
    run("cmake", "--build", folder / "build", "--parallel", jobs, "--target", *TESTS, stdout=subprocess.DEVNULL)
    found = {path.name: path for path in (folder / "build").rglob("*_test") if path.is_file()}
    return [found[name] for name in TESTS]


def test(program, limit, **environment):
    begun = time.monotonic()
    try:
        done = subprocess.run([program, "--gtest_brief=1", "--gtest_fail_fast"], env={**os.environ, **environment},
                              capture_output=True, timeout=limit, cwd=program.parent, check=False)
        return done.returncode == 0, time.monotonic() - begun
    except subprocess.TimeoutExpired:
        return False, limit


def baseline(programs, folder):
    """By program: how long it takes, and which mutants it reaches."""
    known = {}
    for program in programs:
        file = folder / (program.name + ".reached")
        file.unlink(missing_ok=True)
        passed, seconds = test(program, 600, FENCEPOST_MUTANTS_REACHED=str(file))
        if not passed:
            sys.exit(f"{program.name} fails without a mutant: run {program}")
        known[program] = (seconds, {int(line) for line in file.read_text().split()})
    return known


def judge(mutant, known):
    """The test program that kills it, or None; and what was tried."""
    reaching = sorted((seconds, program) for program, (seconds, reached) in known.items() if mutant["id"] in reached)
    for seconds, program in reaching:
        if not test(program, 5 * seconds + 5, FENCEPOST_MUTANT=str(mutant["id"]))[0]:
            return program.name, len(reaching)
    return None, len(reaching)


def report(results, folder, seconds):
    survivors = [result for result in results if result["killed_by"] is None]
    lines = [f"{mutant['file']}:{mutant['line']}: {mutant['what']}" + ("" if mutant["programs"] else " (no test reaches it)")
             for mutant in sorted(survivors, key=lambda mutant: (mutant["file"], mutant["line"]))]
    (folder / "survivors.txt").write_text("".join(line + "\n" for line in lines))
    (folder / "results.json").write_text(json.dumps(results))
    by_room = collections.Counter(), collections.Counter()
    for result in results:
        room = next(room for room in ROOMS if result["file"].startswith(room))
        by_room[0][room] += 1
        by_room[1][room] += result["killed_by"] is not None
    print("\n".join(lines))
    for room in ROOMS:
        print(f"{room:16} {by_room[1][room]:4} of {by_room[0][room]:4} killed")
    killed = len(results) - len(survivors)
    unreached = sum(not mutant["programs"] for mutant in survivors)
    print(f"{killed} of {len(results)} mutants killed, {100 * killed / len(results):.1f} %; {unreached} of the survivors are "
          f"reached by no test; {seconds:.0f} s")
    return killed >= ENOUGH * len(results)


def main():
    parser = argparse.ArgumentParser(usage=__doc__)
    parser.add_argument("sources", type=pathlib.Path)
    parser.add_argument("folder", type=pathlib.Path)
    parser.add_argument("--mutants", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    asked = parser.parse_args()
    folder, tree = asked.folder.resolve(), asked.folder.resolve() / "tree"
    copy(asked.sources.resolve(), tree)
    mutate(tree, folder / "mutants.json")
    programs = build(tree, folder, asked.jobs)
    known = baseline(programs, folder)
    mutants = json.loads((folder / "mutants.json").read_text())
    chosen = random.Random(asked.seed).sample(mutants, min(asked.mutants, len(mutants)))
    begun, results = time.monotonic(), []
    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        for mutant, (killer, tried) in zip(chosen, pool.map(lambda mutant: judge(mutant, known), chosen)):
            results.append({**mutant, "killed_by": killer, "programs": tried})
            if len(results) % 50 == 0:
                print(f"{len(results)} of {len(chosen)}, {time.monotonic() - begun:.0f} s", file=sys.stderr)
    return 0 if report(results, folder, time.monotonic() - begun) else 1


if __name__ == "__main__":
    sys.exit(main())
