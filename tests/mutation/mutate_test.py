#!/usr/bin/env python3
"""usage: mutate_test.py SOURCES COMPILER FOLDER PROGRAMS

Mutates a small program by every operator and runs it with each mutant. It has to print what that mutant means, and
without a mutant its output is unchanged. And run.py's --under takes the mutants of the folders that it names. Its judges
are the tests of each room among PROGRAMS, which CMake lists.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys

sys.dont_write_bytecode = True

SAMPLE = """#include <cstdio>
consteval int doubled(int a) { return 2 * a; }
constexpr int kFixed = 1 + doubled(2);
template <class T>
bool less(T a, T b) { return a < b; }
template <int N>
struct Room { int held[N + 1]; };
template struct Room<3>;
int three(int a, bool on) {
  Room<2 + 1> sums = {};
  int& sum = sums.held[0];
  sum += a;
  if (!on && a >= 3) return -a;
  return sum - 7;
}
int main() {
  std::printf("%d %d %d %d\\n", kFixed, less(2, 2) ? 1 : 0, three(3, false), three(5, true));
}
"""
USUAL = "5 0 -3 -2"
# The output of each mutant, by its line and its description.
MEANS = {(5, "< is <="): "5 1 -3 -2", (12, "statement left out"): "5 0 -3 -7", (13, "right side of && ignored"): USUAL,
         (13, "! left out"): "5 0 -4 -5", (13, ">= is >"): "5 0 -4 -2", (13, "3 is more"): "5 0 -4 -2", (13, "- left out"): "5 0 3 -2",
         (14, "- is +"): "5 0 -3 12", (14, "7 is more"): "5 0 -3 -3", (17, "statement left out"): "",
         (17, "2 is more"): None, (17, "1 is more"): USUAL, (17, "3 is more"): "5 0 -4 -2", (17, "5 is more"): "5 0 -3 -1"}


def faults_of_under(run):
    all_of_them = [{"file": "drivers/wire/crc.cpp"}, {"file": "firmware/recon/map.hpp"}, {"file": "firmware/reconnect.cpp"}]
    of_recon = run.within(all_of_them, ["firmware/recon/"]) == all_of_them[1:2]
    of_both = run.within(all_of_them, ["firmware/recon/", "drivers/"]) == all_of_them[:2]
    return [] if of_recon and of_both and run.within(all_of_them, [""]) == all_of_them else ["--under takes others"]


def faults_of_judges(run, programs):
    some = ["tests/drivers/nxt_test", "tests/firmware/loop/loop_test", "tests/firmware/loop/loop_no_allocation_test", "tests/host/text/text_test"]
    if run.judges("\n".join(some)) != ["nxt_test", "loop_test"]:
        return ["others than the tests of firmware and drivers judge"]
    listed = [program for program in programs.read_text().split() if program.startswith(run.JUDGES)]
    if not listed:
        return []  # a tree with the rest of the tests alone
    return [f"no test of {room} judges" for room in run.ROOMS if not any(program.startswith(f"tests/{room}/") for program in listed)]


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__)
    sources, compiler, folder, programs = pathlib.Path(sys.argv[1]), sys.argv[2], pathlib.Path(sys.argv[3]), pathlib.Path(sys.argv[4])
    sys.path.insert(0, str(sources / "tests/mutation"))
    import run
    if subprocess.run(["/usr/bin/python3", "-c", "import clang.cindex"], check=False, capture_output=True).returncode:
        print("NOT TESTED: clang's Python bindings are not here; try 'toolchain/setup mutation'")
        return 77
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "sample.cpp").write_text(SAMPLE)
    subprocess.run(["/usr/bin/python3", "-B", sources / "tests/mutation/mutate.py", folder, folder / "mutants.json", "sample.cpp"],
                   check=True)
    subprocess.run([compiler, "-std=c++20", f"-I{sources}", folder / "sample.cpp", sources / "tests/mutation/mutation.cpp", "-o",
                    folder / "sample"], check=True)

    def prints(mutant):
        return subprocess.run([folder / "sample"], env={**os.environ, "FENCEPOST_MUTANT": str(mutant)}, check=True,
                              capture_output=True, text=True).stdout.strip()

    faults = faults_of_under(run) + faults_of_judges(run, programs)
    if prints(-1) != USUAL:
        faults.append(f"without a mutant it prints {prints(-1)}")
    mutants = json.loads((folder / "mutants.json").read_text())
    if {(mutant["line"], mutant["what"]) for mutant in mutants} != set(MEANS):
        faults.append(f"other mutants: {[(mutant['line'], mutant['what']) for mutant in mutants]}")
    for mutant in mutants:
        means, printed = MEANS.get((mutant["line"], mutant["what"])), prints(mutant["id"])
        if means is not None and printed != means:
            faults.append(f"line {mutant['line']}, {mutant['what']}: prints {printed}, not {means}")
    print("\n".join(faults) or f"{len(mutants)} mutants do what they say")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
