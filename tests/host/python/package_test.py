"""usage: package_test.py PYTHON_MD, by a Python in which the wheel is installed and nothing else.

The package as its users have it.
"""
import inspect
import io
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import typing
import unittest
import xml.etree.ElementTree

import fencepost

PAGE = pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")
SNIPPETS = re.findall(r"```python\n(.*?)```", PAGE, re.DOTALL)


def printed(code, **names):
    said = io.StringIO()
    exec(code, {"fencepost": fencepost, "print": lambda *values: print(*values, file=said), **names})
    return said.getvalue()


class Robot:
    """It drives at 0.25 m/s while it may; a box stands 1.5 m ahead, 10 cm wide and 15 cm high. By the pinhole."""

    def __init__(self, camera, seconds=8):
        self.camera, self.seconds, self.x = camera, seconds, 0.0

    def __call__(self):
        for turn in range(int(50 * self.seconds)):
            depth = 1.5 - self.x
            top = self.camera.cy + self.camera.fy * (self.camera.z - 0.15) / depth
            foot = min(self.camera.height - 1, self.camera.cy + self.camera.fy * self.camera.z / depth)
            box = (self.camera.cx, (top + foot) / 2, self.camera.fx * 0.1 / depth, foot - top + 1)
            yield turn / 50, self.x, 0.0, 0.0, [box]

    def motors(self, run):
        self.x += 0.005 if run else 0


class Installed(unittest.TestCase):
    def test_is_the_wheel(self):
        self.assertIn(sysconfig.get_paths()["platlib"], fencepost.__file__)
        self.assertTrue(pathlib.Path(fencepost.__file__).with_name("py.typed").is_file())

    def test_program_is_installed(self):
        script = pathlib.Path(sys.executable).with_name("fencepost")
        said = subprocess.run([script, "-V"], capture_output=True, text=True, check=True).stdout
        self.assertEqual(said, f"fencepost {fencepost.version()}\n")
        with tempfile.TemporaryDirectory() as folder:
            said = subprocess.run([script, "demo", "-o", "demo.html"], capture_output=True, text=True, check=True, cwd=folder, env={})
            self.assertIn("STOP    red", said.stdout)
            self.assertGreater(pathlib.Path(folder, "demo.html").stat().st_size, 100_000)
        refused = subprocess.run([sys.executable, "-m", "fencepost", "reply"], capture_output=True, text=True, check=False)
        self.assertEqual(refused.returncode, 2)

    def test_what_is_public_is_described_and_typed(self):
        self.assertEqual(fencepost.__all__, sorted(fencepost.__all__))
        for name in fencepost.__all__:
            public = getattr(fencepost, name)
            self.assertTrue(inspect.getdoc(public), name)
        for of in (fencepost.Core, fencepost.Run, fencepost.Camera, fencepost.Box, fencepost.Log, fencepost.Reader):
            for name, member in vars(of).items():
                if name.startswith("_") or name in getattr(of, "_fields", ()):
                    continue
                function = getattr(member, "fget", None) or getattr(member, "func", None) or getattr(member, "__func__", member)
                if inspect.isfunction(function):
                    self.assertTrue(inspect.getdoc(function), f"{of.__name__}.{name}")
                    self.assertIn("return", typing.get_type_hints(function), f"{of.__name__}.{name}")
        for function in (fencepost.crc, fencepost.evaluate, fencepost.read, fencepost.recording, fencepost.recordings,
                         fencepost.records, fencepost.replay, fencepost.result, fencepost.simulate, fencepost.version):
            parameters = set(inspect.signature(function).parameters)
            self.assertEqual(set(typing.get_type_hints(function)), parameters | {"return"})


class Replay(unittest.TestCase):
    def test_first_three_lines_print_something_on_every_recording(self):
        lines = SNIPPETS[0].strip().splitlines()
        self.assertEqual(len(lines), 3)
        self.assertGreater(len(fencepost.recordings()), 5)
        for name in fencepost.recordings():
            said = printed(SNIPPETS[0].replace('"run.log"', repr(str(fencepost.recording(name)))))
            alerts, objects = re.match(r"(\d+) alerts, (\d+) objects, digest [0-9a-f]{16}\n", said).groups()
            self.assertGreater(min(int(alerts), int(objects)), 0, name)
            self.assertEqual(len(said.splitlines()), 1 + int(alerts) + int(objects))

    def test_objects_alerts_and_arrays(self):
        run = fencepost.replay(fencepost.recording("stop_pixy2.log"))
        (thing,) = run.objects
        self.assertEqual((thing.name, thing.state), ("red", "confirmed"))
        self.assertLess(math.hypot(thing.x - 1.86, thing.y), 0.05)  # the box's middle: stop_pixy2.json
        self.assertGreater(len(thing.outline), 3)
        self.assertLess(max(math.hypot(x - thing.x, y - thing.y) for x, y in thing.outline), 0.2)
        self.assertEqual((run.alerts[-1].level, run.alerts[-1].signature), ("stop", 1))
        self.assertEqual(run.path.shape, (len(run.document["path"]), 4))
        self.assertEqual(run.path.tolist()[-1], run.document["path"][-1])
        self.assertEqual(len(run.sectors), 36)
        self.assertEqual(run.speed_limit, 0)
        self.assertEqual((len(run.ways), run.ways[4].end, run.ways[8].end), (9, "thing", "unknown"))
        grid = run.grid(0.05)
        row, column = int((thing.y - grid.y) / 0.05), int((thing.x - grid.x) / 0.05)
        cells = grid.cells.tolist()
        self.assertEqual(grid.cells.shape, (len(cells), len(cells[0])))
        self.assertEqual(cells[row][column], 100)
        self.assertEqual({cell for line in cells for cell in line}, {-1, 0, 100})
        self.assertEqual(cells[row][int((0.5 - grid.x) / 0.05)], 0, "the floor that it came over")

    def test_notebook_shows_a_picture(self):
        run = fencepost.replay(fencepost.recording("go_around.log"))
        root = xml.etree.ElementTree.fromstring(run._repr_svg_())
        self.assertTrue(root.tag.endswith("svg"))
        self.assertIn("3 green", run._repr_svg_())

    def test_bytes_and_options(self):
        path = fencepost.recording("corridor.log")
        whole, small = fencepost.replay(path), fencepost.replay(path.read_bytes(), profile="small")
        self.assertEqual(fencepost.replay(path.read_bytes()).digest, whole.digest)
        self.assertEqual(small.document["profile"], "small")
        self.assertNotEqual(small.digest, whole.digest)
        self.assertIn("<svg", fencepost.replay(path.read_bytes()).svg())
        with tempfile.TemporaryDirectory() as folder:
            odd = pathlib.Path(folder, "-o")
            shutil.copy(path, odd)
            self.assertEqual(fencepost.replay(odd).digest, whole.digest)

    def test_what_cannot_be_read_is_said(self):
        for log, says in (("no_such.log", "cannot read .*no_such.log"), (b"hello\n", "no record in 1 line")):
            with self.assertRaisesRegex(fencepost.ProgramError, says):
                fencepost.replay(log)
        with self.assertRaisesRegex(FileNotFoundError, "no bundled recording is called nothing.log; there are approach_stop.log"):
            fencepost.recording("nothing.log")

    def test_simulate_and_evaluate(self):
        said = printed(SNIPPETS[1], json=json)
        self.assertGreater(int(said), 0)
        with tempfile.TemporaryDirectory() as folder:
            scene, log = fencepost.recording("corridor.json"), pathlib.Path(folder, "corridor.log")
            self.assertEqual(fencepost.simulate(scene, log), log.read_bytes())
            self.assertEqual(fencepost.read(log).records, fencepost.read(fencepost.recording("corridor.log")).records)
            measures = fencepost.evaluate(log, scene)
            self.assertEqual(measures["summary"]["logs"], 1)
            self.assertEqual(fencepost.evaluate(fencepost.recording("corridor.log"))["summary"], measures["summary"])
            with self.assertRaisesRegex(fencepost.ProgramError, "corridor.json"):
                fencepost.evaluate(log)
        with self.assertRaisesRegex(fencepost.ProgramError, "\"format\" is missing"):
            fencepost.simulate({"camera": 1})


class Loop(unittest.TestCase):
    def test_snippet_stops_before_the_box(self):
        robot = Robot(fencepost.Camera.pinhole(640, 480, 62, z=0.12))
        names = {"fencepost": fencepost, "robot": robot, "motors": robot.motors}
        said = printed(SNIPPETS[2], **names).splitlines()
        self.assertEqual(list(dict.fromkeys(line.split()[0] for line in said)), ["NOTICE", "WARN", "STOP"])
        self.assertRegex(said[-1], r"^STOP    red  0\.[23]\d m")
        self.assertTrue(1.15 < robot.x < 1.35, robot.x)

    def test_its_log_replays_to_its_digest(self):
        for size in ("micro", "small", "full"):
            camera = fencepost.Camera.delivered("pixy2", z=0.12, latency=0)
            log = io.BytesIO()
            core = fencepost.Core(camera, size=size, log=log)
            robot, heard, limit = Robot(camera), [], core.speed_limit
            for t, x, y, heading, boxes in robot():
                heard += core.odometry(t, x, y, heading)
                heard += core.boxes(t, [fencepost.Box.centred(1, *box) for box in boxes])
                heard += core.step(t)
                robot.motors(core.may_drive(t))
            self.assertEqual(core.level, "stop")
            self.assertEqual(heard[-1].level, "stop")
            (thing,) = core.objects
            self.assertTrue(thing.confirmed)
            self.assertLess(abs(thing.x - thing.radius - 1.5), 0.1)
            self.assertAlmostEqual(core.pose[0], robot.x, delta=0.01)
            self.assertEqual((core.speed_limit, limit), (0, None))
            self.assertEqual(len(core.sectors), 0 if size == "micro" else 36)
            ways = core.ways(right=[1])
            self.assertEqual([way.motion for way in ways], [] if size == "micro" else ["spin", *["forward"] * 7, "back"])
            self.assertTrue(size == "micro" or ways[4].end == "thing")
            run = fencepost.replay(log.getvalue())
            self.assertEqual(run.document["profile"], size)
            self.assertEqual(run.digest, core.digest)
            self.assertEqual([(a.t, a.level, a.id) for a in run.alerts], [(round(a.t, 4), a.level, a.id) for a in heard])
            core.restart()
            self.assertEqual((core.objects, core.outline(thing.id)), ([], []))

    def test_its_colours_are_in_its_log(self):
        log = io.BytesIO()
        core = fencepost.Core(fencepost.Camera.delivered("pixy2", z=0.12), log=log)
        core.colour(3, "ball", rgb="d02021", size=0.05, pad=-4)
        core.step(0)
        core.name(3, "cone")
        core.step(0.1)
        names = [line.split(b"*")[0] for line in log.getvalue().splitlines() if line.startswith(b"$FPSIG")]
        self.assertEqual(list(dict.fromkeys(names)), [b"$FPSIG,3,d02021,%s,0.050,-4" % name for name in (b"ball", b"cone")])
        for says, attempt in (("'red' is not six hex digits", lambda: core.colour(1, rgb="red")),
                              ("a signature is 0 to 255", lambda: core.colour(256)),
                              ("a pad -100 to 100", lambda: core.colour(1, pad=101)),
                              ("size 2.1 m: a number is out of range", lambda: core.colour(1, size=2.1))):
            with self.assertRaisesRegex(fencepost.Refused, says):
                attempt()

    def test_a_name_that_is_cut_loses_no_alert(self):
        camera = fencepost.Camera.delivered("pixy2", z=0.12, latency=0)
        core = fencepost.Core(camera)
        core.name(1, "r" + 30 * "\N{LATIN SMALL LETTER U WITH DIAERESIS}")  # of 61 bytes the first 32
        robot, heard = Robot(camera, seconds=3), []
        for t, x, y, heading, boxes in robot():
            heard += core.odometry(t, x, y, heading) + core.boxes(t, [fencepost.Box.centred(1, *box) for box in boxes])
            heard += core.step(t)
            robot.motors(core.may_drive(t))
        self.assertTrue(heard)
        self.assertIn("r\N{LATIN SMALL LETTER U WITH DIAERESIS}", heard[0].sentence)

    def test_what_cannot_be_is_refused_in_words(self):
        core = fencepost.Core()
        with self.assertRaisesRegex(fencepost.Refused, "boxes at 0 s: boxes came before a camera was set"):
            core.boxes(0, [(1, 10, 10, 20, 20)])
        core.set_camera(fencepost.Camera.pinhole(320, 240, 60, pitch=None))
        core.odometry(1, 0, 0, 0)
        for says, attempt in (
                ("odometry at 1 s, .*: the time is not later", lambda: core.odometry(1, 0, 0, 0)),
                ("out of range", lambda: core.odometry(2, 2000, 0, 0)),
                ("out of range", lambda: core.odometry(2, math.nan, 0, 0)),
                ("nan s is no time", lambda: core.odometry(math.nan, 0, 0, 0)),
                ("robot.widht = 0.2: there is no setting", lambda: core.set("robot.widht", 0.2)),
                ("robot.width = wide: a number is out of range", lambda: core.set("robot.width", "wide")),
                ("is no box", lambda: core.boxes(2, [(1, 2, 3)])),
                ("is no box", lambda: core.boxes(2, [(1, 2, 3, 70000, 9)])),
                ("out of range", lambda: core.boxes(2, [(1, 20, 10, 10, 20)])),
                ("a size is", lambda: core.set_camera(fencepost.Camera(70000, 2, 1, 1, 0, 0)))):
            with self.assertRaisesRegex(fencepost.Refused, says):
                attempt()
        core.boxes(2, [(1, 10, 10, 20, 20)])
        for says, attempt in (("no camera is called 'pixy9'", lambda: fencepost.Camera.delivered("pixy9")),
                              ("it is 1 to 170", lambda: fencepost.Camera.pinhole(640, 480, 0)),
                              ("'huge' is no size", lambda: fencepost.Core(size="huge"))):
            with self.assertRaisesRegex(ValueError, says):
                attempt()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
