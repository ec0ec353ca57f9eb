#!/usr/bin/env python3
"""usage: layer_check.py [ROOT]

Checks the rules of the tree that a compiler does not: layers and rooms, what robot code may use, what lies where.
Prints one line per fault, file:line: rule: what is wrong; exit status 1 if there is any.
"""

import pathlib
import re
import sys

from source_text import without_comments, without_literals

LAYERS = ["hal", "drivers", "firmware", "host", "tests"]

# A room is a folder with all that lies below it, or a file by its name without the suffix. With /* each folder there is
# a room of its own. The longest row that matches counts. A room may include the rooms that its row names and all that
# these may include. Tests may include anything.
ROOMS = {
    "hal/base": "",
    "hal/bus": "hal/base",
    "hal/sensor": "hal/base",
    "hal/fake": "hal/bus hal/sensor",
    "hal/linux": "hal/bus",
    "hal/windows": "hal/linux",
    "hal/windows/posix": "",
    "hal/windows/posix/linux": "",
    "hal/windows/posix/sys": "",
    "hal/mcu": "hal/bus",
    "hal/mcu/cortex_m": "hal/mcu",
    "hal/mcu/*": "hal/mcu/cortex_m",
    "hal/mcu/rp2": "hal/mcu/cortex_m hal/mcu/rp2040 hal/mcu/rp2350",
    "hal/mcu/rp2/rom_word": "hal/mcu",
    "hal/mcu/rp2040": "hal/mcu/rp2/rom_word",
    "hal/mcu/rp2350": "hal/mcu/rp2/rom_word",
    "hal/mcu/nrf51": "hal/mcu/cortex_m",
    "hal/mcu/nrf52": "hal/mcu/nrf51",
    "hal/template": "hal/bus",
    "hal/boards/*": "hal/mcu/* hal/template",
    "hal/boards/netduino_plus_2": "hal/mcu/* hal/template",
    "hal/boards/microbit": "hal/mcu/nrf51",
    "hal/boards/microbit_v2": "hal/mcu/nrf52",
    "hal/boards/feather_f405": "hal/boards/netduino_plus_2",
    "hal/boards/pyboard": "hal/boards/netduino_plus_2",
    "hal/boards/pico": "hal/mcu/rp2",
    "hal/boards/pico2": "hal/boards/pico",
    "hal/boards/xrp": "hal/boards/pico",
    "hal/boards/xrp2": "hal/boards/pico",
    "drivers/serial": "hal/bus hal/sensor",
    "drivers/wire": "drivers/serial",
    "drivers/odometry": "hal/sensor",
    "drivers/chirp": "drivers/wire",
    "drivers/*": "drivers/chirp drivers/odometry drivers/wire",
    "firmware/record": "hal/sensor",
    "firmware/config": "drivers/* firmware/record firmware/recon/models",
    "firmware/recon/geometry": "hal/base",
    "firmware/recon/floor_frame": "hal/base",
    "firmware/recon/observe": "firmware/recon/geometry firmware/recon/floor_frame hal/sensor",
    "firmware/recon/models": "firmware/recon/observe",
    "firmware/recon/track": "firmware/recon/models",
    "firmware/recon/localize": "firmware/recon/track",
    "firmware/recon/guard": "firmware/recon/observe",
    "firmware/recon/digest": "firmware/recon/guard firmware/recon/localize",
    "firmware/recon/map": "firmware/recon/digest",
    "firmware/alert": "firmware/config firmware/recon/guard firmware/recon/track",
    "firmware/console": "firmware/alert firmware/recon/localize",
    "firmware/loop": "firmware/console firmware/recon/map",
    "firmware/fencepost": "firmware/loop",
    "firmware/view": "firmware/console",
    "firmware/image": "drivers/* firmware/loop firmware/view hal/mcu",
    "host/share/examples": "",
    "host/text": "",
    "host/jobs": "",
    "host/geometry": "",
    "host/scene": "firmware/record host/geometry host/text",
    "host/simulate": "host/scene",
    "host/import": "host/scene",
    "host/import/csv": "host/import",
    "host/import/*": "drivers/* host/import host/import/csv",
    "host/segment": "host/import",
    "host/metrics": "host/simulate",
    "host/render": "host/metrics",
    "host/result": "firmware/console host/geometry host/text",
    "host/models": "firmware/recon/models",
    "host/replay": "firmware/loop host/models host/result host/scene",
    "host/fencepost": "host/replay",
    "host/evaluate": "host/replay host/simulate",
    "host/relocation": "firmware/recon/localize",
    "host/merge": "host/relocation host/result",
    "host/report": "host/evaluate",
    "host/web": "host/configure host/replay host/simulate host/video",
    "host/paper": "host/jobs host/render host/report",
    "host/export": "host/render host/report",
    "host/live": "drivers/* firmware/loop hal/linux host/scene",
    "host/video": "drivers/* hal/linux host/live",
    "host/recorder": "host/live",
    "host/view": "host/live",
    "host/monitor": "firmware/console host/geometry host/text",
    "host/emulate/models": "firmware/record hal/bus host/text",
    "host/emulate/transport": "hal/linux host/emulate/models",
    "host/emulate/scene": "host/emulate/transport host/simulate",
    "host/configure": "hal/mcu host/live",
    "host/devices": "drivers/* host/emulate/scene host/live host/video",
    "host/doctor": "host/text",
    "host/doctor/log": "host/doctor host/recorder host/replay",
    "host/doctor/ports": "host/devices host/doctor",
    "host/calibrate": "host/doctor host/live host/report",
    "host/smooth": "host/calibrate",
    "host/cli": "host/configure host/doctor/log host/doctor/ports host/export host/import/* host/jobs host/merge host/monitor host/paper host/recorder host/segment host/smooth host/view host/web",
}
# Files that lie in one room and still include as if they lay in another.
COUNTED_AS = {}

ROBOT = {"hal", "drivers", "firmware"}
GLOB = re.compile(r"\bfile\s*\(\s*GLOB(?!\s+\w+\s+CONFIGURE_DEPENDS)[^\n]*", re.IGNORECASE)
SEEN_GLOB = re.compile(r"\bfile\(GLOB \w+ CONFIGURE_DEPENDS [^)\n]*?(\S+\.cpp)\)")
# A layer of the robot, a machine of the desk: heap, threads and libraries. The library has a heap for programs that ask
# for one, apart from all else.
DESK = ("hal/linux/", "hal/windows/", "firmware/fencepost/heap.cpp")
TOP_LEVEL = {*LAYERS, "toolchain", "CMakeLists.txt", "CMakePresets.json", "README.md", "CHANGELOG.md",
             "CITATION.cff", "LICENSE"}
NOT_OURS = {".git", ".cache", "build", "out", "compile_commands.json", "__pycache__"}
CODE = {".hpp", ".cpp", ".h", ".c", ".S"}
README_LINES = 15
INDEX = "host/share/doc/README.md"  # a line for every page

REFUSED_HEADERS = set(
    "iostream istream ostream fstream sstream iomanip cstdio stdio.h functional string vector map unordered_map set "
    "unordered_set deque list queue stack memory new stdexcept exception regex thread mutex future any random locale".split()
)
# For std::construct_at and std::align, which make an object in memory that is there.
ALLOWED_HEADERS = {("firmware/image/one_of.hpp", "memory"), ("firmware/fencepost/core.hpp", "memory"),
                   ("firmware/fencepost/handle.hpp", "memory"), ("firmware/fencepost/interface.cpp", "memory")}
# Installed side by side, in a folder that is none of the repository.
NEIGHBOURS = {("firmware/fencepost/fencepost.hpp", "fencepost.h")}
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
    def __init__(self, root, rooms, counted_as):
        self.root = root
        self.rooms = {name: row.split() for name, row in rooms.items()}
        self.counted_as = counted_as
        self.allowed = {name: self._reachable(name) for name in self.rooms}
        self.room_edges = {}  # (room, room it includes): the first place, (path, line)
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

    def _reachable(self, row):
        seen, waiting = set(), [row]
        while waiting:
            for right in self.rooms.get(waiting.pop(), []):
                if right not in seen:
                    seen.add(right)
                    waiting.append(right)
        return seen

    def room(self, file):
        """(room, its row of the table) of a file by its path in the repository; (None, None) if no row matches."""
        folder, _, name = file.rpartition("/")
        place = f"{folder}/{name.partition('.')[0]}"
        place = self.counted_as.get(place, place)
        while place:
            if place in self.rooms:
                return place, place
            parent = place.rpartition("/")[0]
            if f"{parent}/*" in self.rooms and file.startswith(place + "/"):
                return place, f"{parent}/*"
            place = parent
        return None, None

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
            allowed = (str(tree.relative(path)), system) in ALLOWED_HEADERS
            if tree.robot(path) and system in REFUSED_HEADERS and not allowed:
                tree.fault(path, number, "header", f"<{system}> is refused in {mine}")
            continue
        if (tree.relative(path), quoted) in NEIGHBOURS:
            continue
        target = quoted.split("/")[0]
        if target not in LAYERS or ".." in quoted.split("/") or not (tree.root / quoted).is_file():
            tree.fault(path, number, "include-path", f'"{quoted}" is not a file by its path in the repository')
        elif LAYERS.index(target) > LAYERS.index(mine):
            tree.fault(path, number, "layer", f"{mine} must not include {target}")
        elif tree.relative(path).startswith("firmware/recon/") and quoted.startswith(("hal/bus/", "drivers/")):
            tree.fault(path, number, "seam", "the reconstruction sees sensors, never buses and drivers")
        elif mine != "tests":
            check_room_edge(tree, path, number, quoted)


def check_room_edge(tree, path, number, included):
    (mine, row), (other, other_row) = tree.room(tree.relative(path)), tree.room(included)
    if mine is None or other is None or mine == other:
        return  # a place without a room is reported once, by check_rooms
    if other_row in tree.allowed[row]:
        tree.room_edges.setdefault((mine, other), (path, number))
    else:
        tree.fault(path, number, "room", f"{mine} must not include {other}: see ROOMS in layer_check.py")


def check_rooms(tree):
    """Each source in a room, each row of the table with its sources, and no cycle, allowed or not."""
    inhabited = set()
    for path in tree.texts:
        if path.suffix in CODE and tree.layer(path) in LAYERS and tree.layer(path) != "tests":
            _, row = tree.room(tree.relative(path))
            inhabited.add(row)
            if row is None:
                tree.fault(path, 1, "room", "no row of ROOMS in layer_check.py names this folder")
    for name, row in tree.rooms.items():
        if name not in inhabited:
            tree.fault(tree.root / name, 1, "room", "a row of ROOMS in layer_check.py, and no source lies there")
        for right in row:
            if right not in tree.rooms:
                tree.fault(tree.root / name, 1, "room", f"its row in layer_check.py names {right}, which has no row")
    cycle = find_cycle(sorted(tree.room_edges))
    if cycle:
        path, line = tree.room_edges[cycle[0], cycle[1]]
        tree.fault(path, line, "room-cycle", " -> ".join(cycle))


def find_cycle(edges):
    """A shortest cycle of a directed graph, as [a, ..., a]; empty if there is none."""
    cycles = []
    for start in sorted({left for left, _ in edges}):
        paths, seen = [[start]], set()
        while paths:
            path = paths.pop(0)
            for left, right in edges:
                if left != path[-1] or right in seen:
                    continue
                if right == start:
                    cycles.append(path + [right])
                    paths = []
                    break
                seen.add(right)
                paths.append(path + [right])
    return min(cycles, key=len, default=[])


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
        tree.match_lines(path, code, GLOB, "glob", "a glob of sources has CONFIGURE_DEPENDS, or a new one is not seen: '{}'")
        for pattern in SEEN_GLOB.findall(code):
            listed.update(found.resolve() for found in path.parent.glob(re.sub(r"\$\{\w+\}", "*", pattern)))
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
    if path.name == "README.md" and tree.relative(path) not in ("README.md", INDEX) and lines > README_LINES:
        tree.fault(path, lines, "readme-length", f"{lines} lines, at most {README_LINES}")


def check(root, rooms=ROOMS, counted_as=COUNTED_AS):
    """All faults of the tree as (file, line, rule, what)."""
    tree = Tree(root, rooms, counted_as)
    check_top_level(tree)
    check_cmake(tree)
    for path in tree.texts:
        check_text(tree, path)
        if path.suffix in CODE and tree.layer(path) in LAYERS:
            check_includes(tree, path)
            if tree.robot(path):
                check_robot_words(tree, path)
    check_rooms(tree)
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
