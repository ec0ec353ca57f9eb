#!/usr/bin/env python3
"""usage: first_alert.py FENCEPOST SOURCES PART_CLOCK NODE EMULATOR IMAGE.uf2 VERSION [--write]

Goes the way of host/share/doc/FIRST_ALERT.md on an emulated Pico with programs that need no compiler. What it sees is compared
with what the guide shows; --write replaces that. PART_CLOCK (part_clock.cpp) is preloaded to those that have a clock: it is the part's,
however busy this machine is. Numbers may differ; lines, their order and which levels of alerts come one after the other may not.
"""

import hashlib
import json
import mmap
import os
import pathlib
import pty
import re
import select
import shutil
import socket
import struct
import subprocess
import sys
import tempfile
import time
import tty

PATIENCE = 120  # s
LIMIT = 600  # s: ten minutes
SLICE = 10_000  # us of the part's time
HANDED_OVER = 0.0005  # s until the kernel has handed what was written to a line to its other end
STEPS = ("check", "configure", "drag", "talk", "push", "stop_pin")
TOOLS = ("sh", "cp", "ls", "sha256sum", "python3")
DRIVE = "RPI-RP2"
BOOT_FACTS = {"INFO_UF2.TXT": "UF2 Bootloader\nModel: Raspberry Pi RP2\nBoard-ID: RPI-RP2\n", "INDEX.HTM": "<html></html>\n"}
STANDS = 20  # s that the scene's camera stands before it is pushed, from when it is first asked
GETS_READY = 3  # s that push.py waits, and what it takes to start
STARTS = 0.4
CAMERA_BEFORE = 3  # s that the camera has had power when the part gets it
SCENE = {
    "format": 1, "seed": 1,
    "camera": {"model": "pixy2.1", "width": 316, "height": 208, "fx": 188.3, "fy": 188.3, "cx": 157.5, "cy": 103.5, "k1": 0,
               "mount": {"x": 0, "y": 0, "z": 0.12, "yaw": 0, "pitch": 0}, "latency": 0.033, "rate": 25, "max_blobs": 16},
    "robot": {"width": 0.2}, "signatures": [{"id": 1, "name": "red", "rgb": "d02020"}],
    "objects": [{"name": "red tin", "signature": 1, "height": 0.1, "footprint": {"circle": [0.85, 0, 0.05]}}],
    "path": {"type": "poses", "poses": [{"t": t, "x": x, "y": 0, "heading": 0} for t, x in
                                        ((0, 0), (STANDS, 0), (STANDS + 6, 0.6), (STANDS + 30, 0.6))]}}


def state_of(pid):
    """R and D: it runs, or would."""
    return pathlib.Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0]


class Pico:
    """The part in its emulator, in step with the wall's clock or slower, and `clock` with it.

    Its lines: a camera's pty, and a computer's port.
    """

    LINES = ("console", "camera", "usb", "control")

    def __init__(self, node, emulator, image, folder, camera, clock, programs):
        """`programs`: those that talk to it, as they are started."""
        self.clock = clock
        self.programs = programs
        folder = os.path.join(folder, "lines")
        os.mkdir(folder)
        listeners = []
        for name in self.LINES:
            listener = socket.socket(socket.AF_UNIX)
            listener.bind(os.path.join(folder, name))
            listener.listen()
            listeners.append(listener)
        self.process = subprocess.Popen([node, emulator, image, *(os.path.join(folder, name) for name in self.LINES)])
        console, self.camera, self.usb, self.control = (listener.accept()[0] for listener in listeners)
        console.setblocking(False)
        self.ignored = console
        self.camera_pty = camera
        self.port, slave = pty.openpty()
        tty.setraw(slave)
        self.place = os.ttyname(slave)
        self.kept = slave  # a port does not go away because a program has closed it
        self.written = bytearray()
        self.seconds = 0.0
        self.behind = time.monotonic()
        self.tell("usb plug")

    def tell(self, line):
        self.control.sendall(line.encode() + b"\n")

    def ask(self, line):
        self.tell(line)
        answer = b""
        while not answer.endswith(b"\n"):
            more = self.control.recv(65536)
            if not more:
                raise SystemExit("the emulated Pico has ended")
            answer += more
        return answer.decode()

    @staticmethod
    def move(source, target):
        while select.select([source], [], [], 0)[0]:
            data = source.recv(4096) if isinstance(source, socket.socket) else os.read(source, 4096)
            if not data:
                return
            target(data)

    # One line a slice of those that a program has written: two records would have one time.
    def give_a_line(self):
        self.move(self.port, self.written.extend)
        end = self.written.find(b"\n") + 1 or self.written.find(b"\r") + 1
        self.usb.sendall(self.written[:end])
        del self.written[:end]

    # Its time waits for programs that this machine has not let run yet.
    def await_programs(self):
        deadline = time.monotonic() + PATIENCE
        while True:
            time.sleep(HANDED_OVER)
            if all(state_of(program.pid) not in "RD" for program in self.programs):
                return
            if time.monotonic() > deadline:
                raise SystemExit("a program never comes to rest")

    def turn(self):
        """One slice of its time, not before that has passed here."""
        time.sleep(max(self.behind + self.seconds - time.monotonic(), 0))
        self.move(self.camera_pty, self.camera.sendall)
        self.give_a_line()
        self.await_programs()
        self.seconds = int(self.ask(f"run {SLICE}").split()[1]) * 1e-6
        now = time.monotonic()
        self.behind = max(self.behind, now - self.seconds)
        self.clock[:] = struct.pack("dd", now, CAMERA_BEFORE + self.seconds)
        self.move(self.camera, lambda data: os.write(self.camera_pty, data))
        self.move(self.usb, lambda data: os.write(self.port, data))
        self.move(self.ignored, lambda data: None)

    def end(self):
        self.process.kill()
        self.process.wait()


class Terminal:
    """A program with the port open, at which somebody types: what is on its screen, typed lines behind `> `."""

    def __init__(self, pico):
        self.pico = pico
        self.port = os.open(pico.place, os.O_RDWR | os.O_NOCTTY | os.O_NONBLOCK)
        self.screen = ""

    def look(self):
        self.pico.turn()
        while select.select([self.port], [], [], 0)[0]:
            self.screen += os.read(self.port, 4096).decode(errors="replace").replace("\r", "")

    def await_text(self, text, begin=0):
        deadline = time.monotonic() + PATIENCE
        while text not in self.screen[begin:]:
            if time.monotonic() > deadline:
                raise SystemExit(f"'{text}' did not appear:\n{self.screen}")
            self.look()

    def type(self, line, answer):
        begin = len(self.screen)
        self.screen += f"> {line}\n"
        os.write(self.port, line.encode() + b"\r")
        self.await_text(answer, begin + len(line) + 3)
        while not self.screen.endswith("\n"):
            self.look()

    def close(self):
        os.close(self.port)


def await_text(process, text, meanwhile):
    shown = ""
    deadline = time.monotonic() + PATIENCE
    while text not in shown:
        meanwhile()
        if select.select([process.stdout], [], [], 0.01)[0]:
            shown += os.read(process.stdout.fileno(), 4096).decode()
        if time.monotonic() > deadline or process.poll() is not None:
            raise SystemExit(f"'{text}' did not appear:\n{shown}")
    return shown


class Way:
    """The steps, in a folder with the release's files and no compiler in the path."""

    def __init__(self, fencepost, sources, part_clock, node, emulator, image, version, folder):
        self.folder = pathlib.Path(folder)
        self.begun = time.monotonic()
        self.node, self.emulator = node, emulator
        self.image = f"fencepost-{version}-pico.uf2"
        shutil.copy(image, self.folder / self.image)
        digest = hashlib.sha256((self.folder / self.image).read_bytes()).hexdigest()
        (self.folder / "SHA256SUMS").write_text(f"{digest}  {self.image}\n")
        for name in ("push.py", "robot.json"):
            shutil.copy(pathlib.Path(sources) / "host/share/examples" / name, self.folder)
        tools = self.folder / "bin"
        tools.mkdir()
        for tool in TOOLS:
            os.symlink(sys.executable if tool == "python3" else shutil.which(tool), tools / tool)
        os.symlink(pathlib.Path(fencepost).resolve(), tools / "fencepost")
        self.environment = {"PATH": str(tools), "HOME": folder, "TERM": "dumb", "NO_COLOR": "1", "PYTHONUNBUFFERED": "1"}
        (self.folder / "clock").write_bytes(bytes(struct.calcsize("dd")))
        with (self.folder / "clock").open("r+b") as file:
            self.clock = mmap.mmap(file.fileno(), 0)
        self.by_part = {"LD_PRELOAD": str(pathlib.Path(part_clock).resolve()), "FENCEPOST_PART_CLOCK": str(self.folder / "clock")}
        (self.folder / DRIVE).mkdir()
        for name, text in BOOT_FACTS.items():
            (self.folder / DRIVE / name).write_text(text)
        self.children = []

    def start(self, command, **how):
        process = subprocess.Popen(["sh", "-c", "exec " + command], cwd=self.folder, env=self.environment | self.by_part, **how)
        self.children.append(process)
        return process

    def run(self, command):
        done = subprocess.run(["sh", "-c", command], cwd=self.folder, env=self.environment, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise SystemExit(f"{command}: {done.returncode}\n{done.stdout}{done.stderr}")
        return done.stdout + done.stderr

    def check(self):
        return self.run("sha256sum -c --ignore-missing SHA256SUMS")

    def configure(self):
        return self.run(f"fencepost configure {self.image} --camera pixy2.1 --robot robot.json -o MINE.uf2")

    def drag(self):
        """The boot ROM takes the file, lets go of the drive and starts the program."""
        said = self.run(f"cp MINE.uf2 {DRIVE}/")
        (taken,) = (self.folder / DRIVE).glob("*.uf2")
        uf2 = taken.rename(self.folder / "flash.uf2")
        shutil.rmtree(self.folder / DRIVE)
        (self.folder / "scene.json").write_text(json.dumps(SCENE))
        self.camera = self.start("fencepost emulate pixy2.1 scene.json --link ./camera", stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        await_text(self.camera, "pixy2.1 on ", lambda: None)
        for n in range(int(CAMERA_BEFORE / (SLICE * 1e-6))):
            self.clock[:] = struct.pack("dd", time.monotonic(), n * SLICE * 1e-6)
            time.sleep(HANDED_OVER)
        camera = os.open(self.folder / "camera", os.O_RDWR | os.O_NOCTTY)
        tty.setraw(camera)
        self.pico = Pico(self.node, self.emulator, str(uf2), self.folder, camera, self.clock, self.children)
        os.symlink(self.pico.place, self.folder / "pico")
        return said

    def talk(self):
        terminal = Terminal(self.pico)
        await_text(self.camera, "time begins", terminal.look)
        stands_until = self.pico.seconds + STANDS
        terminal.await_text("panic: none\n")
        terminal.await_text("camera works")
        terminal.await_text("odometry is silent")
        terminal.type("selftest", "selftest pass")
        terminal.type("status", "objects ")
        terminal.close()
        self.push_at = stands_until - GETS_READY - STARTS
        if self.pico.seconds > self.push_at:
            raise SystemExit("the camera moved before it was pushed")
        return terminal.screen

    def push(self):
        while self.pico.seconds < self.push_at:
            self.pico.turn()
        program = self.start("python3 push.py ./pico pixy2.1 0.12", stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        while program.poll() is None:
            self.pico.turn()
        if program.returncode != 0:
            raise SystemExit(f"push.py ended with {program.returncode}")
        return program.stdout.read().decode()

    def stop_pin(self):
        changes = json.loads(self.pico.ask("stop"))
        return "".join(f"{at * 1e-6:6.1f} s  {'high: it may drive' if high else 'low: it stands'}\n" for at, high in [(0, 0), *changes])

    def end(self):
        if hasattr(self, "pico"):
            self.pico.end()
        for process in self.children:
            process.kill()
            process.wait()


def masked(text):
    """Without numbers; of alerts, which levels come one after the other for the first time. When it says that it is blind, or
    what it hears of its sensors, is its own affair."""
    lines = []
    for line in text.strip().splitlines():
        if line.startswith(("BLIND ", "camera works", "odometry is ")) or line.endswith("it sees again"):
            continue
        alert = re.match(r"(CLEAR|NOTICE|WARN|STOP)\b", line)
        line = alert[1] if alert else re.sub(r"[0-9a-f]{16}|\d+(\.\d+)?", "#", line.rstrip())
        if not (alert and line in lines):
            lines.append(line)
    return lines


def go(*facts):
    """({step: what was seen}, how long it took)"""
    with tempfile.TemporaryDirectory() as folder:
        way = Way(*facts, folder)
        try:
            return {name: getattr(way, name)() for name in STEPS}, time.monotonic() - way.begun
        finally:
            way.end()


def main():
    if len(sys.argv) not in (8, 9):
        sys.exit(__doc__.strip())
    document = pathlib.Path(sys.argv[2]) / "host/share/doc/FIRST_ALERT.md"
    text = document.read_text()
    blocks = dict(re.findall(r"<!-- (\w+) -->\n```\n(?:\$ [^\n]*\n)?(.*?)```", text, re.S))
    if set(blocks) != set(STEPS):
        sys.exit(f"{document} shows {sorted(blocks)}, the way has {sorted(STEPS)}")
    shown, took = go(*sys.argv[1:8])
    different = [name for name in STEPS if masked(blocks[name]) != masked(shown[name])]
    if sys.argv[8:] == ["--write"]:
        for name, seen in shown.items():
            text = re.sub(rf"(<!-- {name} -->\n```\n(?:\$ [^\n]*\n)?).*?```", lambda match, seen=seen: match[1] + seen + "```", text, flags=re.S)
        document.write_text(text)
        return 0
    for name in different:
        print(f"{name}: the document says\n{blocks[name]}\nbut this was seen\n{shown[name]}")
    print(f"{took:.0f} s, {len(different)} steps differ")
    return 1 if different or took > LIMIT else 0


if __name__ == "__main__":
    sys.exit(main())
