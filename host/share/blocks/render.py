#!/usr/bin/env python3
"""Renders a scene's views with POV-Ray: render.py SCENE.json FOLDER [--views N,N,...].

Writes FOLDER/view_NNN.png and FOLDER/poses.csv (image,t,x,y,heading of the robot; s, m, rad). One thread a view and no random sampling:
the same scene gives the same bytes with the same POV-Ray. The path must be an arc around a centre, the camera level.
"""

import argparse
import json
import math
import os
import shutil
import struct
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

HERE = Path(__file__).resolve().parent


def poses_of(scene):
    """(t, x, y, heading) of each view, rounded as the record stream rounds them."""
    path = scene["path"]
    if path["type"] != "arc" or path.get("look_at", "center") != "center":
        sys.exit("render.py: the path must be an arc that looks at its centre")
    step = path["sweep"] / max(1, path["views"] - 1)
    for i in range(path["views"]):
        angle = path.get("start", 0) + i * step
        x = path["center"][0] + path["radius"] * math.cos(angle)
        y = path["center"][1] + path["radius"] * math.sin(angle)
        heading = math.remainder(angle + math.pi - scene["camera"]["mount"].get("yaw", 0), 2 * math.pi)
        yield tuple(round(value, 4) + 0.0 for value in (i / scene["camera"].get("rate", 50), x, y, heading))


def prism(points, base, height):
    ring = [*points, points[0]] if points[0] != points[-1] else points
    corners = ", ".join(f"<{x:.6f}, {y:.6f}>" for x, y in ring)
    return f"prism {{ linear_sweep linear_spline {base:.6f}, {base + height:.6f}, {len(ring)}, {corners}"


def block_of(thing, colours):
    """One object as POV-Ray text."""
    base, height, footprint = thing.get("base", 0), thing["height"], thing["footprint"]
    if "circle" in footprint:
        x, y, r = footprint["circle"]
        shape = f"cylinder {{ <{x:.6f}, {base:.6f}, {y:.6f}>, <{x:.6f}, {base + height:.6f}, {y:.6f}>, {r:.6f}"
    else:
        (ring,) = footprint["coordinates"]
        shape = prism(ring, base, height)
    rgb = colours[thing["signature"]]
    channels = ", ".join(str(int(rgb[at:at + 2], 16) / 255) for at in (0, 2, 4))
    return f"{shape} pigment {{ color srgb <{channels}> }} finish {{ Matt }} }}\n"


def camera_of(scene, pose):
    camera, mount = scene["camera"], scene["camera"]["mount"]
    width, height, focus = camera["width"], camera["height"], camera["fx"]
    level = not mount.get("pitch", 0) and camera["fy"] == focus and not camera.get("k1", 0)
    if not level or (camera["cx"], camera["cy"]) != ((width - 1) / 2, (height - 1) / 2):
        sys.exit("render.py: the camera must be level, without distortion, its axis through the image's centre")
    _, x, y, heading = pose
    c, s = math.cos(heading), math.sin(heading)
    x, y = x + c * mount.get("x", 0) - s * mount.get("y", 0), y + s * mount.get("x", 0) + c * mount.get("y", 0)
    c, s = math.cos(heading + mount.get("yaw", 0)), math.sin(heading + mount.get("yaw", 0))
    return (f"camera {{ location <{x:.6f}, {mount.get('z', 0):.6f}, {y:.6f}> direction <{c:.9f}, 0, {s:.9f}> * {focus}\n"
            f"  up <0, {height}, 0> right <{s:.9f}, 0, {-c:.9f}> * {width} }}\n")


def without_remarks(png):
    """The file without POV-Ray's date and settings: only what makes the picture."""
    kept, at = png[:8], 8
    while at < len(png):
        (length,) = struct.unpack(">I", png[at:at + 4])
        if png[at + 4:at + 8] in (b"IHDR", b"IDAT", b"IEND"):
            kept += png[at:at + length + 12]
        at += length + 12
    return kept


def render(scene, pose, blocks, target):
    with tempfile.TemporaryDirectory() as folder:
        source = Path(folder) / "view.pov"
        source.write_text((HERE / "table.pov").read_text() + blocks + camera_of(scene, pose))
        size = [f"+W{scene['camera']['width']}", f"+H{scene['camera']['height']}"]
        quality = ["+A0.03", "+AM1", "+R3", "-J", "+WT1"]  # antialiased, not jittered, one thread
        done = subprocess.run(["povray", f"+I{source}", f"+O{target}", "+FN8", "-D", "-GA", *size, *quality],
                              capture_output=True, text=True, cwd=folder, env=dict(os.environ, HOME=folder))
        if done.returncode != 0 or not target.exists():
            raise SystemExit(f"render.py: povray failed:\n{done.stderr}")
        target.write_bytes(without_remarks(target.read_bytes()))


def main():
    parser = argparse.ArgumentParser(description="Renders a scene's views with POV-Ray.")
    parser.add_argument("scene", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--views", help="only these, such as 0,7; default: all")
    arguments = parser.parse_args()
    if not shutil.which("povray"):
        sys.exit("render.py: povray is missing; run toolchain/setup render")
    scene = json.loads(arguments.scene.read_text())
    folder = arguments.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    colours = {signature["id"]: signature["rgb"] for signature in scene["signatures"]}
    blocks = "".join(block_of(thing, colours) for thing in scene["objects"])
    wanted = {int(view) for view in arguments.views.split(",")} if arguments.views else None
    rows, jobs = ["image,t,x,y,heading"], []
    for i, pose in enumerate(poses_of(scene)):
        name = f"view_{i:03}.png"
        rows.append(f"{name}," + ",".join(f"{value:.4f}" for value in pose))
        if wanted is None or i in wanted:
            jobs.append((pose, folder / name))
    with ThreadPoolExecutor(os.cpu_count()) as pool:  # a renderer of one thread each
        for done, _ in enumerate(pool.map(lambda job: render(scene, job[0], blocks, job[1]), jobs), 1):
            print(f"{done} of {len(jobs)} views", file=sys.stderr)
    (folder / "poses.csv").write_text("\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
