#!/usr/bin/env python3
"""usage: contributing_check.py [ROOT]

Holds the lists of .github/CONTRIBUTING.md. For every board, setting, ... that exists, each new file is there, and each file to
edit names it. A list has as many as it says. Prints one line per fault; exit status 1 if there is any.
"""

import re
import sys

import command

DOCUMENT = ".github/CONTRIBUTING.md"
HEADING = re.compile(r"^## Add an? [\w ]+: ([A-Z]+)$")
COUNT = re.compile(r"^(\w+) files, (\w+) of them edits", re.MULTILINE)
NUMBERS = ("none one two three four five six seven eight nine ten eleven twelve thirteen fourteen fifteen sixteen seventeen eighteen "
           "nineteen twenty").split()
ROW = re.compile(r"^\| (new|edit) \| ([^|]+) \|")


def boards(root):
    """Boards that have memories of their own."""
    return sorted(p.parent.name for p in root.glob("hal/boards/*/image.ld"))


def siblings(root):
    """Boards that have pins alone: the rest is another's."""
    folders = (p.parent for p in root.glob("hal/boards/*/pins.hpp"))
    return sorted(p.name for p in folders if not (p / "image.ld").is_file())


def settings(root):
    text = (root / "firmware/config/settings.hpp").read_text(encoding="utf-8")
    return re.findall(r'^\s*\{"([a-z_.]+)", ', text, re.MULTILINE)


def models(root):
    headers = sorted((root / "firmware/recon/models").rglob("*.hpp"))
    named = (re.search(r'std::string_view kName = "(\w+)"', h.read_text(encoding="utf-8")) for h in headers)
    return [match.group(1) for match in named if match]


def cameras(root):
    """Those of the catalogue that have a driver, by the file of their rows."""
    rows = [p for p in sorted(root.glob("host/devices/*.cpp")) if "Role::kCamera," in p.read_text(encoding="utf-8")]
    return [p.stem for p in rows if (root / "drivers" / p.stem).is_dir()]


# The word of a list, and what there is of it.
KINDS = {"BOARD": boards, "SIBLING": siblings, "CAMERA": cameras, "MODEL": models, "SETTING": settings}


def lists_in(text):
    """{word: [(new or edit, [paths, of which one is enough])]}"""
    lists, word = {}, None
    for line in text.split("\n"):
        heading, row = HEADING.match(line), ROW.match(line)
        if heading:
            word = heading.group(1)
            lists[word] = []
        elif line.startswith("## "):
            word = None
        elif row and word:
            lists[word].append((row.group(1), re.findall(r"`([^`]+)`", row.group(2))))
    return lists


def counted_wrongly(text):
    """Lists whose first sentence gives another number of files, or of edits, than they have."""
    for part in re.split(r"^(?=## )", text, flags=re.MULTILINE):
        heading, said = HEADING.match(part.split("\n", 1)[0]), COUNT.search(part)
        rows = [row.group(1) for row in map(ROW.match, part.split("\n")) if row]
        if heading and said and [NUMBERS.index(word.lower()) for word in said.groups()] != [len(rows), rows.count("edit")]:
            yield f"{DOCUMENT}: {heading.group(1)}: {len(rows)} files, {rows.count('edit')} of them edits, not '{said.group(0)}'"


def is_named_in(text, name):
    """Whether the text has the name, in any of our ways of writing it: cylinder_paper, CylinderPaper."""
    return name in text or name.replace("_", "") in text.replace("_", "").lower()


def fault_of(root, action, paths, word, name):
    """The fault of one row for one thing; None if it holds."""
    found = [path for path in (p.replace(word, name) for p in paths) if (root / path).is_file()]
    if not found:
        return "there is no " + " or ".join(p.replace(word, name) for p in paths)
    if action == "edit" and not any(is_named_in((root / p).read_text(encoding="utf-8"), name) for p in found):
        return f"{found[0]} does not name it"
    return None


def check(root, kinds=None):
    """(faults, how many rows were compared)"""
    kinds = KINDS if kinds is None else kinds
    text = (root / DOCUMENT).read_text(encoding="utf-8")
    lists = lists_in(text)
    faults = list(counted_wrongly(text))
    faults += [f"{DOCUMENT}: no list for {word}" for word in sorted(set(kinds) - set(lists))]
    faults += [f"{DOCUMENT}: nothing is known of {word}" for word in sorted(set(lists) - set(kinds))]
    compared = 0
    for word in sorted(set(kinds) & set(lists)):
        names = kinds[word](root)
        if not names or not lists[word]:
            faults.append(f"{DOCUMENT}: {word}: nothing to compare")
        for name in names:
            for action, paths in lists[word]:
                compared += 1
                fault = fault_of(root, action, paths, word, name)
                if fault:
                    faults.append(f"{DOCUMENT}: {word} {name}: {fault}")
    return faults, compared


if __name__ == "__main__":
    sys.exit(command.run(__doc__, check, "rows"))
