"""Runs what questions.md shows and compares: python3 questions.py FENCEPOST SOURCES FOLDER [--write].

A block of lines that begin with "| " is the file named last before it; one that begins with "$ " is a command, and what it prints, on
either stream. A line "..." stands for any lines. With --write the outputs in the document are replaced, as many lines of each as it shows;
those with "..." before their end are left as they are.
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

PROGRAM, SOURCES, FOLDER = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve()
DOCUMENT = SOURCES / "host/share/doc/questions.md"
INDENT = "    "
MORE = "..."


def printed_by(command):
    """All that a command of the document prints, as lines."""
    words = command.split()
    assert words[0] == "fencepost", command
    words = [re.sub(r"^R/", "host/share/recordings/", word) for word in words[1:]]
    run = subprocess.run([PROGRAM, *words], cwd=FOLDER, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True, timeout=120, check=False)
    text = run.stdout.replace("host/share/recordings/", "R/")
    return [line.rstrip() for line in text.rstrip("\n").split("\n")] if text else []


def pieces(lines):
    """The document as (command, lines shown) and, for all else, (None, [line])."""
    found = []
    for line in lines:
        if line.startswith(INDENT + "$ "):
            found.append((line[len(INDENT) + 2:], []))
        elif found and found[-1][0] and line.startswith(INDENT):
            found[-1][1].append(line[len(INDENT):])
        elif found and found[-1][0] and not line and found[-1][1]:
            found[-1][1].append("")  # an empty line within what is printed, or the end of it: see trimmed()
        else:
            found.append((None, [line]))
    return found


def trimmed(shown):
    while shown and not shown[-1]:
        shown = shown[:-1]
    return shown


def parts(shown):
    """What is shown between lines "...", each as a list of lines."""
    found = [[]]
    for line in shown:
        if line == MORE:
            found.append([])
        else:
            found[-1].append(line)
    return found


def is_shown(printed, shown):
    if MORE not in shown:
        return printed == shown
    first, *others = parts(shown)
    if printed[:len(first)] != first:
        return False
    at = len(first)
    for part in others[:-1]:
        starts = [i for i in range(at, len(printed) - len(part) + 1) if printed[i:i + len(part)] == part]
        if not starts:
            return False
        at = starts[0] + len(part)
    last = others[-1]
    return at <= len(printed) - len(last) and printed[len(printed) - len(last):] == last


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    (FOLDER / "host").symlink_to(SOURCES / "host")
    file, written, wrong, commands = None, [], [], 0
    for command, shown in pieces(DOCUMENT.read_text().splitlines()):
        if not command:
            line = shown[0]
            names = re.findall(r"`([\w.]+\.(?:txt|csv))`", line)
            file = names[-1] if names else file
            if line.startswith(INDENT + "| "):
                with (FOLDER / file).open("a") as out:
                    out.write(line[len(INDENT) + 2:] + "\n")
            written.append(line)
            continue
        commands += 1
        ends = len(shown) - len(trimmed(shown))
        shown = trimmed(shown)
        printed = printed_by(command)
        if not is_shown(printed, shown):
            wrong.append(f"$ {command}\nthe document shows:\n" + "\n".join(shown) + "\nit prints:\n" + "\n".join(printed))
        if MORE in shown[:-1]:
            printed = shown
        elif shown and shown[-1] == MORE:
            printed = [*printed[:len(shown) - 1], MORE]
        written += [INDENT + "$ " + command] + [(INDENT + line).rstrip() for line in printed] + [""] * ends
    if "--write" in sys.argv:
        DOCUMENT.write_text("\n".join(written) + "\n")
        return 0
    print("\n\n".join(wrong))
    print(f"{commands} commands, {len(wrong)} print something else than {DOCUMENT.name} shows")
    return 1 if wrong or commands < 10 else 0


sys.exit(main())
