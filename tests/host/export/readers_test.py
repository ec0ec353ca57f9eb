"""Reads what `fencepost export` writes by programs of others, and compares it with the result document.

usage: readers_test.py [--damage] FENCEPOST NODE FOLDER_WITH_READERS RECORDINGS
--damage: one value of each file is changed before it is read; then each of these tests fails.
"""
import binascii
import csv
import io
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import PIL.Image
import yaml

RECORDINGS, READERS, NODE, FENCEPOST = (pathlib.Path(sys.argv.pop()).resolve() for _ in range(4))
DAMAGE = "--damage" in sys.argv
if DAMAGE:
    sys.argv.remove("--damage")
LOG = RECORDINGS / "approach_stop.log"
FOLDER = tempfile.TemporaryDirectory()

# By file name: the damage, which replaces some of its bytes by others of the same length.
DAMAGES = {
    "run.mcap": lambda b: b[:3000] + bytes([b[3000] ^ 1]) + b[3001:],
    "run.ros2.mcap": lambda b: b[:3000] + bytes([b[3000] ^ 1]) + b[3001:],
    "run.glb": lambda b: b.replace(b'"VEC3"', b'"VEC2"', 1),
    "run.geojson": lambda b: b.replace(b'"LineString"', b'"LineSting" ', 1),
    "earth.geojson": lambda b: b.replace(b"52.5", b"25.5", 3),
    "map.yaml": lambda b: b.replace(b"free_thresh: 0.196", b"free_thresh: 0.250"),
    "run.csv": lambda b: b.replace(b"robot/x,", b"robot/y,", 1),
    "run.svg": lambda b: b.replace(b"</title>", b"</titel>", 1),
    "run.png": lambda b: b[:2000] + bytes([b[2000] ^ 1]) + b[2001:],
    "monitor.yaml": lambda b: b.replace(b"[0.250", b"[0.350", 1),
}


def fencepost(*arguments):
    done = subprocess.run([FENCEPOST, *map(str, arguments)], capture_output=True, timeout=300, cwd=FOLDER.name)
    if done.returncode != 0:
        raise AssertionError(done.stderr.decode())
    return done.stdout


def export(name, *arguments, log=LOG):
    path = pathlib.Path(FOLDER.name) / name
    fencepost("export", log, "-o", path, *arguments)
    if DAMAGE:
        whole = path.read_bytes()
        broken = DAMAGES[name](whole)
        assert broken != whole, name
        path.write_bytes(broken)
    return path


def read(path):
    done = subprocess.run([NODE, READERS / "read.mjs", path], capture_output=True, timeout=300)
    if done.returncode != 0:
        raise AssertionError(done.stderr.decode())
    return json.loads(done.stdout)


RESULT = json.loads(fencepost("replay", LOG, "--json"))
FRAMES = [line.split("*")[0].split(",") for line in LOG.read_text().splitlines() if line.startswith("$FPFRM")]
LATENCY = 0.05


def blobs_of(fields):
    """(x1, y1, x2, y2) of each blob of an FPFRM line."""
    return [tuple(map(int, fields[4 + 9 * i + 1 : 4 + 9 * i + 5])) for i in range(int(fields[3]))]


def alert_texts():
    lines = fencepost("replay", LOG).decode().split("\n\n")[0].splitlines()
    return [re.sub(r"^ *\S+ s  ", "", line).split("  (object")[0].split() for line in lines]


def outline(thing):
    """The ring that exports show of an object of the result document."""
    models = thing["models"]
    geometry = models["hybrid"]["geometry"] or models["cylinder"]["geometry"]
    rings = geometry["coordinates"] if geometry["type"] == "Polygon" else geometry["coordinates"][0]
    return rings[0][:-1]


SOLID = [thing for thing in RESULT["objects"] if thing["state"] != "tentative"]


class Export(unittest.TestCase):
    def same_places(self, ours, theirs):
        """To the last of four decimals."""
        for a, b in zip(ours, theirs, strict=True):
            self.assertLess(math.dist(a, b), 1.5e-4)

    def poses_are(self, messages):
        self.assertEqual(len(messages), RESULT["log"]["odometry"])
        end = messages[-1]
        self.assertAlmostEqual(end["position"]["x"], RESULT["pose"]["x"], delta=1e-4)
        self.assertAlmostEqual(end["position"]["y"], RESULT["pose"]["y"], delta=1e-4)
        yaw = 2 * math.atan2(end["orientation"]["z"], end["orientation"]["w"])
        self.assertAlmostEqual(math.remainder(yaw - RESULT["pose"]["heading"], 2 * math.pi), 0, delta=1e-4)

    def detections_are(self, topic):
        self.assertEqual(topic["schema"], "vision_msgs/msg/Detection2DArray")
        self.assertEqual(len(topic["messages"]), len(FRAMES))
        for message, time, fields in zip(topic["messages"], topic["times"], FRAMES):
            stamp = message["header"]["stamp"]
            self.assertAlmostEqual(time, float(fields[1]), places=6)
            fine = stamp["nanosec"] if "nanosec" in stamp else stamp["nsec"]
            self.assertAlmostEqual(stamp["sec"] + fine * 1e-9, float(fields[1]) - LATENCY, places=6)
            boxes = []
            for one in message["detections"]:
                box = one["bbox"]
                at = box["center"]["position"]
                left, top = at["x"] - box["size_x"] / 2, at["y"] - box["size_y"] / 2
                boxes.append((left, top, left + box["size_x"] - 1, top + box["size_y"] - 1))
                self.assertIn(one["results"][0]["hypothesis"]["class_id"], [s["name"] for s in RESULT["signatures"]])
            self.assertEqual(boxes, blobs_of(fields))

    def file_is_whole(self, mcap):
        counted = sum(len(topic["messages"]) for topic in mcap["topics"].values())
        self.assertEqual([mcap["streamed"], mcap["counted"]], [counted, counted])
        self.assertEqual(mcap["attachments"], [{"name": LOG.name, "mediaType": "text/plain", "text": LOG.read_bytes().decode()}])
        self.assertEqual(mcap["metadata"][0]["digest"], RESULT["digest"])
        for topic in mcap["topics"].values():
            self.assertEqual(topic["times"], sorted(topic["times"]))

    def test_foxglove(self):
        mcap = read(export("run.mcap"))
        self.file_is_whole(mcap)
        topics = mcap["topics"]
        self.poses_are([m["pose"] for m in topics["/pose"]["messages"]])
        self.poses_are([m["pose"]["pose"] for m in topics["/odom"]["messages"]])
        self.detections_are(topics["/detections"])
        self.assertEqual(topics["/objects"]["schema"], "foxglove.SceneUpdate")
        last = topics["/objects"]["messages"][-1]
        for thing in SOLID:
            entity = next(e for e in last["entities"] if e["id"] == str(thing["id"]))
            self.assertEqual(entity["texts"][0]["text"], f"{thing['id']} {thing['name']}")
            points = [[p["x"], p["y"]] for p in entity["lines"][0]["points"]]
            self.same_places(points, outline(thing))
            self.assertTrue(max(p["z"] for p in entity["triangles"][0]["points"]) >= thing["z_max"] - 1e-4)
        self.assertEqual([m["message"].split() for m in topics["/alerts"]["messages"]], alert_texts())
        frames = {(m["parent_frame_id"], m["child_frame_id"]) for m in topics["/tf"]["messages"]}
        self.assertEqual(frames, {("map", "base_link"), ("base_link", "camera")})

    def test_ros2(self):
        mcap = read(export("run.ros2.mcap", "--format", "mcap-ros2"))
        self.assertEqual(mcap["profile"], "ros2")
        self.file_is_whole(mcap)
        topics = mcap["topics"]
        self.poses_are([m["pose"]["pose"] for m in topics["/odom"]["messages"]])
        twists = [m["twist"]["twist"]["linear"]["x"] for m in topics["/odom"]["messages"]]
        self.assertAlmostEqual(max(twists), 0.2, delta=0.05)
        self.detections_are(topics["/detections"])
        self.assertEqual({one["child_frame_id"] for m in topics["/tf"]["messages"] for one in m["transforms"]}, {"base_link"})
        (latched,) = topics["/tf_static"]["messages"]
        (mount,) = latched["transforms"]
        self.assertEqual([mount["header"]["frame_id"], mount["child_frame_id"]], ["base_link", "camera"])
        (quality,) = yaml.safe_load(topics["/tf_static"]["metadata"]["offered_qos_profiles"])
        self.assertEqual([quality[key] for key in ("history", "depth", "reliability", "durability")], [1, 1, 1, 1])
        self.assertEqual(topics["/tf"]["metadata"], {"offered_qos_profiles": ""})
        self.assertIn({"serialized_metadata": ""}, mcap["metadata"])
        last = topics["/objects"]["messages"][-1]["markers"]
        for thing in SOLID:
            line = next(m for m in last if m["ns"] == "outlines" and m["id"] == thing["id"] and m["action"] == 0)
            points = [[p["x"], p["y"]] for p in line["points"]][:-1]
            self.same_places(points, outline(thing))
        self.assertEqual([m["msg"].split() for m in topics["/alerts"]["messages"]], alert_texts())
        levels = [m["level"] for m in topics["/alerts"]["messages"]]
        wanted = {"clear": 20, "notice": 20, "warn": 30, "stop": 40, "blind": 40}
        self.assertEqual(levels, [wanted[a["level"]] for a in RESULT["alerts"]])

    def test_geojson(self):
        features = read(export("run.geojson"))["features"]
        things = [f for f in features if f["properties"]["kind"] == "object"]
        self.assertEqual([f["properties"]["id"] for f in things], [o["id"] for o in RESULT["objects"] if o["models"]["cylinder"]["geometry"] or o["models"]["hybrid"]["geometry"]])
        for feature, thing in zip(things, RESULT["objects"]):
            ring = feature["geometry"]["coordinates"][0]
            self.assertEqual(ring[0], ring[-1])
            self.assertTrue(all(a != b for a, b in zip(ring, ring[1:])), ring)  # strict readers refuse a repeated corner
            corners = outline(thing)
            # One corner may stand for two that its last decimal does not tell apart.
            nearest = [min(ring[:-1], key=lambda place: math.dist(place, corner)) for corner in corners]
            self.same_places(nearest, corners)
            self.assertEqual({tuple(place) for place in nearest}, {tuple(place) for place in ring})
        path = next(f for f in features if f["properties"]["kind"] == "path")["geometry"]
        self.assertEqual(path["type"], "LineString")
        alerts = [f for f in features if f["properties"]["kind"] == "alert"]
        self.assertTrue(alerts)
        stop = next(f for f in alerts if f["properties"]["level"] == "stop")
        red = outline(next(o for o in RESULT["objects"] if o["name"] == "red"))
        self.assertLess(min(math.dist(stop["geometry"]["coordinates"], p) for p in red), 0.1)

    def test_geojson_on_the_earth(self):
        """Distances by the haversine of a mean radius agree within its half per cent."""
        features = read(export("earth.geojson", "--at", "52.5,13.4,30"))["features"]
        metres = outline(RESULT["objects"][0])
        degrees = features[0]["geometry"]["coordinates"][0]
        (east, north), (x, y) = degrees[0], metres[0]
        dn = math.radians(north - 52.5) * 6371e3
        de = math.radians(east - 13.4) * 6371e3 * math.cos(math.radians(52.5))
        self.assertAlmostEqual(math.hypot(de, dn), math.hypot(x, y), delta=0.01 * math.hypot(x, y))
        bearing = math.degrees(math.atan2(de, dn))
        self.assertAlmostEqual(math.remainder(bearing - (30 - math.degrees(math.atan2(y, x))), 360), 0, delta=0.5)

    def test_glb(self):
        glb = read(export("run.glb"))
        nodes = {n["name"]: n for n in glb["json"]["nodes"]}
        self.assertEqual(set(nodes), {"map", "path", *(f"{o['id']} {o['name']}" for o in SOLID)})
        for thing in SOLID:
            node = nodes[f"{thing['id']} {thing['name']}"]
            self.assertEqual(node["extras"]["views"], thing["views"])
            position = glb["json"]["meshes"][node["mesh"]]["primitives"][0]["attributes"]["POSITION"]
            bounds = glb["json"]["accessors"][position]
            ring = outline(thing)
            self.assertAlmostEqual(bounds["max"][0], max(p[0] for p in ring), delta=1e-5)
            self.assertAlmostEqual(bounds["min"][1], min(p[1] for p in ring), delta=1e-5)
            self.assertAlmostEqual(bounds["max"][2], thing["z_max"], delta=1e-5)
        self.assertGreater(glb["info"]["totalTriangleCount"], 0)

    def test_nav2_map(self):
        """Loaded as nav2's map_server loads it: thresholds, rows from the top."""
        path = export("map.yaml", "--format", "nav2")
        told = yaml.safe_load(path.read_text())
        image = PIL.Image.open(path.parent / told["image"])
        self.assertEqual(image.mode, "L")
        self.assertEqual((told["mode"], told["negate"]), ("trinary", 0))
        ox, oy, turn = told["origin"]
        self.assertEqual(turn, 0)

        def cell(x, y):
            column = math.floor((x - ox) / told["resolution"])
            row = image.height - 1 - math.floor((y - oy) / told["resolution"])
            occupied = 1 - image.getpixel((column, row)) / 255
            return 100 if occupied > told["occupied_thresh"] else 0 if occupied < told["free_thresh"] else -1

        for thing in SOLID:
            for x, y in outline(thing):
                self.assertEqual(cell(x, y), 100, (x, y))
        held = [cell(x, y) for _, x, y, _ in RESULT["path"]]
        self.assertEqual(set(held), {0})
        self.assertEqual(cell(ox + 0.01, oy + 0.01), -1)

    def test_collision_monitor(self):
        told = yaml.safe_load(export("monitor.yaml", "--format", "collision-monitor").read_text())
        parameters = told["collision_monitor"]["ros__parameters"]
        self.assertEqual(parameters["polygons"], ["fencepost_stop", "fencepost_warn"])
        stop = json.loads(parameters["fencepost_stop"]["points"])
        self.assertEqual(stop, [[0.25, 0.15], [0.25, -0.15], [-0.1, -0.15], [-0.1, 0.15]])
        self.assertEqual(json.loads(parameters["fencepost_warn"]["points"])[0], [0.5, 0.15])
        self.assertEqual([parameters[p]["action_type"] for p in parameters["polygons"]], ["stop", "slowdown"])

    def test_svg(self):
        root = xml.etree.ElementTree.fromstring(export("run.svg").read_bytes())
        texts = [t.text for t in root.iter("{http://www.w3.org/2000/svg}text")]
        for thing in SOLID:
            self.assertIn(f"{thing['id']} {thing['name']}", texts)

    def test_png(self):
        image = PIL.Image.open(export("run.png"))
        image.load()
        colours = {colour for _, colour in image.convert("RGB").getcolors(1 << 24)}
        self.assertGreater(len(colours), 50)
        self.assertGreater(min(image.size), 600)

    def test_csv(self):
        rows = list(csv.reader(io.StringIO(export("run.csv").read_text())))
        self.assertEqual(rows[0], ["Timestamp", "Key", "Value"])
        self.assertTrue(all(len(row) == 3 for row in rows))
        times = [float(row[0]) for row in rows[1:]]
        self.assertEqual(times, sorted(times))
        values = {}
        for _, key, value in rows[1:]:
            values.setdefault(key, []).append(value)
        self.assertEqual(len(values["robot/x"]), RESULT["log"]["odometry"])
        self.assertAlmostEqual(float(values["robot/x"][-1]), RESULT["pose"]["x"], delta=1e-4)
        self.assertEqual([int(v) for v in values["camera/blobs"]], [int(f[3]) for f in FRAMES])
        self.assertEqual(values["alerts/level"], [a["level"] for a in RESULT["alerts"]])
        self.assertIn("objects/1 red/x", values)
        for line in export("run.csv").read_text().splitlines()[1:]:  # as AdvantageScope reads them
            _, key, value = line.split(",")
            self.assertNotIn('"', key)
            json.loads(value)

    def test_it_comes_back(self):
        """Through either MCAP and our own import, which is also read by its own tests: the same boxes and poses."""
        camera = pathlib.Path(FOLDER.name) / "camera.log"
        line = next(l for l in LOG.read_text().splitlines() if l.startswith("$FPCAM"))
        camera.write_text(line + "\n")
        for form in ("mcap", "mcap-ros2"):
            name = f"back.{form}.mcap"
            fencepost("export", LOG, "--format", form, "-o", name)
            fencepost("import", "mcap", name, "--camera", camera, "-o", "back.log")
            back = (pathlib.Path(FOLDER.name) / "back.log").read_text().splitlines()
            frames = [l.split("*")[0].split(",") for l in back if l.startswith("$FPFRM")]
            self.assertEqual([blobs_of(f) for f in frames], [blobs_of(f) for f in FRAMES], form)


class Usage(unittest.TestCase):
    def test_what_is_wrong_is_said_and_nothing_is_written(self):
        for arguments, code, words in (
            (["-o", "x.foo"], 2, ".foo: its ending names no format"),
            ([], 2, "no format was named"),
            (["--format", "nav2", "-o", "-"], 2, "two files"),
            (["--format", "nav2", "-o", "x.pgm"], 2, "x.yaml"),
            (["-o", "x.svg", "--model", "sheef"], 2, "this run has cylinder"),
            (["-o", "x.yaml", "--resolution", "0.00001"], 2, "choose a larger --resolution"),
            (["-o", "x.svg", "--from", "100"], 3, "--from"),
        ):
            folder = tempfile.TemporaryDirectory()
            done = subprocess.run([FENCEPOST, "export", LOG, *arguments], capture_output=True, text=True, cwd=folder.name)
            self.assertEqual((done.returncode, done.stdout), (code, ""), done.stderr)
            self.assertIn(words, done.stderr)
            self.assertEqual(list(pathlib.Path(folder.name).iterdir()), [])
            folder.cleanup()

    def test_names_of_logs_and_colours_are_text(self):
        """In markup, JSON, YAML and CSV alike."""
        name = '<b>"&\', \x1b[2J'
        log = LOG.read_bytes().decode()
        coded = "".join("%%%02X" % c if chr(c) in ",*$%" or c < 32 else chr(c) for c in name.encode())
        body = f"FPSIG,1,d02020,{coded}"
        line = "$%s*%04X" % (body, binascii.crc_hqx(body.encode(), 0xFFFF))
        log = re.sub(r"\$FPSIG,1,[^\r]*", lambda _: line, log)
        path = pathlib.Path(FOLDER.name) / "a'b\"c.log"
        path.write_bytes(log.encode())
        svg = xml.etree.ElementTree.fromstring(fencepost("export", path, "--format", "svg", "-o", "-"))
        self.assertTrue([t for t in svg.iter("{http://www.w3.org/2000/svg}text") if (t.text or "").startswith('1 <b>"&')])
        features = json.loads(fencepost("export", path, "--format", "geojson", "-o", "-"))["features"]
        self.assertEqual(features[0]["properties"]["name"], name)
        rows = list(csv.reader(io.StringIO(fencepost("export", path, "--format", "csv", "-o", "-").decode())))
        self.assertTrue(all(len(row) == 3 and row[1].count(",") == 0 for row in rows))
        self.assertNotIn("\x1b", "".join("".join(row) for row in rows))
        fencepost("export", path, "--format", "nav2", "-o", pathlib.Path(FOLDER.name) / "a'b\"c.yaml")
        self.assertEqual(yaml.safe_load((pathlib.Path(FOLDER.name) / "a'b\"c.yaml").read_text())["image"], "a'b\"c.pgm")
        glb = pathlib.Path(FOLDER.name) / "hostile.glb"
        fencepost("export", path, "-o", glb)
        self.assertIn(f"1 {name}", [n["name"] for n in read(glb)["json"]["nodes"]])


if DAMAGE:
    del Export.test_it_comes_back
    del Usage

if __name__ == "__main__":
    result = unittest.main(exit=False).result
    if DAMAGE:  # done when nothing passed
        sys.exit(0 if len(result.failures) + len(result.errors) == result.testsRun else 1)
    sys.exit(0 if result.wasSuccessful() else 1)
