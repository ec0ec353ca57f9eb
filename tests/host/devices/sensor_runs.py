"""usage: sensor_runs.py FENCEPOST SOURCES [NAME...]

Runs what host/share/doc/devices.md shows of one device, for each: emulate and run in two terminals, replay --check of
the log, and doctor. Doctor looks at the emulated device and at a port where nobody answers; its sentences have to be
those of doctor.md. NAMEs: these alone.
"""

import os
import pty
import re
import subprocess
import sys
import time
from pathlib import Path

from device_facts import devices_of, page_of
from sensor_pages import CONSOLE, emulation, kind, unsettled

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "cli"))
from shown_place import shown_place  # noqa: E402

PATIENCE = 3600  # s of the stage, whose clock may jump while a program starts
SENTENCES = "host/share/doc/doctor.md"
EXAMPLE = "host/share/doc/devices.md"
START = 4  # s: what the slowest takes from being switched on, for which doctor does not wait


class Wrong(Exception):
    """The run differs from the page."""


def start(command, folder, environment):
    return subprocess.Popen(["sh", "-c", "exec " + command], cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                            stderr=subprocess.STDOUT, text=True, start_new_session=True)


def await_links(folder, process):
    for _ in range(500):
        if all((Path(folder) / link).is_symlink() for link in ("camera", "wheels")):
            return
        if process.poll() is not None:
            break
        time.sleep(0.02)
    raise Wrong("emulate made no links:\n" + process.communicate(timeout=PATIENCE)[0])


def expect(said, patterns, command):
    for pattern in patterns:
        if not re.search(pattern, said, re.MULTILINE):
            raise Wrong(f"$ {command}\nsaid no {pattern}:\n{said}")


def drive(emulate, run, program, sources):
    """Both lines as they are shown; the robot has to stop, and its log to replay."""
    camera, wheels = re.match(r"fencepost emulate (\S+) (\S+)", emulate).groups()
    with shown_place(program, sources) as (folder, environment):
        beside = start(emulate, folder, environment)
        try:
            await_links(folder, beside)
            robot = start(run, folder, environment)
            said = robot.communicate(timeout=PATIENCE)[0]
        finally:
            beside.terminate()
            beside.communicate(timeout=PATIENCE)
        expect(said, [rf"^camera {camera} at \./camera works", rf"^odometry {wheels} at \./wheels works", r"^WARN ", r"^STOP ", ", 0 rejected"], run)
        if robot.returncode != 0:
            raise Wrong(f"$ {run}\nended with {robot.returncode}:\n{said}")
        check = start("fencepost replay --check run.log", folder, environment)
        said = check.communicate(timeout=PATIENCE)[0]
        expect(said, [r"check passed: [1-9]\d* logged records agree"], "fencepost replay --check run.log")


def sentence(page, name, says, of=""):
    """Doctor's sentence on the device in the page's table, as a pattern: at any place and with any numbers."""
    shown = re.search(rf"`DEVICE at PLACE ({says}[^`]*{of}[^`]*)`", page)
    if not shown:
        raise Wrong(f"{SENTENCES} has no sentence '{says}'")
    return re.escape(name) + r" at \S+ " + re.sub(r"\d+(\\\.\d+)?", r"[\\d.]+", re.escape(shown.group(1)))


def examine(device, emulate, program, sources):
    page = (sources / SENTENCES).read_text(encoding="utf-8")
    scene = next(word for word in emulate.split() if word.endswith(".json"))
    end = "camera" if device.camera else "wheels"
    with shown_place(program, sources) as (folder, environment):
        doctor = f"fencepost doctor --{kind(device)} {device.name}:./{end}{unsettled(device)} --robot {scene}"
        beside = start(emulate, folder, environment)
        try:
            await_links(folder, beside)
            time.sleep(START)
            said = start(doctor, folder, environment).communicate(timeout=PATIENCE)[0]
        finally:
            beside.terminate()
            beside.communicate(timeout=PATIENCE)
        expect(said, [sentence(page, device.name, "works:", "frames" if device.camera else "poses")], doctor)
        master, slave = pty.openpty()  # a port, and nobody behind it
        os.symlink(os.ttyname(slave), Path(folder) / "nobody")
        os.close(slave)
        silent = f"fencepost doctor --{kind(device)} {device.name}:./nobody --robot {scene}"
        said = start(silent, folder, environment).communicate(timeout=PATIENCE)[0]
        os.close(master)
        expect(said, ["^FAULT .*" + sentence(page, device.name, "is silent")], silent)


def play_a_log(page, program, sources):
    """The console's lines."""
    for line in CONSOLE:
        if f"\n    {line}\n" not in page:
            raise Wrong(f"the page shows no $ {line}")
    with shown_place(program, sources) as (folder, environment):
        for line in CONSOLE:
            process = subprocess.run(["sh", "-c", line], cwd=folder, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                     timeout=PATIENCE, check=False)
            if process.returncode != 0:
                raise Wrong(f"$ {line}\nended with {process.returncode}:\n{process.stdout}")


def fault_of(device, program, sources):
    try:
        if device.name == "console":
            play_a_log(page_of(sources, device).read_text(encoding="utf-8"), program, sources)
        else:
            emulate, run = emulation(device)
            drive(emulate, run, program, sources)
            examine(device, emulate, program, sources)
    except Wrong as wrong:
        return f"{device.name}: {wrong}"
    return None


def example_is_shown(devices, sources):
    """The lines of one device, which stand for those of all."""
    page = (sources / EXAMPLE).read_text(encoding="utf-8")
    return all(f"\n    {line}\n" in page for line in emulation(devices["pixy2"]))


def main(arguments):
    program, sources = (Path(path).resolve() for path in arguments[:2])
    wanted = arguments[2:]
    known = devices_of(sources)
    devices = [device for device in known.values()
               if (emulation(device) or device.name == "console") and (not wanted or device.name in wanted)]
    faults = [fault for fault in (fault_of(device, program, sources) for device in devices) if fault]
    if not example_is_shown(known, sources):
        faults.append(f"{EXAMPLE} does not show: " + ", ".join(emulation(known["pixy2"])))
    print("\n\n".join(faults))
    print(f"{len(devices)} devices, {len(faults)} do not as their page says")
    return 1 if faults or not devices else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
