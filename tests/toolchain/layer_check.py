#!/usr/bin/env python3
"""usage: layer_check.py [ROOT]

Checks the rules of the tree that a compiler does not: layers, what robot code may use, what lies where.
Prints one line per fault, file:line: rule: what is wrong; exit status 1 if there is any.
"""

import pathlib
import re
import sys

from source_text import without_comments, without_literals

LAYERS = ["hal", "drivers", "firmware", "host", "tests"]
ROBOT = {"hal", "drivers", "firmware"}
DESK = ("hal/linux/",)  # a layer of the robot, a machine of the desk: heap, threads and libraries
TOP_LEVEL = {*LAYERS, "toolchain", "CMakeLists.txt", "CMakePresets.json", "README.md", "LICENSE"}
NOT_OURS = {".git", ".cache", "build", "out", "compile_commands.json", "__pycache__"}
CODE = {".hpp", ".cpp", ".h", ".c", ".S"}
README_LINES = 15

REFUSED_HEADERS = set(
    "iostream istream ostream fstream sstream iomanip cstdio stdio.h functional string vector map unordered_map set "
    "unordered_set deque list queue stack memory new stdexcept exception regex thread mutex future any random locale".split()
)
REFUSED_WORDS = {
    "virtual destructor": r"\bvirtual\s*~",
    "new": r"\bnew\b",
    "delete": r"(?<!=)(?<!= )\bdelete\b",
    "malloc": r"\b(?:malloc|calloc|realloc|free)\s*\(",
    "exceptions": r"\b(?:throw|try|catch)\b",
    "run-time types": r"\b(?:dynamic_cast|typeid)\b",
    "bit_cast": r"\bbit_cast\b",
}
# The C libraries of our targets differ in the last bit of each of these; sqrt is exact everywhere.
LIBM = re.compile(
    r"(?<![\w.>:])(?:std\s*::|::)?\s*((?:a?(?:sin|cos|tan)h?|atan2|exp|exp2|expm1|log|log2|log10|log1p|pow|hypot|cbrt|"
    r"erf|erfc|tgamma|lgamma|sincos)[fl]?)\s*\("
)
# Assembled, so that this file does not report itself.
UNFINISHED = re.compile(r"\b(?:TO" r"DO|FIX" r"ME|XX" r"X)\b")
MACHINE_PATH = re.compile(r"(?<![\w.$}{*~/-])/(?:work|home|root|Users)/")
FAST_MATH = re.compile(r"-(?:O" r"fast|f" r"fast-math|funsafe-math-optimizations)")


class Tree:
    def __init__(self, root):
        self.root = root
        self.faults = []
        self.files = sorted(self._walk(root))
        self.texts = {}
        for path in self.files:
            try:
                self.texts[path] = path.read_text(encoding="utf-8")
            except UnicodeDecodeError:
                continue  # a picture, a compressed file

    def _walk(self, folder):
        for entry in folder.iterdir():
            if entry.name in NOT_OURS or entry.is_symlink():
                continue
            if entry.is_dir():
                yield from self._walk(entry)
            else:
                yield entry

    def relative(self, path):
        return path.relative_to(self.root).as_posix()

    def layer(self, path):
        return self.relative(path).split("/")[0]

    def robot(self, path):
        return self.layer(path) in ROBOT and not self.relative(path).startswith(DESK)

    def fault(self, path, line, rule, what):
        self.faults.append((self.relative(path), line, rule, what))

    def match_lines(self, path, text, pattern, rule, what):
        for match in pattern.finditer(text):
            self.fault(path, text.count("\n", 0, match.start()) + 1, rule, what.format(match.group().strip()))


def check_top_level(tree):
    for entry in sorted(tree.root.iterdir()):
        if entry.name not in TOP_LEVEL | NOT_OURS and not entry.name.startswith("."):
            tree.fault(entry, 1, "top-level", "nothing of this name belongs at the top")


def check_includes(tree, path):
    mine = tree.layer(path)
    for number, line in enumerate(without_comments(tree.texts[path]).split("\n"), 1):
        match = re.match(r'\s*#\s*include\s*(?:"([^"]+)"|<([^>]+)>)', line)
        if not match:
            continue
        quoted, system = match.groups()
        if system is not None:
            if tree.robot(path) and system in REFUSED_HEADERS:
                tree.fault(path, number, "header", f"<{system}> is refused in {mine}")
            continue
        target = quoted.split("/")[0]
        if target not in LAYERS or ".." in quoted.split("/") or not (tree.root / quoted).is_file():
            tree.fault(path, number, "include-path", f'"{quoted}" is not a file by its path in the repository')
        elif LAYERS.index(target) > LAYERS.index(mine):
            tree.fault(path, number, "layer", f"{mine} must not include {target}")
        elif tree.relative(path).startswith("firmware/recon/") and quoted.startswith(("hal/bus/", "drivers/")):
            tree.fault(path, number, "seam", "the reconstruction sees sensors, never buses and drivers")


def check_robot_words(tree, path):
    code = without_literals(tree.texts[path])
    code = re.sub(r"^[ \t]*#[ \t]*include[^\n]*", "", code, flags=re.MULTILINE)
    for name, pattern in REFUSED_WORDS.items():
        tree.match_lines(path, code, re.compile(pattern), "word", name + " is refused here: '{}'")
    tree.match_lines(path, code, LIBM, "libm", "'{}' differs between C libraries; use hal/base/trig.hpp")


def check_cmake(tree):
    listed = set()
    for path, text in tree.texts.items():
        if path.name != "CMakeLists.txt" and path.suffix != ".cmake":
            continue
        code = re.sub(r"#[^\n]*", "", text)
        tree.match_lines(path, code, re.compile(r"\bfile\s*\(\s*GLOB\w*", re.IGNORECASE), "glob", "sources are listed")
        for token in re.findall(r'[^\s()"]+\.cpp\b', code):
            token = re.sub(r"^\$\{(?:PROJECT|CMAKE)_SOURCE_DIR\}/", f"{tree.root}/", token)
            token = token.replace("${CMAKE_CURRENT_SOURCE_DIR}/", "")
            listed.add((path.parent / token).resolve())
    for path in tree.files:
        if path.suffix == ".cpp" and tree.layer(path) in LAYERS and path.resolve() not in listed:
            tree.fault(path, 1, "unlisted", "no CMakeLists.txt lists this source")


def check_text(tree, path):
    text = tree.texts[path]
    tree.match_lines(path, text, UNFINISHED, "unfinished", "'{}'")
    tree.match_lines(path, text, MACHINE_PATH, "machine-path", "'{}' is a path of one machine")
    tree.match_lines(path, text, FAST_MATH, "fast-math", "'{}' changes results")
    lines = len(text.splitlines())
    if path.name == "README.md" and path.parent != tree.root and lines > README_LINES:
        tree.fault(path, lines, "readme-length", f"{lines} lines, at most {README_LINES}")


def check(root):
    """All faults of the tree as (file, line, rule, what)."""
    tree = Tree(root)
    check_top_level(tree)
    check_cmake(tree)
    for path in tree.texts:
        check_text(tree, path)
        if path.suffix in CODE and tree.layer(path) in LAYERS:
            check_includes(tree, path)
            if tree.robot(path):
                check_robot_words(tree, path)
    checked = sum(1 for path in tree.texts if path.suffix in CODE and tree.layer(path) in LAYERS)
    return sorted(tree.faults), checked


def main():
    if len(sys.argv) > 2 or "-h" in sys.argv or "--help" in sys.argv:
        print(__doc__.strip())
        return 2
    root = pathlib.Path(sys.argv[1] if len(sys.argv) == 2 else pathlib.Path(__file__).parents[2]).resolve()
    faults, checked = check(root)
    for file, line, rule, what in faults:
        print(f"{file}:{line}: {rule}: {what}")
    print(f"{checked} source files checked, {len(faults)} faults")
    if checked == 0:
        print(f"{root}: no source files here; is this the top of the repository?", file=sys.stderr)
    return 1 if faults or checked == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
