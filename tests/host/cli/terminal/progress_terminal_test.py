"""Long work at a terminal shows one line of progress and takes it away; into a pipe or a file it says nothing.

usage: progress_terminal_test.py FENCEPOST RECORDINGS
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
import time
import unittest

RECORDINGS, FENCEPOST = (pathlib.Path(sys.argv.pop()).resolve() for _ in range(2))
LONGEST = 120  # s


class Progress(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        run = (RECORDINGS / "corridor.log").read_bytes()
        # Runs one after another, as many as take some seconds. Of one alone most is the start of the program.
        few = 100
        with tempfile.NamedTemporaryFile(suffix=".log") as log:
            log.write(run * few)
            log.flush()
            begin = time.monotonic()
            subprocess.run([FENCEPOST, "replay", log.name], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
            one = (time.monotonic() - begin) / few
        cls.runs = run * min(4000, max(few, int(2.5 / one)))

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.log = self.folder / "long.log"
        self.log.write_bytes(self.runs)

    def at_terminal(self, *arguments, until=None, **environment):
        """Exit status and all that the terminal got; `until`: interrupted where that is shown."""
        master, slave = pty.openpty()
        environment = {**os.environ, "TERM": "xterm", **environment}
        process = subprocess.Popen([FENCEPOST, *map(str, arguments)], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=slave, env=environment, cwd=self.folder)
        os.close(slave)
        shown = b""
        end = time.monotonic() + LONGEST
        while time.monotonic() < end:
            try:
                if select.select([master], [], [], 0.1)[0]:
                    part = os.read(master, 65536)
                    shown += part
                    if not part:
                        break
            except OSError:  # the other end is closed
                break
            if until and until in shown:
                process.send_signal(signal.SIGINT)
                until = None
        out = process.communicate(timeout=LONGEST)[0]
        os.close(master)
        return process.returncode, shown.decode(), out

    def test_one_line_that_is_taken_away(self):
        code, shown, out = self.at_terminal("replay", self.log)
        self.assertEqual(code, 0)
        lines = re.findall(r"\r\x1b\[K([^\r\n]*)", shown.split("this is run")[0])
        self.assertGreater(len(lines), 5, shown)
        self.assertTrue(all(re.fullmatch(r"replaying: \d+ %(, \d+ s left)?|", line) for line in lines), lines)
        shares = [int(re.search(r"(\d+) %", line)[1]) for line in lines if line]
        self.assertEqual(shares, sorted(shares))
        self.assertIn("left", "".join(lines))
        self.assertIn("\r\x1b[Kthis is run", shown.replace("\r\n", "\n"), "a message begins a line of its own")
        self.assertNotIn("\x1b", shown.split("this is run")[1])
        self.assertNotIn(b"\x1b", out)

    def test_a_dumb_terminal_and_no_terminal_stay_clean(self):
        self.assertNotIn("replaying", self.at_terminal("replay", self.log, TERM="dumb")[1])
        done = subprocess.run([FENCEPOST, "replay", self.log], capture_output=True, timeout=LONGEST, check=True)
        self.assertNotIn(b"replaying", done.stderr)
        self.assertNotIn(b"\r\x1b", done.stderr)

    def test_short_work_says_nothing(self):
        self.assertEqual(self.at_terminal("replay", RECORDINGS / "selftest.log")[1], "")

    def test_many_logs_are_counted(self):
        (self.folder / "a.log").write_bytes(self.log.read_bytes())
        (self.folder / "b.log").write_bytes((RECORDINGS / "corridor.log").read_bytes())
        scene = RECORDINGS / "corridor.json"
        code, shown, _ = self.at_terminal("evaluate", "a.log", "--scene", scene, "b.log", "--scene", scene)
        self.assertEqual(code, 0, shown)
        self.assertRegex(shown, r"\r\x1b\[Kevaluating: [01] of 2 logs, \d+ %")

    def test_an_interrupt_takes_it_away(self):
        code, shown, _ = self.at_terminal("replay", self.log, until=b"replaying")
        self.assertEqual(code, 130)
        self.assertTrue(shown.endswith("\r\x1b[K"), repr(shown[-40:]))


if __name__ == "__main__":
    unittest.main()
