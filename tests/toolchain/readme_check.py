#!/usr/bin/env python3
"""usage: readme_check.py [ROOT]

Holds what README.md says of the code: each path in its backticks and links exists, each name of a namespace is declared,
each test of the paper's table is one, and the ten minutes of reading open no more other files than they say. So it does
for the tests in robustness.md's tables. The sentence of safety.md that must not fail is there.
Prints one line per fault; exit status 1 if there is any.
"""

import fnmatch
import re
import sys

import command

LAYERS = ("hal", "drivers", "firmware", "host", "tests", "toolchain")
MOST_BEYOND = 8  # files that ten minutes of reading may make one open beside those it names
ROBUSTNESS = "host/share/doc/robustness.md"
SAFETY = "host/share/doc/safety.md"
PROMISE = "The absence of an alert does not mean that the way is free."
NAMESPACES = {"recon": "firmware/recon"}
GTEST = re.compile(r"^(?:TYPED_|INSTANTIATE_TYPED_)?TEST(?:_F|_P|_SUITE_P)?\((\w+),\s*(\w+)", re.MULTILINE)
CTEST = re.compile(r"add_test\(\s*NAME\s+([\w.]+)")


def marked(text):
    """(line number, what stands in backticks or behind a link)"""
    fenced = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.startswith("```"):
            fenced = not fenced
        if fenced or line.startswith("    "):
            continue
        for match in re.finditer(r"`([^`]+)`|\]\(([^)#]+)\)", line):
            yield number, match.group(1) or match.group(2)


def paths_in(root, text):
    """(line number, path): what looks like a path of the repository; a bare file name follows the folder before it."""
    folder = root
    for number, word in marked(text):
        if "/" in word and " " not in word and word.split("/")[0] in (*LAYERS, ".github"):
            folder = (root / word).parent
            yield number, root / word
        elif re.fullmatch(r"[\w.]+\.(?:hpp|cpp|md|csv)", word):
            found = folder / word if (folder / word).is_file() else root / word
            yield number, found if found.is_file() else root / "host/share/doc" / word


def tests_of(root):
    names = set()
    for path in sorted((root / "tests").rglob("*")):
        if path.suffix == ".cpp":
            names |= {f"{suite}.{case}" for suite, case in GTEST.findall(path.read_text(encoding="utf-8"))}
        elif path.name == "CMakeLists.txt":
            names |= set(CTEST.findall(path.read_text(encoding="utf-8")))
    return names


def table_tests(text, header):
    """(line number, pattern) of the last column of the tables that begin with `header`"""
    inside = False
    for number, line in enumerate(text.split("\n"), 1):
        inside = line.startswith(header) or (inside and line.startswith("|"))
        if not inside or line.startswith((header, "|---")):
            continue
        for word in re.findall(r"`([^`]+)`", line.rstrip().rstrip("|").rsplit("|", 1)[-1]):
            yield number, word


def fault_of_test(root, word, tests):
    if word.startswith("toolchain/long "):
        part = word.split()[1]
        known = f"part_{part}()" in (root / "toolchain/long").read_text(encoding="utf-8")
        return None if known else f"toolchain/long has no part {part}"
    matches = any(fnmatch.fnmatch(name, word) or name.startswith(word) for name in tests)
    return None if matches else f"no test is called {word}"


def opened_beyond(root, text):
    """The project's headers that the files of the reading path include and the path does not name; None without one."""
    section = re.search(r"^## Ten minutes of reading\n(.*?)(?=^## |\Z)", text, re.MULTILINE | re.DOTALL)
    if not section:
        return None
    listed = {path for _, path in paths_in(root, section.group(1)) if path.suffix == ".hpp" and path.is_file()}
    included = {
        root / name
        for path in listed
        for name in re.findall(r'^#include "([^"]+)"', path.read_text(encoding="utf-8"), re.MULTILINE)
    }
    return sorted(included - listed)


def fault_of_path(root, text):
    beyond = opened_beyond(root, text)
    said = re.search(r"include (\d+) more", text)
    if beyond is None or not said:
        return "README.md: no reading path that says how many more headers it includes"
    if int(said.group(1)) == len(beyond) <= MOST_BEYOND:
        return None
    names = ", ".join(path.relative_to(root).as_posix() for path in beyond)
    return f"README.md: the reading path includes {len(beyond)} more headers, at most {MOST_BEYOND}: {names}"


def check(root):
    """(faults, how many things were compared)"""
    text = (root / "README.md").read_text(encoding="utf-8")
    faults, compared = [], 0
    for number, path in paths_in(root, text):
        compared += 1
        if not path.exists():
            faults.append(f"README.md:{number}: there is no {path.relative_to(root).as_posix()}")
    for number, word in marked(text):
        name = re.fullmatch(r"(\w+)::(\w+)", word)
        if not name or name.group(1) not in NAMESPACES:
            continue
        compared += 1
        headers = (root / NAMESPACES[name.group(1)]).rglob("*.hpp")
        if not any(re.search(rf"\b{name.group(2)}\b", h.read_text(encoding="utf-8")) for h in headers):
            faults.append(f"README.md:{number}: {word} is declared nowhere")
    path_fault = fault_of_path(root, text)
    compared += 1
    if path_fault:
        faults.append(path_fault)
    compared += 1
    if PROMISE not in " ".join((root / SAFETY).read_text(encoding="utf-8").split()):
        faults.append(f"{SAFETY}: it does not say: {PROMISE}")
    tests = tests_of(root)
    for name, header in (("README.md", "| paper |"), (ROBUSTNESS, "| what was done |")):
        for number, word in table_tests((root / name).read_text(encoding="utf-8"), header):
            compared += 1
            fault = fault_of_test(root, word, tests)
            if fault:
                faults.append(f"{name}:{number}: {fault}")
    return faults, compared


if __name__ == "__main__":
    sys.exit(command.run(__doc__, check, "things"))
