"""Which tests reach which mutant, and whether one of them kills it."""

import collections
import concurrent.futures
import hashlib
import json
import os
import re
import subprocess
import sys
import threading
import time

TOO_SLOW = "(too slow)"
ROUND_SECONDS = 0.3  # of tests that are run before others of another program are asked


def run_tests(program, names, limit, **environment):
    """The first failure (a test, TOO_SLOW, or the program if it crashed), or None; and the seconds it took."""
    begun = time.monotonic()
    try:
        done = subprocess.run([program, "--gtest_brief=1", "--gtest_fail_fast"], capture_output=True, timeout=limit, check=False,
                              cwd=os.path.dirname(program), env={**os.environ, "GTEST_FILTER": ":".join(names), **environment})
    except subprocess.TimeoutExpired:
        return TOO_SLOW, limit
    failed = None
    if done.returncode != 0:
        said = re.search(r"\[  FAILED  \] ([\w./]+)", done.stdout.decode(errors="replace"))
        failed = said.group(1) if said else os.path.basename(program)
    return failed, time.monotonic() - begun


def list_tests(program):
    suite, names = "", []
    for line in subprocess.run([program, "--gtest_list_tests"], check=True, capture_output=True, text=True).stdout.splitlines():
        word = line.split("#")[0].rstrip()
        if word.startswith("  "):
            names.append(suite + word.strip())
        elif word.endswith("."):
            suite = word
    return [name for name in names if "DISABLED_" not in name]


def measure(program, folder):
    """By test of a program: its seconds, and the mutants it reaches. Kept in the folder as long as the program is the same."""
    digest = hashlib.sha256(program.read_bytes()).hexdigest()
    kept = folder / (program.name + ".json")
    if kept.is_file():
        known = json.loads(kept.read_text())
        if known["program"] == digest:
            return known["tests"]
    tests, file = {}, folder / (program.name + ".reached")
    for name in list_tests(program):
        file.unlink(missing_ok=True)
        failed, seconds = run_tests(program, [name], 600, FENCEPOST_MUTANTS_REACHED=str(file))
        if failed is not None:
            sys.exit(f"{name} fails without a mutant: {program} --gtest_filter={name}")
        lines = file.read_text().splitlines() if file.exists() else []  # a program without a mutant does not load the switch
        notes = [tuple(map(int, line.split())) for line in lines]
        tests[name] = {"seconds": seconds, "reached": [mutant for mutant, note in notes if note & 1],
                       "none": [mutant for mutant, note in notes if note == 2]}
    kept.write_text(json.dumps({"program": digest, "tests": tests}))
    return tests


def baseline(programs, folder, jobs):
    """By (program, test): its seconds, and the mutants it reaches; and the numbers behind which no mutant is (mutation.hpp)."""
    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        measured = list(pool.map(lambda program: measure(program, folder), programs))
    known = {(str(program), name): (test["seconds"], test["reached"])
             for program, tests in zip(programs, measured) for name, test in tests.items()}
    reached = {mutant for _, mutants in known.values() for mutant in mutants}
    return known, {mutant for tests in measured for test in tests.values() for mutant in test["none"]} - reached


class Jury:
    """Asks first the tests that have killed most in a mutant's file, of others the quickest."""

    def __init__(self, known):
        self.known = known
        self.reaching = collections.defaultdict(list)
        for test, (_, reached) in known.items():
            for mutant in reached:
                self.reaching[mutant].append(test)
        self.kills = collections.defaultdict(collections.Counter)  # by file, of tests
        self.lock = threading.Lock()

    def rounds(self, mutant):
        with self.lock:
            kills = dict(self.kills[mutant["file"]])
        left = sorted(self.reaching[mutant["id"]], key=lambda test: (-kills.get(test[1], 0), self.known[test][0]))
        while left:
            seconds, chosen = 0.0, collections.defaultdict(list)
            while left and (not chosen or seconds + self.known[left[0]][0] <= ROUND_SECONDS):
                seconds += self.known[left[0]][0]
                program, name = left.pop(0)
                chosen[program].append(name)
            yield from chosen.items()

    def verdict(self, mutant):
        begun = time.monotonic()
        killer = None
        for program, names in self.rounds(mutant):
            limit = 5 * sum(self.known[program, name][0] for name in names) + 5
            killer, _ = run_tests(program, names, limit, FENCEPOST_MUTANT=str(mutant["id"]))
            if killer is not None:
                with self.lock:
                    self.kills[mutant["file"]][killer] += 1
                break
        return {"killed_by": killer, "tests": len(self.reaching[mutant["id"]]), "seconds": round(time.monotonic() - begun, 2)}
