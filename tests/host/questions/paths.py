"""Runs what the documents of the ten-minute paths show and compares: python3 paths.py FENCEPOST SOURCES BUILD CXX NAME... [--write].

NAME: student, teacher, engineer. Each command is given to a shell, in a folder with the sources' folders in it. `fencepost emulate` is
another terminal's: it goes on while the next command runs. What a machine's clock decides, of the commands that are live, is compared
without its numbers, alerts as the levels that follow (two_terminals.py). With --write the outputs in the documents are replaced.
"""

import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from shown import MORE, Reading, is_shown, renewed

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "end_to_end"))
from two_terminals import masked  # noqa: E402

MOST = 600  # s: what a path takes, before anybody reads
SHARED = ("host", "tests", "toolchain", "firmware")
STAGE = {name: os.environ[name] for name in ("FENCEPOST_STAGE", "LD_PRELOAD") if name in os.environ}  # tests/stage
LIVE = re.compile(r"^fencepost (emulate|run|monitor|doctor --)|\brun\.log\b")


class Place:
    """A folder in which `fencepost` is the program."""

    def __init__(self, folder, program, sources, build, compiler):
        self.folder, self.sources = Path(folder), sources
        for name in SHARED:
            if (sources / name).exists():
                (self.folder / name).symlink_to(sources / name)
        (self.folder / "build").mkdir()
        (self.folder / "build/core").symlink_to(build)
        (self.folder / "bin").mkdir()
        (self.folder / "bin/fencepost").symlink_to(program)
        self.environment = {"PATH": f"{self.folder}/bin:/usr/local/bin:/usr/bin:/bin", "TERM": "dumb", "NO_COLOR": "1",
                            "LC_ALL": "C.UTF-8", "HOME": str(self.folder), "CXX": compiler, **STAGE}

    def started(self, command):
        return subprocess.Popen(["sh", "-c", command], cwd=self.folder, env=self.environment, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)

    def printed(self, process):
        text = process.communicate(timeout=MOST)[0].replace(str(self.folder), "~").replace(f"{self.sources}/", "")
        return [line.rstrip() for line in text.rstrip("\n").split("\n")] if text else []

    def await_links(self, command):
        """Until the devices of another terminal are there."""
        links = re.findall(r"--link (\S+)", command)
        deadline = time.monotonic() + 20
        while not all((self.folder / link).is_symlink() for link in links) and time.monotonic() < deadline:
            time.sleep(0.02)


def agree(command, printed, shown):
    if not LIVE.search(command):
        return is_shown(printed, shown)
    if MORE in shown:
        return is_shown([without_numbers(line) for line in printed], [without_numbers(line) for line in shown])
    return masked("\n".join(printed)) == masked("\n".join(shown))


def without_numbers(line):
    return re.sub(r"[0-9a-f]{16}|-?\d+(\.\d+)?", "#", re.sub(r" +", " ", line))


def walk(text, place):
    """(what differs, how many commands, seconds, the document as it would be now)"""
    reading = Reading(text, place.folder)
    wrong, commands, begun = [], 0, time.time()

    def compare(command, printed, shown, put):
        if not agree(command, printed, shown):
            wrong.append(f"$ {command}\nthe document shows:\n" + "\n".join(shown) + "\nit prints:\n" + "\n".join(printed))
            put(renewed(printed, shown))

    beside = None
    for command, shown, put in reading.commands():
        commands += 1
        process = place.started(command)
        if command.startswith("fencepost emulate"):
            place.await_links(command)
            beside = process, command, shown, put
            continue
        compare(command, place.printed(process), shown, put)
        if beside:
            process, *other = beside
            compare(other[0], place.printed(process), *other[1:])
            beside = None
    return wrong, commands, time.time() - begun, reading.document()


def main(arguments):
    write = "--write" in arguments
    program, sources, build, compiler, *names = [a for a in arguments if a != "--write"]
    program, sources, build = (Path(path).resolve() for path in (program, sources, build))
    different = 0
    for name in names:
        document = sources / f"host/share/doc/path_{name}.md"
        with tempfile.TemporaryDirectory() as folder:
            place = Place(folder, program, sources, build, compiler)
            wrong, commands, seconds, text = walk(document.read_text(encoding="utf-8"), place)
        if write:
            document.write_text(text, encoding="utf-8")
        print("\n\n".join(wrong))
        print(f"{document.name}: {commands} commands in {seconds:.0f} s, {len(wrong)} print something else than it shows")
        different += len(wrong) + (commands < 5) + (seconds > MOST)
    return 1 if different and not write else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
