"""`fencepost monitor` on a terminal: what it shows, at which size, and that it gives the terminal back.

usage: terminal_test.py FENCEPOST RECORDINGS
"""
import fcntl
import os
import pathlib
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import termios
import time
import unittest

RECORDINGS, FENCEPOST = (pathlib.Path(sys.argv.pop()).resolve() for _ in range(2))
LOG = RECORDINGS / "approach_stop.log"
LONGEST = 60  # s; a busy machine is slow


class Screen:
    """The picture on a terminal of that size, by the few sequences that are used."""

    def __init__(self, columns, rows):
        self.resize(columns, rows)
        self.alternate = False
        self.cursor = True
        self.bells = 0
        self.styles = 0
        self.overrun = False
        self.text = ""

    def resize(self, columns, rows):
        self.columns, self.rows = columns, rows
        self.lines = [""] * rows

    def take(self, text):
        self.text += text
        pattern = re.compile(r"\x1b\[(\??)([\d;]*)([A-Za-z])|([^\x1b]+)|(\x1b)")
        row = getattr(self, "row", 0)
        for private, numbers, letter, plain, stray in pattern.findall(text):
            assert not stray, "an escape sequence was split or is not known"
            if plain:
                self.bells += plain.count("\a")
                plain = plain.replace("\a", "")
                if row < self.rows:
                    self.lines[row] += plain
                    self.overrun |= len(self.lines[row].rstrip("\r\n")) > self.columns
            elif private and numbers == "1049":
                self.alternate = letter == "h"
            elif private and numbers == "25":
                self.cursor = letter == "h"
            elif letter == "H":
                row = int(numbers.split(";")[0]) - 1
                if row < self.rows:
                    self.lines[row] = ""
                else:
                    self.overrun = True
            elif letter == "J":
                self.lines = [""] * self.rows
            elif letter == "m":
                self.styles += numbers != "0"
            elif letter != "K":
                raise AssertionError(f"unexpected sequence {numbers}{letter}")
        self.row = row

    def shown(self):
        return "\n".join(self.lines)


class Monitor:
    def __init__(self, *arguments, columns=80, rows=24, **environment):
        self.master, self.slave = pty.openpty()
        self.screen = Screen(columns, rows)
        self.set_size(columns, rows)
        self.before = termios.tcgetattr(self.slave)
        environment = {**os.environ, "TERM": "xterm-256color", **environment}
        if "NO_COLOR" not in arguments:
            environment.setdefault("NO_COLOR", "")
        self.process = subprocess.Popen([FENCEPOST, "monitor", *map(str, arguments)], stdin=self.slave, stdout=self.slave,
                                        stderr=subprocess.PIPE, env=environment, start_new_session=True,
                                        preexec_fn=lambda: fcntl.ioctl(0, termios.TIOCSCTTY, 0))

    def set_size(self, columns, rows):
        fcntl.ioctl(self.slave, termios.TIOCSWINSZ, struct.pack("HHHH", rows, columns, 0, 0))

    def read(self, seconds=0.0):
        while select.select([self.master], [], [], seconds)[0]:
            data = os.read(self.master, 65536)
            while data.count(b"\x1b") and re.search(rb"\x1b[\[?\d;]*$", data):
                data += os.read(self.master, 1)
            self.screen.take(data.decode())

    def until(self, condition, what):
        end = time.monotonic() + LONGEST
        while not condition(self.screen):
            if time.monotonic() > end:
                raise AssertionError(f"never {what}:\n{self.screen.shown()}")
            self.read(0.05)

    def type(self, text):
        os.write(self.master, text.encode())

    def wait(self):
        end = time.monotonic() + LONGEST
        while self.process.poll() is None and time.monotonic() < end:
            self.read(0.05)
        self.read(0.2)
        return self.process.wait(timeout=1)

    def as_it_was(self):
        """The terminal after the program has ended."""
        return termios.tcgetattr(self.slave) == self.before and self.screen.cursor and not self.screen.alternate

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        self.process.stderr.close()
        os.close(self.master)
        os.close(self.slave)


class OnATerminal(unittest.TestCase):
    def monitor(self, *arguments, **options):
        monitor = Monitor(*arguments, **options)
        self.addCleanup(monitor.close)
        return monitor

    def at_the_end(self, **options):
        monitor = self.monitor(LOG, "--speed", "0", **options)
        monitor.until(lambda s: " end" in s.shown(), "at its end")
        monitor.read(0.3)
        self.assertFalse(monitor.screen.overrun, monitor.screen.shown())
        return monitor

    def test_it_shows_map_objects_alerts_and_links(self):
        monitor = self.at_the_end()
        shown = monitor.screen.shown()
        for part in ("A 1 red", "B 2 yellow", "STOP", "camera ok", "odometry ok", "q quit", "approach_stop.log"):
            self.assertIn(part, shown)
        self.assertRegex(shown, r"(?m)^.{0,50}A")
        self.assertRegex(shown, r"(?m)^.{0,50}B")
        self.assertGreater(monitor.screen.styles, 0)

    def test_q_ends_it(self):
        monitor = self.at_the_end()
        monitor.type("q")
        self.assertEqual(monitor.wait(), 0)
        self.assertTrue(monitor.as_it_was())

    def test_forty_columns(self):
        shown = self.at_the_end(columns=40).screen.shown()
        self.assertIn("STOP", shown)
        self.assertIn("A 1 red", shown)

    def test_a_terminal_that_says_65535_gets_a_thousand_columns(self):
        monitor = self.monitor(LOG, "--speed", "0", columns=65535, rows=65535)
        monitor.until(lambda s: "STOP" in s.text, "drawn")
        monitor.type("q")
        self.assertEqual(monitor.wait(), 0)
        self.assertIn("\x1b[500;1H", monitor.screen.text)
        self.assertNotIn("\x1b[501;1H", monitor.screen.text)

    def test_a_resize_is_followed(self):
        monitor = self.at_the_end()
        for columns, rows in ((40, 12), (132, 50), (20, 4), (80, 24)):
            monitor.read(0.3)
            monitor.screen.resize(columns, rows)
            monitor.set_size(columns, rows)
            os.kill(monitor.process.pid, signal.SIGWINCH)
            mark = len(monitor.screen.text)
            monitor.until(lambda s: "\x1b[2J" in s.text[mark:] and "STOP" in s.shown(), "drawn anew")
            monitor.read(0.2)
            self.assertFalse(monitor.screen.overrun, (columns, rows, monitor.screen.shown()))

    def test_no_color(self):
        monitor = self.at_the_end(NO_COLOR="1")
        self.assertEqual(monitor.screen.styles, 0)

    def test_it_rings_once_at_stop(self):
        self.assertEqual(self.at_the_end().screen.bells, 1)
        self.assertEqual(self.quiet().screen.bells, 0)

    def quiet(self):
        monitor = self.monitor(LOG, "--speed", "0", "--no-bell")
        monitor.until(lambda s: " end" in s.shown(), "at its end")
        monitor.read(0.3)
        return monitor

    def ended_by(self, number, code):
        monitor = self.monitor(LOG)
        monitor.until(lambda s: s.alternate and "red" in s.shown(), "begun")
        self.assertNotEqual(termios.tcgetattr(monitor.slave), monitor.before)
        os.kill(monitor.process.pid, number)
        self.assertEqual(monitor.wait(), code)
        self.assertTrue(monitor.as_it_was())

    def test_signals_leave_the_terminal_as_it_was(self):
        self.ended_by(signal.SIGTERM, 0)
        self.ended_by(signal.SIGINT, 130)

    def test_a_crash_leaves_the_terminal_as_it_was(self):
        self.ended_by(signal.SIGSEGV, -signal.SIGSEGV)
        self.ended_by(signal.SIGABRT, -signal.SIGABRT)

    def test_ctrl_c_is_typed(self):
        monitor = self.monitor(LOG)
        monitor.until(lambda s: s.alternate and "red" in s.shown(), "begun")
        monitor.type("\x03")
        self.assertEqual(monitor.wait(), 130)
        self.assertTrue(monitor.as_it_was())

    def test_a_log_plays_at_its_speed_and_pauses(self):
        monitor = self.monitor(LOG, "--speed", "4")
        monitor.until(lambda s: re.search(r"[1-9]\.\d s  x4", s.shown()), "under way")
        monitor.type(" ")
        monitor.until(lambda s: "paused" in s.shown(), "paused")
        first = re.search(r"([\d.]+) s  paused", monitor.screen.shown()).group(1)
        monitor.read(0.6)
        self.assertEqual(re.search(r"([\d.]+) s  paused", monitor.screen.shown()).group(1), first)
        monitor.type("+ ")
        monitor.until(lambda s: "x8" in s.shown() or " end" in s.shown(), "going on, faster")
        monitor.until(lambda s: " end" in s.shown(), "at its end")

    def test_a_robots_console(self):
        """A port is asked for mode log; what it says is shown, its control characters are not passed on."""
        robot, port = pty.openpty()
        self.addCleanup(os.close, robot)
        self.addCleanup(os.close, port)
        mode = termios.tcgetattr(port)
        mode[3] &= ~(termios.ECHO | termios.ICANON)
        termios.tcsetattr(port, termios.TCSANOW, mode)
        monitor = self.monitor(os.ttyname(port))
        asked = b""
        end = time.monotonic() + LONGEST
        while b"mode log\r" not in asked and time.monotonic() < end:
            if select.select([robot], [], [], 0.05)[0]:
                asked += os.read(robot, 100)
            monitor.read()
        self.assertIn(b"mode log\r", asked)
        os.write(robot, b"hello \x1b[31m robot\r\n")
        monitor.until(lambda s: "hello ?[31m robot" in s.shown(), "heard")


class Elsewhere(unittest.TestCase):
    def run_plain(self, *arguments, **options):
        return subprocess.run([FENCEPOST, "monitor", *map(str, arguments)], capture_output=True, text=True, timeout=LONGEST,
                              **options)

    def test_a_pipe_gets_plain_lines(self):
        done = self.run_plain(LOG, "--speed", "0")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertNotIn("\x1b", done.stdout)
        replayed = subprocess.run([FENCEPOST, "replay", LOG], capture_output=True, text=True).stdout.split("\n\n")[0]
        sentences = [re.sub(r"  \(object \d+\)$", "", line).split() for line in replayed.splitlines()]
        lines = [line.split() for line in done.stdout.splitlines()]
        self.assertEqual([line for line in lines if line[2] in ("STOP", "WARN", "NOTICE", "CLEAR")], sentences)

    def test_standard_input_is_a_port(self):
        own = subprocess.run([FENCEPOST, "replay", LOG, "--write-log", "/dev/stdout", "-o", "/dev/null"], capture_output=True)
        done = self.run_plain("-", input=own.stdout.decode())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("STOP", done.stdout)

    def test_a_dumb_terminal_gets_plain_lines(self):
        done = self.run_plain(LOG, "--speed", "0", env={**os.environ, "TERM": "dumb"})
        self.assertNotIn("\x1b", done.stdout)

    def test_what_is_wrong_is_said(self):
        for arguments, code, words in (
            (["/no/such.log"], 3, "no such"),
            (["/dev/no-such-port"], 4, "/dev/no-such-port"),
            (["tcp:nowhere"], 2, "tcp:HOST:PORT"),
            (["-", "--speed", "2"], 2, "LOG"),
        ):
            done = self.run_plain(*arguments, stdin=subprocess.DEVNULL)
            self.assertEqual((done.returncode, done.stdout), (code, ""), done.stderr)
            self.assertIn(words.lower(), done.stderr.lower())


if __name__ == "__main__":
    unittest.main()
