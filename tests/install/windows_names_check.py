#!/usr/bin/env python3
"""usage: windows_names_check.py [ROOT]

The program for Windows has no fencepost-lab: host/cli/windows/missing.cpp stands in for it. Whatever lab.hpp declares and a
command that Windows has asks for must stand there, else only the cross compiler finds out. Exit status 1 if a name is missing.
"""

import pathlib
import re
import sys


def declared(text):
    return re.findall(r"^[\w:<>]+ (\w+)\([^;{]*\);", text, re.MULTILINE)


def sources_for_windows(cmake):
    """Of the library of commands: what every system has, and what Windows has alone."""
    library = cmake[cmake.index("add_library(fencepost_commands STATIC"):]
    for_all, rest = library.split("if(WIN32)", 1)
    return re.findall(r"[\w/]+\.cpp", for_all + rest.split("else()", 1)[0])


def check(root):
    cli = root / "host" / "cli"
    names = declared((cli / "lab.hpp").read_text(encoding="utf-8"))
    missing = (cli / "windows" / "missing.cpp").read_text(encoding="utf-8")
    faults = []
    for source in sources_for_windows((cli / "CMakeLists.txt").read_text(encoding="utf-8")):
        if source == "windows/missing.cpp":
            continue
        text = (cli / source).read_text(encoding="utf-8")
        faults += [f"host/cli/{source}: asks for {name}(), and host/cli/windows/missing.cpp has none"
                   for name in names
                   if re.search(rf"\b{name}\(", text) and not re.search(rf"^\S.* {name}\(.*\{{", missing, re.MULTILINE)]
    if not names:
        faults.append("host/cli/lab.hpp: declares nothing that this check can read")
    return faults


if __name__ == "__main__":
    found = check(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else "."))
    print("\n".join(found) or "the program for Windows has all that its commands ask for")
    sys.exit(1 if found else 0)
