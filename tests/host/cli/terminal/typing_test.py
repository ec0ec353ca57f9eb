"""`fencepost run` at a terminal: what is typed survives alerts, STOP is seen and heard, the terminal is given back.

usage: typing_test.py FENCEPOST RECORDINGS
"""
import os
import pathlib
import pty
import re
import select
import signal
import subprocess
import sys
import tempfile
import termios
import time
import unittest

RECORDINGS, FENCEPOST = (pathlib.Path(sys.argv.pop()).resolve() for _ in range(2))
SCENE = RECORDINGS / "stop_pixy2.json"
LONGEST = 90  # s; the scene lasts ten, a busy machine is slow


class Terminal:
    """Lines as a terminal shows them; the last one is where the cursor is."""

    def __init__(self, *arguments, folder, **environment):
        self.master, self.slave = pty.openpty()
        self.before = termios.tcgetattr(self.slave)
        self.lines = [""]
        self.bells = 0
        self.raw = ""
        environment = {**os.environ, "TERM": "xterm", "NO_COLOR": "", **environment}
        self.process = subprocess.Popen([FENCEPOST, *map(str, arguments)], stdin=self.slave, stdout=self.slave,
                                        stderr=self.slave, env=environment, cwd=folder, start_new_session=True,
                                        preexec_fn=self.take)

    @staticmethod
    def take():
        import fcntl
        fcntl.ioctl(0, termios.TIOCSCTTY, 0)

    def read(self, seconds=0.0):
        while select.select([self.master], [], [], seconds)[0]:
            seconds = 0.0
            text = os.read(self.master, 65536).decode()
            self.raw += text
            for erase, _, end, back, plain in re.findall(r"(\r\x1b\[K)|(\x1b\[[\d;]*m)|(\r?\n)|(\r)|([^\r\n\x1b]+)", text):
                self.bells += plain.count("\a")
                if erase:
                    self.lines[-1] = ""
                elif end:
                    self.lines.append("")
                elif back:
                    raise AssertionError("a carriage return alone would be overwritten")
                else:
                    self.lines[-1] += plain.replace("\a", "")

    def until(self, condition, what):
        end = time.monotonic() + LONGEST
        while not condition():
            if time.monotonic() > end or self.process.poll() is not None:
                raise AssertionError(f"never {what}:\n" + "\n".join(self.lines))
            self.read(0.05)

    def type(self, text):
        os.write(self.master, text.encode())

    def said(self, word):
        return [line for line in self.lines[:-1] if line.startswith(word)]

    def wait(self):
        end = time.monotonic() + LONGEST
        while self.process.poll() is None and time.monotonic() < end:
            self.read(0.05)
        self.read(0.2)
        return self.process.wait(timeout=1)

    def close(self):
        if self.process.poll() is None:
            self.process.kill()
            self.process.wait()
        os.close(self.master)
        os.close(self.slave)


class Typing(unittest.TestCase):
    def run_at_terminal(self, **environment):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        robot = subprocess.Popen([FENCEPOST, "emulate", "pixy2", "create2", SCENE, "--link", "camera", "--link", "wheels"],
                                 cwd=folder.name, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(robot.wait)
        self.addCleanup(robot.terminate)
        end = time.monotonic() + LONGEST
        while not (pathlib.Path(folder.name) / "wheels").exists() and time.monotonic() < end:
            time.sleep(0.05)
        terminal = Terminal("run", "--camera", "pixy2:./camera", "--odometry", "create2:./wheels", "--robot", SCENE,
                            folder=folder.name, **environment)
        self.addCleanup(terminal.close)
        return terminal

    def test_a_drive_with_somebody_at_the_keyboard(self):
        terminal = self.run_at_terminal()
        terminal.until(lambda: terminal.said("odometry create2"), "begun")
        self.assertNotEqual(termios.tcgetattr(terminal.slave), terminal.before)
        terminal.type("objx\x7fe")
        terminal.until(lambda: terminal.lines[-1] == "obje", "what was typed")
        seen = len(terminal.said("NOTICE"))
        terminal.until(lambda: len(terminal.said("NOTICE")) > seen, "an alert")
        terminal.read(0.1)
        self.assertEqual(terminal.lines[-1], "obje")
        terminal.type("cts\r")
        terminal.until(lambda: any("state" in line and "dist" in line for line in terminal.lines), "its answer")
        self.assertIn("objects", terminal.lines)
        self.assertFalse([line for line in terminal.lines if "error" in line])

        terminal.until(lambda: terminal.said("STOP"), "a stop")
        terminal.read(0.2)
        self.assertRegex(terminal.raw, r"\x1b\[1;31mSTOP [^\x1b]*\x1b\[0m")
        self.assertGreaterEqual(terminal.bells, 1)
        terminal.type("quit\r")
        self.assertEqual(terminal.wait(), 0)
        self.assertEqual(termios.tcgetattr(terminal.slave), terminal.before)

    def test_no_color_and_an_interrupt(self):
        terminal = self.run_at_terminal(NO_COLOR="1")
        terminal.until(lambda: terminal.said("STOP"), "a stop")
        self.assertNotIn("\x1b[1;31m", terminal.raw)
        terminal.type("half")
        terminal.until(lambda: terminal.lines[-1] == "half", "what was typed")
        terminal.type("\x03")
        self.assertEqual(terminal.wait(), 130)
        self.assertEqual(termios.tcgetattr(terminal.slave), terminal.before)

    def test_a_pipe_has_neither_colour_nor_bell(self):
        log = (RECORDINGS / "approach_stop.log").read_bytes()
        done = subprocess.run([FENCEPOST, "run", "--camera", "console", "--odometry", "console", "--mode", "text"], input=log,
                              capture_output=True, timeout=LONGEST)
        self.assertIn(b"STOP", done.stdout)
        self.assertNotIn(b"\x1b", done.stdout)
        self.assertNotIn(b"\a", done.stdout)


if __name__ == "__main__":
    unittest.main()
