#!/usr/bin/env python3
"""usage: readme_check.py [ROOT]

Holds what the pages in PAGES say of the code. Each path in their backticks and links exists; each name of a namespace is
declared. Each constant that EQUATIONS.md names is declared, too. Each test of the paper's table is one, and of robustness.md's tables. The ten minutes of reading open no more
other files than they say. Links of all pages lead to files and headings that exist. The drawing of the zones has the settings' defaults. The index leads to
every page. README.md fits a screen or two, and its pages can be clicked on.
The sentence of safety.md that must not fail is there.
Prints one line per fault; exit status 1 if there is any.
"""

import fnmatch
import re
import sys

import command

LAYERS = ("hal", "drivers", "firmware", "host", "tests", "toolchain")
MOST_BEYOND = 8  # files that ten minutes of reading may make one open beside those it names
DOCUMENTS = "host/share/doc"
INDEX = "host/share/doc/README.md"
ARCHITECTURE = "host/share/doc/architecture.md"
PAPER = "host/share/doc/paper_to_code.md"
EQUATIONS = "firmware/recon/EQUATIONS.md"
PAGES = ("README.md", INDEX, ARCHITECTURE, PAPER, EQUATIONS)
DESK_MODELS = ("host/models", "host/relocation")  # of the same namespace: what no board links
ESTIMATORS = ("firmware/recon", "firmware/alert", *DESK_MODELS)  # whose equations they are
README_LINES, README_COLUMNS = 80, 120  # at most
ROBUSTNESS = "tests/results/robustness.md"
SAFETY = "host/share/doc/safety.md"
ZONES, SETTINGS = "host/share/doc/zones.svg", "firmware/config/settings.hpp"
PROMISE = "The absence of an alert does not mean that the way is free."
NAMESPACES = {"recon": ("firmware/recon", *DESK_MODELS)}
GTEST = re.compile(r"^(?:TYPED_|INSTANTIATE_TYPED_)?TEST(?:_F|_P|_SUITE_P)?\((\w+),\s*(\w+)", re.MULTILINE)
CTEST = re.compile(r"add_test\(\s*NAME\s+([\w.]+)")


def marked(text):
    """(line number, what stands in backticks or behind a link, whether it is a link's)"""
    fenced = False
    for number, line in enumerate(text.split("\n"), 1):
        if line.startswith("```"):
            fenced = not fenced
        if fenced or line.startswith("    "):
            continue
        for match in re.finditer(r"`([^`]+)`|\]\(([^)#]+)\)", line):
            yield number, match.group(1) or match.group(2), match.group(1) is None


def paths_in(root, name, text):
    """(line number, path): what looks like a path of the repository; a bare file name follows the folder before it."""
    folder = root
    for number, word, linked in marked(text):
        if linked:
            if "://" not in word:
                yield number, (root / name).parent / word
        elif "/" in word and " " not in word and word.split("/")[0] in (*LAYERS, ".github"):
            folder = (root / word).parent
            yield number, root / word
        elif re.fullmatch(r"[\w.]+\.(?:hpp|cpp|md|csv)", word):
            found = folder / word if (folder / word).is_file() else root / word
            yield number, found if found.is_file() else root / DOCUMENTS / word


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
    listed = {path for _, path in paths_in(root, ARCHITECTURE, section.group(1)) if path.suffix == ".hpp" and path.is_file()}
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
        return f"{ARCHITECTURE}: no reading path that says how many more headers it includes"
    if int(said.group(1)) == len(beyond) <= MOST_BEYOND:
        return None
    names = ", ".join(path.relative_to(root).as_posix() for path in beyond)
    return f"{ARCHITECTURE}: the reading path includes {len(beyond)} more headers, at most {MOST_BEYOND}: {names}"


def faults_of_page(root, name, text):
    """(faults, how many things were compared): its paths, and its names of a namespace"""
    faults, compared = [], 0
    for number, path in paths_in(root, name, text):
        compared += 1
        if not path.exists():
            faults.append(f"{name}:{number}: there is no {path.resolve().relative_to(root).as_posix()}")
    for number, word, _ in marked(text):
        scoped = re.fullmatch(r"(\w+)::(\w+)", word)
        if not scoped or scoped.group(1) not in NAMESPACES:
            continue
        compared += 1
        headers = [path for folder in NAMESPACES[scoped.group(1)] for path in (root / folder).rglob("*.hpp")]
        if not any(re.search(rf"\b{scoped.group(2)}\b", h.read_text(encoding="utf-8")) for h in headers):
            faults.append(f"{name}:{number}: {word} is declared nowhere")
    return faults, compared


def faults_of_equations(root, text):
    """(faults, how many constants were looked up)"""
    headers = [path for folder in ESTIMATORS for path in sorted((root / folder).rglob("*.hpp"))]
    declared = {name for path in headers for name in re.findall(r"\b(k[A-Z]\w*)\s*[={]", path.read_text(encoding="utf-8"))}
    named = [(number, name) for number, line in enumerate(text.split("\n"), 1) for name in re.findall(r"\bk[A-Z]\w*", line)]
    return [f"{EQUATIONS}:{number}: {name} is declared nowhere" for number, name in named if name not in declared], len(named)


def headings_of(path):
    """As a link names them behind its #."""
    titles = re.findall(r"^#+ (.*)$", path.read_text(encoding="utf-8"), re.MULTILINE)
    return {re.sub(r"[^\w\- ]", "", title.strip().lower()).replace(" ", "-") for title in titles}


def links_of(text):
    """(line number, target) outside of code"""
    fenced = False
    for number, line in enumerate(text.split("\n"), 1):
        fenced = fenced != line.startswith("```")
        if fenced or line.startswith("    "):
            continue
        for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", line)):
            if "://" not in target:
                yield number, target


def faults_of_links(root):
    """(faults, how many links were followed): of every page of the tree"""
    pages = [*root.glob("*.md"), *(page for folder in (*LAYERS, ".github") for page in (root / folder).rglob("*.md"))]
    faults, followed = [], 0
    for page in sorted(pages):
        name = page.relative_to(root).as_posix()
        for number, target in links_of(page.read_text(encoding="utf-8")):
            followed += 1
            file, _, heading = target.partition("#")
            path = page.parent / file if file else page
            if not path.exists():
                faults.append(f"{name}:{number}: a link to {target}, which is not there")
            elif heading and path.suffix == ".md" and heading not in headings_of(path):
                faults.append(f"{name}:{number}: {file or name} has no heading #{heading}")
    return faults, followed


def faults_of_zones(root):
    """The defaults of the distances, in metres, as the drawing of the zones has them."""
    drawing = (root / ZONES).read_text(encoding="utf-8")
    settings = (root / SETTINGS).read_text(encoding="utf-8")
    for name in ("alert.stop", "alert.warn", "alert.notice"):
        centimetres = re.search(rf'"{name}", "m", 2, (\d+)', settings)
        said = f"{name}: {int(centimetres.group(1)) / 100:g} m" if centimetres else f"{name}: its default"
        if said not in drawing:
            yield f"{ZONES}: it does not say: {said}"


def faults_of_form(root, texts):
    """README.md is a first screen, the index the way to every page."""
    lines = texts["README.md"].splitlines()
    if len(lines) > README_LINES:
        yield f"README.md: {len(lines)} lines, at most {README_LINES}"
    for number, line in enumerate(lines, 1):
        if len(line) > README_COLUMNS:
            yield f"README.md:{number}: {len(line)} columns, at most {README_COLUMNS}"
    for name in ("README.md", INDEX):
        for number, word, linked in marked(texts[name]):
            if word.endswith(".md") and not linked:
                yield f"{name}:{number}: {word} is no link"
    index = (root / INDEX).parent
    linked = {(index / word).resolve() for _, word, is_link in marked(texts[INDEX]) if is_link}
    for path in sorted(index.glob("*.md")):
        if path.name != "README.md" and path.resolve() not in linked:
            yield f"{INDEX}: nothing leads to {path.name}"


def check(root):
    """(faults, how many things were compared)"""
    root = root.resolve()
    texts = {name: (root / name).read_text(encoding="utf-8") for name in (*PAGES, ROBUSTNESS, SAFETY)}
    faults, compared = list(faults_of_form(root, texts)), 2
    for name in PAGES:
        found, count = faults_of_page(root, name, texts[name])
        faults += found
        compared += count
    found, count = faults_of_equations(root, texts[EQUATIONS])
    faults += found
    compared += count
    path_fault = fault_of_path(root, texts[ARCHITECTURE])
    if path_fault:
        faults.append(path_fault)
    found, count = faults_of_links(root)
    faults += [*found, *faults_of_zones(root)]
    compared += count + 3
    if PROMISE not in " ".join(texts[SAFETY].split()):
        faults.append(f"{SAFETY}: it does not say: {PROMISE}")
    tests = tests_of(root)
    for name, header in ((PAPER, "| paper |"), (ROBUSTNESS, "| what was done |")):
        for number, word in table_tests(texts[name], header):
            compared += 1
            fault = fault_of_test(root, word, tests)
            if fault:
                faults.append(f"{name}:{number}: {fault}")
    return faults, compared


if __name__ == "__main__":
    sys.exit(command.run(__doc__, check, "things"))
