"""Hostile hands on each surface of the program: whatever comes, it ends with a code of its list, in memory and time that have limits.

usage: surfaces.py FENCEPOST RECORDINGS [--times N] [--seed N] [--surface NAME]... [--planted]
"""
import argparse
import concurrent.futures
import fcntl
import gzip
import json
import os
import pathlib
import pty
import random
import re
import resource
import select
import signal
import socket
import struct
import subprocess
import sys
import tempfile
import termios
import threading
import time

LONGEST = 120  # s of any command, on a busy machine
MEMORY = 3_000_000_000  # bytes of address space
NAME = "</script><script>alert(1)</script>\u202e<img src=x onerror=alert(2)>\u2028"


class Broken(AssertionError):
    pass


def expect(good, *what):
    if not good:
        raise Broken(" ".join(str(one) for one in what))


class Bench:
    def __init__(self, program, recordings, times, seed):
        self.program, self.recordings, self.times = program, recordings, times
        self.dice = random.Random(seed)
        self.held = tempfile.TemporaryDirectory(prefix="fencepost-hostile-")
        self.folder = pathlib.Path(self.held.name)
        self.log = recordings / "approach_stop.log"

    def start(self, *arguments, largest=None, **options):
        """`largest`: no file gets more bytes, as on a disk that is full then."""
        def limit():
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            if largest:
                signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
                resource.setrlimit(resource.RLIMIT_FSIZE, (largest, largest))

        return subprocess.Popen([self.program, *map(str, arguments)], cwd=self.folder, preexec_fn=limit, **options)

    def run(self, *arguments, codes=(0, 1, 3), given=b""):
        """Code, output and words; the code is one of the list, within the limits, and the words are none of a surprise."""
        process = self.start(*arguments, stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        try:
            out, err = process.communicate(given, timeout=LONGEST)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            raise Broken("does not end:", *arguments) from None
        said = err.decode("utf-8", "replace")
        expect(process.returncode in codes, process.returncode, "instead of", codes, "by", *arguments, said[-500:])
        expect("not foreseen" not in said and "out of memory" not in said, *arguments, said[-500:])
        expect(process.returncode != 3 or said.strip(), "no word by", *arguments)
        expect(not re.search(r"[\x00-\x09\x0b-\x1f\x7f]", said.replace("\r", "")), "control characters by", *arguments)
        return process.returncode, out, said

    def mutated(self, whole):
        """One to eight changes: bytes, cuts, repetitions, other numbers."""
        data = bytearray(whole)
        for _ in range(self.dice.randint(1, 8)):
            at = self.dice.randrange(len(data)) if data else 0
            end = min(len(data), at + self.dice.randint(1, 40))
            kind = self.dice.randrange(6)
            if kind == 0 and data:
                data[at] = self.dice.randrange(256)
            elif kind == 1:
                del data[at:end]
            elif kind == 2:
                data[at:at] = data[at:end] * self.dice.randint(1, 50)
            elif kind == 3:
                data[at:at] = self.dice.choice([b"-1", b"1e999", b"nan", b"99999999999999999999", b"\x00", b"\xff\xfe", b'"', b"[", b","])
            elif kind == 4:
                del data[at:]
            elif data:
                data[at] ^= 1 << self.dice.randrange(8)
        return bytes(data)


def inputs(bench):
    """Mutated logs, tables, recordings of others and scenes."""
    bench.run("export", bench.log, "--format", "mcap", "-o", "seed.mcap", codes=(0,))
    boxes = "".join(f"{0.1 * i:.1f},{100 + i},90,20,30,1,red\n" for i in range(40)).encode()
    sketch = "".join(f"Detected 1\n  block 0: sig: 1 x: {100 + i} y: 99 width: 20 height: 30 index: 3 age: {i}\n" for i in range(40)).encode()
    poses = "".join(f"{0.1 * i:.1f},{0.01 * i:.2f},0,0\n" for i in range(40)).encode()
    (bench.folder / "poses.csv").write_bytes(b"t,x,y,heading\n" + poses)
    field = lambda data: struct.pack("<I", len(data)) + data
    entry = lambda number, t, data: b"\x7f" + struct.pack("<IIQ", number, len(data), int(1e6 * t)) + data
    begin = lambda number, name, kind: entry(0, 0, b"\0" + struct.pack("<I", number) + field(name) + field(kind) + field(b""))
    robot = b"WPILOG\0\1" + field(b"") + begin(1, b"/Odometry/Robot", b"struct:Pose2d") + begin(2, b"NT:/limelight/rawdetections", b"double[]")
    for i in range(40):
        robot += entry(1, 0.1 * i, struct.pack("<3d", 0.01 * i, 0, 0))
        robot += entry(2, 0.1 * i + 0.01, struct.pack("<12d", 1, 0, 0, 0.1, 100, 50, 120 + i, 50, 120 + i, 80, 100, 80))
    log = bench.log.read_bytes()[:30_000]
    scene = bench.log.with_suffix(".json").read_bytes()
    camera = ("--camera", "pixy2", "-o", "out.log")
    for seed, name, *command in (
        (log, "a.log", "replay", "@"),
        (log, "a.log", "doctor", "@"),
        (log, "a.log", "export", "@", "-o", "out.csv"),
        (log, "a.log", "report", "@", "-o", "out.html"),
        (scene, "s.json", "simulate", "@", "-o", "out.log"),
        (b"t,x,y,w,h,sig,name\n" + boxes, "b.csv", "import", "csv", "@", *camera),
        (b"t,x,y,w,h,sig,name\n" + boxes, "b.csv", "import", "csv", "@", "--poses", "poses.csv", *camera),
        (b"t,x,y,heading\n" + poses, "p.csv", "import", "csv", bench.folder / "b.seed", "--poses", "@", *camera),
        (sketch, "m.txt", "import", "sketch", "@", *camera),
        (robot, "a.wpilog", "import", "wpilog", "@", *camera),
        ((bench.folder / "seed.mcap").read_bytes(), "a.mcap", "import", "mcap", "@", "--camera", bench.log, "-o", "out.log"),
    ):
        (bench.folder / "b.seed").write_bytes(b"t,x,y,w,h,sig,name\n" + boxes)
        bench.run(*[name if word == "@" else word for word in command], codes=(3,))  # it is not there yet
        (bench.folder / name).write_bytes(seed)
        bench.run(*[name if word == "@" else word for word in command], codes=(0, 1))  # a seed that is read
        for _ in range(bench.times):
            (bench.folder / name).write_bytes(bench.mutated(seed))
            bench.run(*[name if word == "@" else word for word in command])
        (bench.folder / name).unlink()


def packed(bench):
    """A few KB that become 100 MB, and texts that become many times their size in memory."""
    bombs = {
        "line.gz": (b"x", 100_000_000),
        "blanks.gz": (b" ", 100_000_000),
        "deep.gz": (b"[", 40_000_000),
        "lines.gz": (b"\n", 100_000_000),
    }
    for name, (byte, count) in bombs.items():
        with gzip.open(bench.folder / name, "wb", 1) as file:
            for _ in range(count // 1_000_000):
                file.write(byte * 1_000_000)
        for command in (("import", "csv", name, "--camera", "pixy2"), ("import", "sketch", name, "--camera", "pixy2"),
                        ("simulate", name), ("replay", name), ("import", "mcap", name, "--camera", "pixy2"),
                        ("replay", bench.log, "--camera", name), ("configure", name, "-o", "x.bin")):
            bench.run(*command, codes=(3,))
        (bench.folder / name).unlink()


def runs(bench):
    """Live runs of damaged records that are ended at any time: the log replays to what the run said, or is a part of it."""
    for i in range(max(1, bench.times // 4)):
        given = bench.mutated(bench.log.read_bytes())
        log = f"run{i}.log"
        process = bench.start("run", "--camera", "console", "--odometry", "console", "--mode", "quiet", "--log", log, "--seconds", "20",
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        ended = bench.dice.choice([None, signal.SIGTERM, signal.SIGINT])
        if ended is None:
            out, err = process.communicate(given, timeout=LONGEST)
        else:
            os.set_blocking(process.stdin.fileno(), False)
            process.stdin.write(given[: bench.dice.randrange(60_000)] or b"\n")
            time.sleep(bench.dice.uniform(0.2, 1))
            process.send_signal(ended)
            out, err = process.communicate(timeout=LONGEST)
        expect(process.returncode in (0, 4, 130), process.returncode, "by run,", err.decode("utf-8", "replace")[-500:])
        said = re.search(r"digest ([0-9a-f]{16})", (out + err).decode("utf-8", "replace"))
        code, out, words = bench.run("replay", log, "--check", "--json")
        expect(code == 0 or "no frame" in words or "no record" in words or "empty" in words or "none of" in words, words)
        if code == 0 and said:
            expect(said[1] in out.decode(), "run said digest", said[1], "and the log has another")


CAMERAS = ("cmucam1", "cmucam2", "cmucam3", "cmucam4", "cognachrome", "openmv", "maixcam", "vex", "cbc", "grove", "huskylens", "huskylens2",
           "jevois", "nxtcam", "nxtcam5", "avrcam", "pixy1", "pixy2", "pixy2.1", "xbc")
WHEELS = ("create1", "create2", "nxt", "records")
FAULTS = ("", "drop=0.002", "corrupt=0.002", "stall=0.002:1.5", "late=0.05:0.3", "reboot=4", "unplug=4:1", "drop=0.001,corrupt=0.001,unplug=5:1")


class LiveRun:
    """`run` on a camera and wheels that `emulate` plays, with one fault of the line, one of the machine, and one way to end."""

    def __init__(self, bench, number):
        dice = random.Random(bench.dice.random())
        self.bench, self.dice, self.tag = bench, dice, f"live{number}"
        self.camera, self.wheels, self.fault = dice.choice(CAMERAS), dice.choice(WHEELS), dice.choice(FAULTS)
        self.trouble = dice.choice(("", "run sleeps", "devices sleep", "full disk", "slow disk", "parts", "view", "command that hangs", "no devices"))
        self.end = dice.choice(("seconds", "SIGINT", "SIGTERM", "SIGKILL"))
        self.folder = bench.folder / self.tag
        self.folder.mkdir()
        self.log = self.folder / "run.log"

    def __str__(self):
        return f"{self.tag}: {self.camera}, {self.wheels}, {self.fault or 'good line'}, {self.trouble or 'no trouble'}, ends by {self.end}"

    def go(self):
        """Answers whether frames came, and whether the run said its digest: then the log has the same."""
        at = [f"{self.folder}/camera", f"{self.folder}/wheels"]
        scene = self.bench.recordings.parent / "doc/sensors" / f"{self.camera}.json"
        faults = ["--fault", self.fault, "--seed", self.dice.randrange(1, 1000)] if self.fault else []
        self.devices = self.bench.start("emulate", self.camera, self.wheels, scene, "--link", at[0], "--link", at[1], "--loop", "--delay", 2, *faults,
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            return self.drive(scene, at)
        finally:
            self.devices.kill()
            self.devices.wait()

    def drive(self, scene, at):
        since = time.monotonic()
        while not (os.path.lexists(at[0]) and os.path.lexists(at[1])):
            expect(time.monotonic() - since < LONGEST and self.devices.poll() is None, "no devices for", self)
            time.sleep(0.05)
        more = {"parts": ["--log-size", "8K"], "view": ["--view"], "command that hangs": ["--on-alert", "sleep 30"]}.get(self.trouble, [])
        if self.end == "seconds":
            more += ["--seconds", self.dice.randint(5, 12)]
        reader = None
        if self.trouble == "slow disk":
            os.mkfifo(self.log)
            reader = threading.Thread(target=self.read_slowly, daemon=True)
            reader.start()
        words = open(self.folder / "said", "w+b")  # no pipe: a command of a killed run would hold it open
        process = self.bench.start("run", "--camera", f"{self.camera}:{at[0]}", "--odometry", f"{self.wheels}:{at[1]}", "--robot", scene, "--mode", "quiet",
                                   "--log", self.log, "--wait", *more, largest=self.dice.randint(4, 60) * 1024 if self.trouble == "full disk" else None,
                                   stdin=subprocess.DEVNULL, stdout=words, stderr=words)
        try:
            self.disturb_and_end(process)
        except subprocess.TimeoutExpired:
            raise Broken("does not end:", self) from None
        finally:
            process.kill()
            process.wait()
            words.close()
            if reader:
                reader.join(LONGEST)
        said = (self.folder / "said").read_text("utf-8", "replace")
        codes = {"full disk": (4,)}.get(self.trouble, ()) + {"SIGKILL": (-signal.SIGKILL,), "SIGINT": (130,)}.get(self.end, (0,))
        expect(process.returncode in codes, process.returncode, "by", self, said[-500:])
        expect("not foreseen" not in said, self, said[-500:])
        return self.replays(process.returncode, re.search(r"digest ([0-9a-f]{16})", said))

    def read_slowly(self):
        with open(self.log, "rb", buffering=0) as pipe, open(self.folder / "read.log", "wb") as kept:
            while block := pipe.read(2000):
                kept.write(block)
                time.sleep(0.05)

    def disturb_and_end(self, process):
        time.sleep(self.dice.uniform(1, 5))
        sleeper = {"run sleeps": process, "devices sleep": self.devices}.get(self.trouble)
        if sleeper and process.poll() is None:
            sleeper.send_signal(signal.SIGSTOP)
            time.sleep(self.dice.uniform(0.2, 3))
            sleeper.send_signal(signal.SIGCONT)
        time.sleep(self.dice.uniform(1, 5))
        if self.trouble == "no devices":
            self.devices.kill()
            time.sleep(1)
        if self.end != "seconds":
            process.send_signal(getattr(signal, self.end))
        process.wait(timeout=LONGEST)

    def replays(self, code, digest):
        parts = [self.log, *sorted(self.folder.glob("run-*.log"))]
        if self.trouble == "slow disk":
            parts = [self.folder / "read.log"]
        whole = self.folder / "whole.log"
        whole.write_bytes(b"".join(part.read_bytes() for part in parts))
        status, out, words = self.bench.run("replay", whole, "--check", "--json", codes=(0, 3))
        if status == 3:
            expect(code != 0 or "no frame" in words, self, words)
            return False, False
        compared = digest is not None and self.trouble != "full disk"
        expect(not compared or digest[1] in out.decode(), "the log's digest is not what the run said:", self, digest)
        return True, compared


def emulated(bench):
    """Live runs on emulated devices, on bad lines and a bad machine, ended in each way: the log replays to what the run said."""
    lives = [LiveRun(bench, i) for i in range(max(2, bench.times))]
    with concurrent.futures.ThreadPoolExecutor(4) as pool:
        seen, compared = map(sum, zip(*pool.map(LiveRun.go, lives)))
    pairs = {(life.camera, life.wheels) for life in lives}
    print(f"emulated: {len(lives)} runs of {len(pairs)} pairs, {seen} with frames, of {compared} the digest is the log's")


def view(bench):
    """Requests of pages that may not see the run, of no page at all, and none; the run's own page still comes."""
    process = bench.start("run", "--camera", "console", "--odometry", "console", "--mode", "quiet", "--view",
                          stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    try:
        said = process.stderr.readline().decode()
        while "http://" not in said:
            expect(said, "the view's address was not said")
            said = process.stderr.readline().decode()
        port = int(re.search(r"127\.0\.0\.1:(\d+)", said)[1])

        def ask(request, wait=5.0):
            with socket.create_connection(("127.0.0.1", port), timeout=wait) as line:
                try:
                    line.sendall(request)
                    return line.makefile("rb").readline().decode("latin-1")
                except (TimeoutError, ConnectionError):
                    return ""

        own = b"GET / HTTP/1.1\r\nHost: localhost\r\n\r\n"
        expect(" 200 " in ask(own), "its own page does not come")
        for request in (b"GET / HTTP/1.1\r\nHost: evil.example\r\n\r\n", b"GET / HTTP/1.1\r\nHost: localhost@evil.example\r\n\r\n",
                        b"GET / HTTP/1.1\r\nHost: localhost.\r\nHost: localhost\r\n\r\n", b"GET / HTTP/1.1\r\nHost: localhost\r\nOrigin: null\r\n\r\n",
                        b"GET / HTTP/1.1\r\nHost: localhost\r\nOrigin: http://evil.example\r\n\r\n", b"GET http://evil.example/ HTTP/1.1\r\n\r\n",
                        b"POST / HTTP/1.1\r\nHost: localhost\r\n\r\n", b"GET /../../etc/passwd HTTP/1.1\r\nHost: localhost\r\n\r\n",
                        b"GET / HTTP/1.1\nHost: localhost\n\n", b"GET /\0 HTTP/1.1\r\nHost: localhost\r\n\r\n", b"\x16\x03\x01\r\n\r\n",
                        b"GET /" + b"a" * 200_000 + b" HTTP/1.1\r\nHost: localhost\r\n\r\n"):
            answer = ask(request)
            expect(" 200 " not in answer, "got the run:", request[:60], answer)
        for _ in range(bench.times):
            ask(bench.mutated(own), 0.3)
        crowd = [socket.create_connection(("127.0.0.1", port)) for _ in range(20)]  # that say nothing
        for line in crowd:
            line.close()
        end = time.monotonic() + 30
        while " 200 " not in ask(own):
            expect(time.monotonic() < end, "its own page comes no more")
        descriptors = len(os.listdir(f"/proc/{process.pid}/fd"))
        expect(descriptors < 40, descriptors, "descriptors are open")
    finally:
        process.stdin.close()
        process.terminate()
        expect(process.wait(timeout=LONGEST) in (0, 130), process.returncode, "at the end of run --view")


def names(bench):
    """Names of colours, logs and scenes that are markup, scripts, or turn the text's direction."""
    import binascii

    coded = "".join("%%%02X" % c if c in b",*$%" or c < 32 else chr(c) for c in NAME[:24].encode() if c < 127)
    body = f"FPSIG,1,d02020,{coded}"
    line = "$%s*%04X" % (body, binascii.crc_hqx(body.encode(), 0xFFFF))
    text = re.sub(r"\$FPSIG,1,[^\r\n]*", lambda _: line, bench.log.read_text())
    path = bench.folder / ('<img src=x onerror=alert(3)>"\'.log')
    path.write_text(text)
    plain = bench.folder / "plain.log"
    plain.write_bytes(bench.log.read_bytes())
    pages = {}
    for name, log in (("hostile", path), ("plain", plain)):
        for kind in ((), ("--static",)):
            page = f"{name}{len(kind)}.html"
            bench.run("report", log, *kind, "-o", page, codes=(0,))
            pages[name, kind] = (bench.folder / page).read_text()
    for kind in ((), ("--static",)):
        for mark in ("<script", "<img", "onerror=", "</script"):
            tags = [len(re.findall(r"<[^<>]*" + re.escape(mark.strip("<")), pages[name, kind])) for name in ("hostile", "plain")]
            expect(tags[0] == tags[1], f"{mark}: {tags[0]} instead of {tags[1]}", *kind)
    for form in ("svg", "geojson", "csv"):
        _, out, _ = bench.run("export", path, "--format", form, "-o", "-", codes=(0,))
        expect(b"<script" not in out or form in ("geojson", "csv"), form)
        if form == "geojson":
            json.loads(out)
    for command in (("replay", path), ("doctor", path)):
        _, out, _ = bench.run(*command, codes=(0, 1))
        expect("\u202e" not in out.decode() and "\x1b" not in out.decode(), *command)


def outputs(bench):
    """Results into links, folders, full disks, the input itself: refused with a reason, and nothing is left."""
    target = bench.folder / "target"
    target.write_text("old")
    (bench.folder / "link.svg").symlink_to(target)
    bench.run("export", bench.log, "-o", "link.svg", codes=(0,))
    expect("<svg" in target.read_text(), "a link was not followed")
    expect((bench.folder / "link.svg").is_symlink(), "a link was replaced")
    own = bench.folder / "own.log"
    own.write_bytes(bench.log.read_bytes())
    os.link(own, bench.folder / "hard.svg")
    before = own.read_bytes()
    known = set(os.listdir(bench.folder))
    for path, codes in (("own.log", (2,)), ("hard.svg", (2,)), ("/dev/full", (4,)), (".", (4,)), ("no/such/x.svg", (4,)), ("/proc/x.svg", (4,))):
        bench.run("export", own, "--format", "svg", "-o", path, codes=codes)
        bench.run("report", own, "-o", path, codes=codes)
    expect(own.read_bytes() == before, "the input was changed")
    expect(set(os.listdir(bench.folder)) == known, "left:", *(set(os.listdir(bench.folder)) - known))


def terminals(bench):
    """The monitor on terminals of any size that change it, type anything, and go."""
    for i in range(max(6, bench.times // 4)):
        sizes = [(1, 1), (0, 0), (2, 3), (65535, 65535), (80, 24), (5000, 2)]
        master, slave = pty.openpty()
        size = lambda columns, rows: fcntl.ioctl(master, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))
        size(*sizes[i % len(sizes)])
        monitor = bench.start("monitor", bench.log, "--speed", "0", stdin=slave, stdout=slave, stderr=subprocess.PIPE, start_new_session=True)
        os.close(slave)
        leaves = bench.dice.choice(["q", "hang up", "SIGTERM"])
        end = time.monotonic() + LONGEST
        for _ in range(6):
            if select.select([master], [], [], 0.2)[0]:
                os.read(master, 1 << 20)
            size(*bench.dice.choice(sizes))
            os.write(master, bytes(bench.dice.choice(b" pz+-\x1b[A\x00\xff\n") for _ in range(4)))
        if leaves == "hang up":
            os.close(master)
        elif leaves == "SIGTERM":
            monitor.terminate()
        while monitor.poll() is None:
            if time.monotonic() > end:
                monitor.kill()
                raise Broken("the monitor does not end:", leaves)
            if leaves == "q":
                os.write(master, b"q")
            if leaves != "hang up" and select.select([master], [], [], 0.1)[0]:
                try:
                    os.read(master, 1 << 20)
                except OSError:
                    break
            time.sleep(0.01)
        expect(monitor.wait(timeout=LONGEST) in (0, 3, 4, 130, -signal.SIGHUP), monitor.returncode, leaves, monitor.stderr.read()[-300:])
        monitor.stderr.close()
        if leaves != "hang up":
            os.close(master)


SURFACES = {f.__name__: f for f in (inputs, packed, runs, emulated, view, names, outputs, terminals)}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("recordings", type=pathlib.Path)
    parser.add_argument("--times", type=int, default=3, help="mutations of each seed")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--surface", action="append", choices=SURFACES)
    parser.add_argument("--planted", action="store_true", help="FENCEPOST is one that crashes: each surface has to find that")
    asked = parser.parse_args()
    failed = 0
    surfaces = asked.surface or list(SURFACES)
    for name in surfaces:
        bench = Bench(asked.program.resolve(), asked.recordings.resolve(), asked.times, asked.seed)
        started = time.monotonic()
        try:
            SURFACES[name](bench)
            print(f"{name}: held, {time.monotonic() - started:.0f} s", flush=True)
        except (Broken, OSError, subprocess.TimeoutExpired) as broken:
            failed += 1
            print(f"{name}: BROKEN: {broken}", flush=True)
        bench.held.cleanup()
    return failed != (len(surfaces) if asked.planted else 0)


if __name__ == "__main__":
    sys.exit(main())
