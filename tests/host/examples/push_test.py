"""The guide's program push.py on a stub of pyserial, by a clock of the test's.

usage: push_test.py push.py
"""
import binascii
import pathlib
import re
import sys
import types
import unittest
from contextlib import redirect_stdout
from io import StringIO

SCRIPT = pathlib.Path(sys.argv.pop(1)).read_text(encoding="utf-8")


def play(*words, answer=b"", refused=False):
    """(lines that it said to the port, what it printed, how it ended)"""
    clock = {"now": 100.0}
    said = []
    serial = types.ModuleType("serial")
    serial.SerialException = type("SerialException", (OSError,), {})

    class Serial:
        def __init__(self, port, baud, timeout):
            assert (port, baud, timeout) == (words[0], 115200, 0)
            if refused:
                raise serial.SerialException("could not open port 'COM5'")

        def write(self, data):
            said.append((clock["now"], data.decode()))

        def read(self, count):
            assert count > 0
            return answer

    serial.Serial = Serial
    time = types.ModuleType("time")
    time.monotonic = lambda: clock["now"]
    time.sleep = lambda seconds: clock.update(now=clock["now"] + seconds)
    before = {name: sys.modules.get(name) for name in ("serial", "time")}
    arguments, sys.argv = sys.argv, ["push.py", *words]
    sys.modules.update(serial=serial, time=time)
    printed = StringIO()
    end = None
    try:
        with redirect_stdout(printed):
            exec(compile(SCRIPT, "push.py", "exec"), {})
    except SystemExit as ended:
        end = str(ended)
    finally:
        sys.argv = arguments
        for name, module in before.items():
            sys.modules.pop(name) if module is None else sys.modules.update({name: module})
    return said, printed.getvalue(), end


def bodies(lines):
    for line in lines:
        body, sum_ = re.fullmatch(r"\$([^*]+)\*([0-9A-F]{4})\n", line).groups()
        assert int(sum_, 16) == binascii.crc_hqx(body.encode(), 0xFFFF), line
        yield body


class Push(unittest.TestCase):
    def test_says_camera_colour_and_places(self):
        said, printed, end = play("COM5", "pixy2.1", "0.2", answer=b"NOTICE  red\r\n")
        self.assertIsNone(end)
        camera, colour, *places = bodies(text for _, text in said)
        self.assertEqual(camera.split(",")[:6], ["FPCAM", "pixy2.1", "316", "208", "188.30", "188.30"])
        self.assertEqual(camera.split(",")[11], "0.2000")
        self.assertEqual(colour, "FPSIG,1,d02020,red")
        self.assertGreater(len(places), 200)
        times = [t for t, text in said if "FPODO" in text]
        self.assertLess(max(b - a for a, b in zip(times, times[1:])), 0.1)
        for t, place in zip(times, places):  # still for 3 s, then 0.1 m/s as far as 0.6 m
            kind, stamp, x, y, heading = place.split(",")
            self.assertEqual((kind, stamp, y, heading), ("FPODO", "", "0.0000", "0.0000"))
            self.assertAlmostEqual(float(x), min(max(0.1 * (t - 103), 0), 0.6), places=3)
        self.assertIn("Push in 3 s.\nNOTICE  red\n", printed)

    def test_a_robot_whose_wheels_count_is_told_the_camera_alone(self):
        said, printed, _ = play("COM5", "pixy2", "0.1", "--stay")
        self.assertEqual([body.split(",")[0] for body in bodies(text for _, text in said)], ["FPCAM", "FPSIG"])
        self.assertIn("Sent.", printed)

    def test_lines_are_printed_without_pyserial(self):
        said, printed, end = play("--lines")
        self.assertEqual((said, end), ([], None))
        kinds = [body.split(",")[0] for body in bodies(printed.splitlines(keepends=True))]
        self.assertEqual(kinds[:2], ["FPCAM", "FPSIG"])
        self.assertEqual(set(kinds[2:]), {"FPODO"})

    def test_bad_words_are_answered(self):
        self.assertIn("usage: python push.py PORT", play()[2])
        self.assertIn("usage: python push.py PORT", play("COM5", "pixy3")[2])
        self.assertIn("'high' is no height", play("COM5", "pixy2", "high")[2])
        self.assertIn("Close its console first", play("COM5", refused=True)[2])


unittest.main()
