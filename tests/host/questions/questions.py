"""Runs what questions.md shows and compares: python3 questions.py FENCEPOST SOURCES FOLDER [--write].

With --write the outputs in the document are replaced, as many lines of each as it shows; those with "..." before their end are left as
they are.
"""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from shown import Reading, is_shown, renewed

PROGRAM, SOURCES, FOLDER = Path(sys.argv[1]).resolve(), Path(sys.argv[2]).resolve(), Path(sys.argv[3]).resolve()
DOCUMENT = SOURCES / "host/share/doc/questions.md"


def printed_by(command):
    """All that a command of the document prints, as lines."""
    words = command.split()
    assert words[0] == "fencepost", command
    words = [re.sub(r"^R/", "host/share/recordings/", word) for word in words[1:]]
    run = subprocess.run([PROGRAM, *words], cwd=FOLDER, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                         stderr=subprocess.STDOUT, text=True, timeout=120, check=False)
    text = run.stdout.replace("host/share/recordings/", "R/")
    return [line.rstrip() for line in text.rstrip("\n").split("\n")] if text else []


def main():
    shutil.rmtree(FOLDER, ignore_errors=True)
    FOLDER.mkdir(parents=True)
    (FOLDER / "host").symlink_to(SOURCES / "host")
    reading = Reading(DOCUMENT.read_text(), FOLDER)
    wrong, commands = [], 0
    for command, shown, put in reading.commands():
        commands += 1
        printed = printed_by(command)
        if not is_shown(printed, shown):
            wrong.append(f"$ {command}\nthe document shows:\n" + "\n".join(shown) + "\nit prints:\n" + "\n".join(printed))
        put(renewed(printed, shown))
    if "--write" in sys.argv:
        DOCUMENT.write_text(reading.document())
        return 0
    print("\n\n".join(wrong))
    print(f"{commands} commands, {len(wrong)} print something else than {DOCUMENT.name} shows")
    return 1 if wrong or commands < 10 else 0


sys.exit(main())
