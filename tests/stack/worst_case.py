#!/usr/bin/env python3
"""Worst-case stack of the loop, from GCC's call graph (-fcallgraph-info=su).

usage: worst_case.py FOLDER-WITH-CI-FILES ROOT=BUDGET...

Adds up the frames along the deepest path from each root. Fails on recursion, on calls through pointers, on frames of
unknown size, on unknown outside functions, and on a root above its budget (bytes).
"""

import json
import pathlib
import re
import sys

# Outside functions that the robot's code may call, with an allowance for their frames (bytes).
OUTSIDE = {"memcpy": 64, "memmove": 64, "memset": 64, "memcmp": 64, "memchr": 64, "strlen": 64, "sqrtf": 64, "bcmp": 64,
           "abort": 0, "__popcountdi2": 64}

NODE = re.compile(r'node: \{ title: "([^"]+)" label: "((?:[^"\\]|\\.)*)"')
EDGE = re.compile(r'edge: \{ sourcename: "([^"]+)" targetname: "([^"]+)"')
SIZE = re.compile(r"(\d+) bytes \(([a-z,]+)\)")


def short(title):
    """GCC prefixes functions local to a file with the file's name."""
    return title.rsplit(":", 1)[-1]


def objects_of(graph_file):
    return [graph_file.with_suffix(suffix) for suffix in (".obj", ".o")]


def of_link_time(graph_file):
    return any(file.exists() and b".gnu.lto_" in file.read_bytes() for file in objects_of(graph_file))


def objects_built(folder):
    """By the folder's own list of commands; nothing if it has none."""
    database = pathlib.Path(folder, "compile_commands.json")
    if not database.exists():
        return None
    commands = json.loads(database.read_text())
    return {pathlib.Path(entry["directory"], re.search(r" -o (\S+)", entry["command"]).group(1)) for entry in commands}


def read_graph(folder, without=None):
    """The graph of all objects below `folder`, but for those in folders whose names match the pattern `without`. Objects
    that are optimised when they are linked have their graph beside the program. A graph beside such an object is of an
    older build, and left out. So is the graph of an object that nothing builds any more."""
    frames, kinds, calls, labels = {}, {}, {}, {}
    built = objects_built(folder)

    def is_left_over(file):
        return built is not None and ".ltrans" not in file.name and not built.intersection(objects_of(file))

    files = sorted(file for file in pathlib.Path(folder).rglob("*.ci")
                   if not (without and any(re.match(without, part) for part in file.parts)) and not of_link_time(file)
                   and not is_left_over(file))
    if not files:
        sys.exit(f"worst_case: no .ci files below {folder}: was it compiled by GCC with -fcallgraph-info=su?")
    for file in files:
        text = file.read_text()
        for title, label in NODE.findall(text):
            labels.setdefault(title, label.split("\\n")[0])
            size = SIZE.search(label)
            if size:
                frames[title] = int(size.group(1))
                kinds[title] = size.group(2)
        for source, target in EDGE.findall(text):
            calls.setdefault(source, set()).add(target)
    return frames, kinds, calls, labels


class Depths:
    def __init__(self, graph):
        self.frames, self.kinds, self.calls, self.labels = graph
        self.known = {}
        self.faults = []
        # A function that several files may define (an instantiated template) bears its file's name only where it is
        # defined.
        self.defined = {}
        for title in self.frames:
            if ":" in title and short(title).startswith("_Z"):
                self.defined.setdefault(short(title), []).append(title)

    def of(self, function, path=()):
        """(bytes, deepest path) from here down."""
        if function not in self.frames:  # a constructor's two names are one function
            function = re.sub(r"C1E", "C2E", function, count=1)
        if function not in self.frames and function in self.defined:
            return max((self.of(title, path) for title in self.defined[function]), key=lambda depth: depth[0])
        if function in self.known:
            return self.known[function]
        if function in path:
            self.faults.append("recursion: " + " > ".join(self.labels.get(f, f) for f in (*path, function)))
            return 0, []
        if function not in self.frames:
            return self.outside(function, path)
        if "dynamic" in self.kinds[function] and "bounded" not in self.kinds[function]:
            self.faults.append(f"frame of unknown size: {self.labels[function]} ({self.kinds[function]})")
        deepest = (0, [])
        for callee in sorted(self.calls.get(function, ())):
            depth = self.of(callee, (*path, function))
            if depth[0] > deepest[0]:
                deepest = depth
        self.known[function] = (self.frames[function] + deepest[0], [function, *deepest[1]])
        return self.known[function]

    def outside(self, function, path):
        if function == "__indirect_call":
            self.faults.append("call through a pointer in " + self.labels.get(path[-1], path[-1]))
            return 0, []
        if short(function) not in OUTSIDE:
            caller = self.labels.get(path[-1], path[-1]) if path else "?"
            self.faults.append(f"unknown outside function {function}, called by {caller}")
            return 0, []
        return OUTSIDE[short(function)], [function]


def main():
    if len(sys.argv) < 3 or any("=" not in budget for budget in sys.argv[2:]):
        sys.exit(__doc__)
    depths = Depths(read_graph(sys.argv[1]))
    over = False
    for argument in sys.argv[2:]:
        root, budget = argument.split("=")
        if root not in depths.frames:
            sys.exit(f"worst_case: root {root} is not in the call graph")
        size, path = depths.of(root)
        print(f"{root}: worst case {size} of {budget} bytes")
        for function in path:
            own = depths.frames.get(function, OUTSIDE.get(short(function), 0))
            print(f"  {own:6} {depths.labels.get(function, function)[:140]}")
        over = over or size > int(budget)
    for fault in sorted(set(depths.faults)):
        print("FAULT " + fault)
    if depths.faults or over:
        sys.exit(1)


if __name__ == "__main__":
    main()
