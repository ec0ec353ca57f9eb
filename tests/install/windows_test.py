#!/usr/bin/env python3
"""usage: windows_test.py LINUX_PROGRAM SOURCE_FOLDER [ZIP]

The program for Windows, run by wine. It writes the same bytes as Linux's program, takes names of files in UTF-8, and records from
serial ports, which are pseudo-terminals here. `toolchain/package windows` makes it where no ZIP is given. Exit status 77: nothing was run.
"""

import gzip
import os
import pathlib
import pty
import shutil
import subprocess
import sys
import tempfile
import time
import tty
import unittest
import zipfile

LINUX, SOURCE = (pathlib.Path(word).resolve() for word in sys.argv[1:3])
RECORDINGS = SOURCE / "host/share/recordings"
LOGS = sorted(RECORDINGS.glob("*.log"))
LONGEST = 300  # s, on a busy machine; wine alone takes a second to start
NAME = "größe – 図.log"


class Windows(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.held = tempfile.TemporaryDirectory(prefix="fencepost-windows-", ignore_cleanup_errors=True)
        cls.root = pathlib.Path(cls.held.name)
        cls.environment = {**os.environ, "WINEPREFIX": str(cls.root / "wine"), "WINEDEBUG": "-all", "LANG": "C.UTF-8",
                           "WINEDLLOVERRIDES": "mscoree,mshtml="}
        cls.environment.pop("FENCEPOST_SHARE", None)
        archive = sys.argv[3] if len(sys.argv) > 3 else cls.packed()
        with zipfile.ZipFile(archive) as packed:
            packed.extractall(cls.root)
        cls.program = next(cls.root.glob("fencepost-*/fencepost.exe"))
        cls.wine("--version")  # makes its folder

    @classmethod
    def tearDownClass(cls):
        subprocess.run(["wineserver", "-k"], env=cls.environment, check=False)
        cls.held.cleanup()

    @classmethod
    def packed(cls):
        done = subprocess.run(["toolchain/package", "windows", str(cls.root / "packed")], cwd=SOURCE, capture_output=True, text=True, check=True)
        return done.stdout.strip().splitlines()[-1]

    @classmethod
    def start(cls, *arguments, **options):
        return subprocess.Popen(["wine", str(cls.program), *map(str, arguments)], cwd=cls.root, env=cls.environment,
                                stdin=options.pop("stdin", subprocess.DEVNULL), stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)

    @classmethod
    def wine(cls, *arguments, given=None):
        """Exit code, output, words."""
        process = cls.start(*arguments, stdin=subprocess.DEVNULL if given is None else subprocess.PIPE)
        out, err = process.communicate(given, timeout=LONGEST)
        return process.returncode, out, err.decode("utf-8", "replace")

    def linux(self, *arguments, given=b""):
        done = subprocess.run([LINUX, *map(str, arguments)], cwd=self.root, input=given, capture_output=True, timeout=LONGEST, check=False)
        return done.returncode, done.stdout, done.stderr.decode("utf-8", "replace")

    def expect_the_same(self, *arguments):
        here, there = self.linux(*arguments), self.wine(*arguments)
        self.assertEqual(there[0], here[0], (arguments, there[2][-500:]))
        self.assertGreater(len(here[1]), 100, arguments)
        self.assertEqual(there[1], here[1], arguments)

    def test_holds_no_time_of_its_making(self):
        program = self.program.read_bytes()
        header = int.from_bytes(program[0x3C:0x40], "little")  # PE format, MS-DOS stub
        self.assertEqual(program[header:header + 4], b"PE\0\0")
        self.assertEqual(program[header + 8:header + 12], bytes(4), "TimeDateStamp")

    def test_replays_each_recording_to_the_same_bytes(self):
        self.assertGreater(len(LOGS), 8)
        for log in LOGS:
            self.expect_the_same("replay", log, "--json")
        self.expect_the_same("replay", LOGS[0])
        self.expect_the_same("replay", LOGS[0], "--check")

    def test_judges_draws_and_exports_to_the_same_bytes(self):
        log, scene = RECORDINGS / "wro_lap.log", RECORDINGS / "wro_lap.json"
        self.expect_the_same("evaluate", log, scene, "--json")
        self.expect_the_same("doctor", log)
        self.expect_the_same("report", log, "--scene", scene, "--static", "-o", "-")
        for kind in ("svg", "csv", "geojson", "glb"):
            self.expect_the_same("export", log, "--format", kind, "-o", "-")

    def test_simulates_each_scene_to_the_same_bytes(self):
        for scene in sorted(RECORDINGS.glob("*.json")):
            self.expect_the_same("simulate", scene, "-o", "-")

    def test_mcap_is_not_packed_and_says_the_same(self):
        self.assertEqual(self.wine("export", RECORDINGS / "stop_pixy2.log", "--format", "mcap", "-o", "there.mcap")[0], 0)
        self.assertEqual(self.linux("export", RECORDINGS / "stop_pixy2.log", "--format", "mcap", "-o", "here.mcap")[0], 0)
        for file in ("here", "there"):
            done = self.linux("import", "mcap", f"{file}.mcap", "--camera", RECORDINGS / "stop_pixy2.log", "-o", f"{file}.log")
            self.assertEqual(done[0], 0, done[2])
        self.assertEqual((self.root / "there.log").read_bytes(), (self.root / "here.log").read_bytes())
        code, _, words = self.wine("import", "mcap", "here.mcap", "--camera", RECORDINGS / "stop_pixy2.log", "-o", "x.log")
        self.assertEqual(code, 3)
        self.assertIn("mcap compress --compression none", words)

    def test_names_are_utf8_and_inputs_are_kept(self):
        log = self.root / NAME
        log.write_bytes(gzip.compress((RECORDINGS / "approach_stop.log").read_bytes()))
        before = log.read_bytes()
        self.expect_the_same("replay", NAME, "--json")
        code, _, words = self.wine("export", NAME, "--format", "csv", "-o", NAME)
        self.assertEqual(code, 2, words)
        self.assertIn("is also the input", words)
        self.assertEqual(log.read_bytes(), before)
        for _ in range(2):  # the second time it is there
            self.assertEqual(self.wine("export", NAME, "--format", "csv", "-o", "größe.csv")[0], 0)
        self.assertEqual((self.root / "größe.csv").read_bytes(), self.linux("export", NAME, "--format", "csv", "-o", "-")[1])
        code, _, words = self.wine("replay", "ist nicht da – 図.log")
        self.assertEqual(code, 3)
        self.assertIn("cannot read ist nicht da – 図.log: No such file or directory", words)
        self.assertEqual([file.name for file in self.root.iterdir() if file.name.startswith(".fencepost")], [])

    def test_reads_standard_input_and_shows_the_bundled_demo(self):
        log = RECORDINGS / "approach_stop.log"
        code, out, words = self.wine("replay", "-", "--json", given=log.read_bytes())
        self.assertEqual((code, out), self.linux("replay", "-", "--json", given=log.read_bytes())[:2], words)
        code, out, words = self.wine("demo", "-o", "demo.html")
        self.assertEqual(code, 0, words)
        self.assertIn(b"STOP    red", out)

    def test_says_what_it_has_not(self):
        for arguments, said in ((("run",), "in WSL"), (("smooth", "x"), "in WSL"), (("rnu",), 'no command "rnu"'), (("doctor", "COM3"), "Device Manager"), (("record", "COM77"), "Device Manager"),
                                (("record", "tcp:localhost:4000"), "is not in the program for Windows")):
            code, _, words = self.wine(*arguments)
            self.assertIn(code, (2, 4), arguments)
            self.assertIn(said, words)

    def port(self, number):
        """A serial port of wine's, and the pseudo-terminal's other end."""
        master, slave = pty.openpty()
        tty.setraw(slave)
        link = self.root / f"wine/dosdevices/com{number}"
        link.unlink(missing_ok=True)
        link.symlink_to(os.ttyname(slave))
        self.addCleanup(link.unlink)
        self.addCleanup(os.close, master)
        return master, slave

    def test_records_a_console_from_a_serial_port(self):
        master, slave = self.port(21)
        lines = (RECORDINGS / "stop_pixy2.log").read_bytes()[:20_000].rpartition(b"\n")[0] + b"\n"
        process = self.start("record", "COM21", "-o", "recorded.log", "--seconds", "12", "-q")
        asked = b""
        os.set_blocking(master, False)
        end = time.monotonic() + LONGEST
        while b"mode log\r" not in asked:
            self.assertLess(time.monotonic(), end, "it never asked for mode log")
            self.assertIsNone(process.poll(), "it has ended")
            try:
                asked += os.read(master, 100)
            except BlockingIOError:
                time.sleep(0.05)
        os.close(slave)
        os.set_blocking(master, True)
        for at in range(0, len(lines), 500):
            os.write(master, lines[at : at + 500])
            time.sleep(0.02)
        _, err = process.communicate(timeout=LONGEST)
        self.assertEqual(process.returncode, 0, err)
        self.assertEqual((self.root / "recorded.log").read_bytes(), lines)


if __name__ == "__main__":
    missing = [tool for tool in ("x86_64-w64-mingw32-g++-posix", "wine", "wineserver") if shutil.which(tool) is None]
    if missing:
        print(f"SKIPPED: THE PROGRAM FOR WINDOWS WAS NOT RUN: {', '.join(missing)} missing; toolchain/setup windows installs it", file=sys.stderr)
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
