"""Runs what a document shows and compares: python3 document.py FENCEPOST SOURCES DOCUMENT [--write].

Each fenced block that begins with "$ " is a command and what it says, on both outputs. The commands run one after the other in one
folder. What is seen has to be what is shown. --write puts what was seen into the document.
"""

import re
import subprocess
import sys
from pathlib import Path

from shown_place import shown_place

BLOCK = re.compile(r"^```\n\$ ((?:[^\n]*\\\n)*[^\n]*\n)(.*?)^```$", re.S | re.M)


def run(command, folder, environment):
    done = subprocess.run(["sh", "-c", command.replace("\\\n", " ")], cwd=folder, env=environment, text=True,
                          stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    if done.returncode != 0:
        raise SystemExit(f"$ {command}ended with {done.returncode}:\n{done.stdout}")
    return done.stdout


def main(program, sources, name, write=False):
    document = Path(sources) / "host/share/doc" / name
    text = document.read_text()
    different = seen = 0
    with shown_place(program, sources) as place:
        for command, expected in BLOCK.findall(text):
            seen += 1
            shown = run(command, *place)
            if write:
                text = text.replace(f"$ {command}{expected}```", f"$ {command}{shown}```", 1)
            elif expected != shown:
                different += 1
                print(f"$ {command}the document says\n{expected}\nbut this was seen\n{shown}")
    if write:
        document.write_text(text)
    if not seen:
        raise SystemExit(f"{document} shows no command")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:4], write="--write" in sys.argv[4:]))
