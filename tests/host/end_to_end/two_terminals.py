"""Runs what two_terminals.txt shows, in two terminals, and compares: python3 two_terminals.py FENCEPOST SOURCES SECTION.

With --write as SECTION the text's outputs are replaced by what is seen. Numbers may differ; each device's lines, their order, and
which levels of alerts come one after the other may not.
"""

import os
import pty
import re
import select
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
from shown_place import shown_place  # noqa: E402

PATIENCE = 60  # s


class Terminal:
    """A program on a terminal of its own; what it shows."""

    def __init__(self, command, folder, environment):
        self.master, slave = pty.openpty()
        self.process = subprocess.Popen(["sh", "-c", "exec " + command], cwd=folder, env=environment, stdin=slave,
                                        stdout=slave, stderr=slave, start_new_session=True)
        os.close(slave)
        self.shown = ""

    def look(self):
        while select.select([self.master], [], [], 0.02)[0]:
            try:
                more = os.read(self.master, 4096)
            except OSError:  # the other side is closed
                return
            if not more:
                return
            self.shown += more.decode(errors="replace").replace("\r\n", "\n")

    def await_text(self, text):
        deadline = time.monotonic() + PATIENCE
        while text not in self.shown:
            self.look()
            if time.monotonic() > deadline:
                raise SystemExit(f"'{text}' did not appear; shown was:\n{self.shown}")
            time.sleep(0.01)

    def await_end(self, others=()):
        deadline = time.monotonic() + PATIENCE
        while self.process.poll() is None:
            for terminal in (self, *others):
                terminal.look()
            if time.monotonic() > deadline:
                self.process.kill()
                raise SystemExit(f"it did not end; shown was:\n{self.shown}")
            time.sleep(0.01)
        self.look()
        return self.process.returncode


def show_both(emulate, run, folder, environment):
    camera = Terminal(emulate, folder, environment)
    camera.await_text("create2 on ")
    robot = Terminal(run, folder, environment)
    if camera.await_end([robot]) != 0:
        raise SystemExit(f"emulate failed:\n{camera.shown}")
    for device in ("camera", "odometry"):
        while not re.search(rf"^{device} .* is absent", robot.shown, re.M):
            robot.await_text("is absent")
            robot.look()
    os.kill(robot.process.pid, signal.SIGINT)
    if robot.await_end() != 130:
        raise SystemExit(f"run ended with {robot.process.returncode}:\n{robot.shown}")
    return camera.shown, robot.shown


def masked(text):
    """Lines without their numbers, each device's together, for they are not in step; alerts as the levels that follow.

    How long the robot is blind until the camera starts, and when the other program has ended, is the machine's affair.
    """
    lines = []
    for line in text.strip().splitlines():
        if line.startswith("BLIND ") or line.endswith("it sees again"):
            continue
        alert = re.match(r"(CLEAR|NOTICE|WARN|STOP)\b", line)
        line = alert[1] if alert else re.sub(r"[0-9a-f]{16}|\d+(\.\d+)?", "#", line.rstrip())
        if not (alert and lines and lines[-1] == line):
            lines.append(line)
    return sorted(lines, key=lambda line: "" if line.isupper() else line.split()[0] if line else "")


def blocks_of(section):
    """(command, output) of each fenced block that begins with a prompt."""
    for block in re.findall(r"```\n\$ (.*?)```", section, re.S):
        command, output = re.match(r"((?:[^\n]*\\\n)*[^\n]*\n)(.*)", block, re.S).groups()
        yield command.replace("\\\n", " ").strip(), output


def main(program, sources, wanted):
    document = Path(sources) / "tests/host/end_to_end/two_terminals.txt"
    text = document.read_text()
    different = seen = 0
    for section in re.split(r"^(?=## )", text, flags=re.M):
        title = section.splitlines()[0].removeprefix("## ")
        if not section.startswith("## ") or (wanted not in ("--write", title.split()[1])):
            continue
        seen += 1
        (emulate, emulate_output), (run, run_output), *rest = blocks_of(section)
        with shown_place(program, sources) as (folder, environment):
            camera, robot = show_both(emulate, run, folder, environment)
            for command, _ in rest:
                subprocess.run(["sh", "-c", command], cwd=folder, env=environment, check=True,
                               stdout=subprocess.DEVNULL)
        for expected, shown in ((emulate_output, camera), (run_output, robot)):
            if wanted == "--write":
                document.write_text(document.read_text().replace(expected, shown))
            elif masked(expected) != masked(shown):
                different += 1
                print(f"{title}: the document says\n{expected}\nbut this was seen\n{shown}")
    if not seen:
        raise SystemExit(f"no section for {wanted} in {document}")
    return 1 if different else 0


if __name__ == "__main__":
    sys.exit(main(os.path.abspath(sys.argv[1]), os.path.abspath(sys.argv[2]), sys.argv[3]))
