"""usage: sensor_pages.py SOURCES [--write]

The pages of host/share/doc/sensors, one a device. The text from `<!--NAME-->` to the next heading is made of the
catalogue's tables (device_facts.py). So is the trap "Not ready"; the rest is written by hand. Compares; with --write it
renews those parts and the scenes beside the pages. Exit status 1 if something differs, or a device has no page.
"""

import json
import re
import sys
import textwrap
from pathlib import Path

from device_facts import BOARDS, Device, devices_of, lowest_address, page_of

SECTIONS = ("facts", "wires", "run")
BY_HAND = ("## Set it up", "## Traps")
SCENE_RATE = 12.5  # pictures a second: what any of them can
PLACE_SHOWN = {"/dev/tty...": "/dev/ttyUSB0", "/dev/i2c-N": "/dev/i2c-1", "/dev/spidevN.M": "/dev/spidev0.0", "usb": "usb", "nxt": "nxt",
               "a CAN interface": "can0", "/dev/videoN": "/dev/video0", "FILM.y4m": "film.y4m"}
FIVE_VOLTS = "a USB serial adapter of 5 V, RX and TX crossed"
# Devices whose serial line needs another adapter than one of 3.3 V.
OWN_LINE = {
    **{name: FIVE_VOLTS for name in ("cmucam1", "cmucam2", "avrcam", "create1", "create2")},
    "cognachrome": "an RS-232 port, or a USB adapter of RS-232",
    "xbc": "the cable by which its programs are loaded",
    "cbc": "a serial adapter at its USB port, crossed with one at ours",
    "nxtcam": "its own USB port, `/dev/ttyUSB0`",
    "nxt": "Bluetooth: `rfcomm bind 0 ADDRESS` makes `/dev/rfcomm0`",
    "openmv": "its USB port, `/dev/ttyACM0`; or a USB serial adapter of 3.3 V",
    "jevois": "its USB port, `/dev/ttyACM0`; or a USB serial adapter, RX and TX crossed",
    "vex": "the Brain's USB port, `/dev/ttyACM1`",
    "records": "the other controller's USB port, `/dev/ttyACM0`; or a USB serial adapter, RX to its TX",
}
PICTURES = ("/dev/videoN", "FILM.y4m")  # where a camera gets its colours from us


def paragraph(text, indent=""):
    """Lines of at most 120 columns, with what stands in backticks on one of them."""
    whole = re.sub(r"`[^`]*`", lambda match: match.group().replace(" ", "\0"), text)
    return textwrap.fill(whole, 120, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False).replace("\0", " ")


def kind(device):
    return "camera" if device.camera else "odometry"


def line_of(device):
    """The place that examples name: a serial line where there is one."""
    return "/dev/tty..." if "/dev/tty..." in device.places else device.places[0]


def shown_place(device, place):
    """With the baud that boards and our advice have, where the device is delivered with another one."""
    shown = PLACE_SHOWN[place]
    speeds = [image.speed for image in device.images if image.port == "kLine"]
    other = place == "/dev/tty..." and speeds and f"`baud={speeds[0]}`" not in device.options
    return f"{shown},baud={speeds[0]}" if other else shown


def facts(device, _sources):
    lines = [f"- It reports {device.tells}."] if device.tells else []
    if device.lens:
        image, across, focal, lens, latency, source = device.lens
        width = f"{across} across" if image in device.tells else f"{across} across {image} px"
        focal = focal.split(" x ")[0] if len(set(focal.split(" x "))) == 1 else focal
        other = "" if lens.startswith("pinhole") else f", {lens.split(',')[0]}"
        lines.append(f"- Lens: {width}, focal length {focal} px{other}, latency {latency}. {source[0].upper()}{source[1:]}.")
    lines += [f"- Option {option}." for option in device.options]
    return "\n".join(paragraph(line, "  ") for line in lines)


def on_board(device, sources):
    """The lines to type, for each of the device's ports."""
    for image in device.images:
        typed = f"`set {kind(device)} {image.name}`"
        if image.port == "kLine":
            yield f"{typed} ({'camera' if device.camera else 'base'}'s line, {image.speed} baud)"
        elif image.port == "kTwoWire":
            refused = [f"`{board}`" for board in BOARDS if image.address < lowest_address(sources, board)]
            yield f"{typed} (two-wire bus, address {image.address:#04x}{', not on ' * bool(refused)}{', '.join(refused)})"


def wires(device, sources):
    links = []
    if device.name in OWN_LINE:
        links.append(f"On Linux its serial line is {OWN_LINE[device.name]}.")
    elif device.places and device.places[0] not in ("a CAN interface", *PICTURES):
        links.append("On Linux: [which wires](../live.md#devices).")
    if not device.images:
        links.append("No board has it.")
    elif device.images[0].port in ("kLine", "kTwoWire"):
        links.append(f"On a board ([pins](../pins.md)): {' or '.join(on_board(device, sources))}.")
    else:
        links.append("On a board: [pins](../pins.md).")
    return paragraph(" ".join(links))


def unsettled(device):
    """An emulated camera needs no white balance, and doctor does not wait for it."""
    return ",settle=0" if any(option.startswith("`settle") for option in device.options) else ""


def colours(place):
    return " --colours colours.json" if place in PICTURES else ""


def emulation(device):
    """(emulate, run) lines in two terminals, as devices.md shows them of one; None where nothing can be emulated without a CAN interface or a console."""
    scene = f"host/share/doc/sensors/{device.name if device.lens else 'pixy2'}.json"
    camera = device.name if device.lens else "pixy2"
    wheels = device.name if not device.camera else "create2"
    if not device.tells or device.name == "can":
        return None
    settle = unsettled(device)
    return (f"fencepost emulate {camera} {wheels} {scene} --link ./camera --link ./wheels",
            f"fencepost run --camera {camera}:./camera{settle} --odometry {wheels}:./wheels --robot {scene} --seconds 14 --log run.log")


CONSOLE = ("fencepost run --camera console --odometry console --mode log < host/share/recordings/stop_pixy2.log > again.log",
           "fencepost replay --check again.log")


def places_lines(device):
    for place in sorted(device.places, key=lambda place: place != line_of(device)):
        if place not in PLACE_SHOWN:
            continue
        spec = f"{device.name}:{shown_place(device, place)}"
        if device.camera and (place == "nxt" or place == line_of(device)):
            wheels = "nxt:usb" if place == "nxt" else "create2:/dev/ttyUSB1"
            yield f"fencepost run --camera {spec} --odometry {wheels} --robot robot.json{colours(place)} --log run.log"
        elif place == line_of(device):
            yield f"fencepost run --camera pixy2:/dev/ttyUSB1 --odometry {spec} --robot robot.json --log run.log"
        else:
            yield f"# or --{kind(device)} {spec}{colours(place)}"


def run(device, _sources):
    parts = []
    if device.name == "console":
        parts.append("A log, played into a robot of this machine, which says the same:\n\n" + "\n".join("    " + line for line in CONSOLE))
    lines = ["    " + line for line in places_lines(device)]
    if lines:
        parts.append("[About `robot.json`](../live.md#robot-file):\n\n" + "\n".join(lines))
    if device.name == "encoders":
        parts.append("The settings above, typed on a board's [console](../console.md), or [written into its image](../boards.md#cameras).")
    return "\n\n".join(parts)


def with_trap(text, device):
    """Begins the traps with the catalogue's words on a device that is not ready."""
    item = paragraph(f"- *Not ready*: {device.unready}.", "  ") + "\n" if device.unready else ""
    return re.sub(r"(?<=^## Traps\n)(?:- \*Not ready\*.*\n(?:  .*\n)*)?", lambda _: item, text, flags=re.MULTILINE)


def scene_of(device):
    """A box 1.8 m ahead of a robot that stops before it, in this camera's picture; also a robot file."""
    image, _, focal, _, latency, _ = device.lens
    width, height = (int(n) for n in image.split(" x "))
    fx, fy = (float(n) for n in focal.split(" x "))
    camera = {"model": device.name, "width": width, "height": height, "fx": fx, "fy": fy, "cx": (width - 1) / 2, "cy": (height - 1) / 2,
              "mount": {"x": 0.05, "y": 0, "z": 0.12, "yaw": 0, "pitch": 0}, "latency": float(latency.split()[0]) / 1000, "rate": SCENE_RATE,
              "max_blobs": 8}
    box = [[1.8, -0.06], [1.9, -0.07], [1.92, 0.04], [1.82, 0.05], [1.8, -0.06]]
    way = [[0, 0], [0.3, 0], [0.7, 0.03], [1.1, -0.02], [1.6, 0]]
    scene = {"format": 1, "seed": 1, "camera": camera, "signatures": [{"id": 1, "name": "red", "rgb": "d02020"}],
             "objects": [{"name": "red box", "signature": 1, "height": 0.1, "footprint": {"type": "Polygon", "coordinates": [box]}}],
             "path": {"type": "waypoints", "points": way, "speed": 0.25, "turn_rate": 0.4}}
    return "{" + ",\n ".join(f'"{key}": {json.dumps(value)}' for key, value in scene.items()) + "}\n"


MAKERS = {"facts": facts, "wires": wires, "run": run}


def part_put(text, name, made):
    return re.sub(rf"(<!--{name}-->\n).*?(?=\n\n## |\Z)", lambda match: match.group(1) + made, text, flags=re.DOTALL)


def renewed(text, device: Device, sources):
    """(the page with its parts made anew, the parts that it lacks)"""
    made = {name: MAKERS[name](device, sources) for name in SECTIONS}
    lacks = [f"<!--{name}-->" for name in SECTIONS if made[name] and f"<!--{name}-->" not in text] + [head for head in BY_HAND if head not in text]
    for name in SECTIONS:
        text = part_put(text, name, made[name])
    return with_trap(text, device), lacks


def files_of(sources):
    """{path: text} of all that is made, and faults"""
    devices = devices_of(sources)
    made, faults = {}, []
    for device in devices.values():
        page = page_of(sources, device)
        if not page.is_file():
            faults.append(f"{device.name} has no page: {page.relative_to(sources)}")
            continue
        text, lacks = renewed(page.read_text(encoding="utf-8"), device, sources)
        faults += [f"{page.name} lacks {part}" for part in lacks]
        made[page] = text
        if device.lens and device.tells:
            made[page.with_name(f"{device.name}.json")] = scene_of(device)
    there = {path for path in (sources / "host/share/doc/sensors").iterdir()}
    faults += [f"{path.name} is of no device" for path in sorted(there - set(made))]
    return made, faults


def main(arguments):
    sources = Path(arguments[0]).resolve()
    made, faults = files_of(sources)
    if "--write" in arguments:
        for path, text in made.items():
            path.write_text(text, encoding="utf-8")
    faults += [f"{path.relative_to(sources)} is not what the catalogue makes of it: sensor_pages.py {arguments[0]} --write"
               for path, text in made.items() if not path.is_file() or path.read_text(encoding="utf-8") != text]
    print("\n".join(faults))
    print(f"{len(made)} files, {len(faults)} faults")
    return 1 if faults or len(made) < 40 else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
