"""Facts of each device, from the tables of PAGES (the catalogue wrote them) and from firmware/config."""

import re
from dataclasses import dataclass, field
from pathlib import Path

PAGES = ("host/share/doc/devices.md", "tests/host/devices/facts.txt")
PICOS = ("pico", "xrp", "pico2", "xrp2")
BOARDS = ("pico", "xrp", "pico2", "xrp2", "netduino_plus_2", "pyboard", "feather_f405", "microbit", "microbit_v2")


@dataclass
class OnBoard:
    """A name that a board's image knows it by."""

    name: str
    port: str  # kLine, kTwoWire, kPins or kConsole
    speed: int
    address: int


@dataclass
class Device:
    name: str
    about: str
    camera: bool = False
    odometry: bool = False
    places: list = field(default_factory=list)
    options: list = field(default_factory=list)
    images: list = field(default_factory=list)  # OnBoard
    lens: list = field(default_factory=list)  # the row of its lens: image, across, focal length, lens, latency, source
    tells: str = ""  # emulate's words on it; empty: it is not emulated
    unready: str = ""


def cells_of(line):
    return [cell.strip() for cell in re.split(r"(?<!\\)\|", line.strip().strip("|"))]


def tables_of(text):
    """{heading of the first column, of each table: rows}"""
    tables, rows = {}, None
    for line in text.splitlines():
        if not line.startswith("|"):
            rows = None
        elif rows is None:
            rows = tables.setdefault(cells_of(line)[0] + (" " + cells_of(line)[1]).rstrip(), [])
        elif not line.startswith("|---"):
            rows.append(cells_of(line))
    return tables


def plain(cell):
    return re.search(r"`([^`]+)`", cell).group(1)


def on_boards(sources):
    texts = [(sources / f"firmware/config/{file}.hpp").read_text(encoding="utf-8").replace("'", "") for file in ("cameras", "devices")]
    found = {}
    for row in (r'X\(\w+, "([^"]+)", (\w+), (\d+), (\w+)', r'\{"([^"]+)"(?:, Port::(\w+))?(?:, (\d+))?(?:, (0x\w+))?\}'):
        for name, port, speed, address in re.findall(row, "".join(texts)):
            found.setdefault(name, OnBoard(name, port or "kConsole", int(speed or 0), int(address or "0", 16)))
    return found


def devices_of(sources):
    """{name: Device}, in the catalogue's order; the boards' own encoders last."""
    tables = {}
    for page in PAGES:
        tables |= tables_of((sources / page).read_text(encoding="utf-8"))
    images = on_boards(sources)
    devices = {}
    for key, role in (("camera", "camera"), ("odometry", "odometry")):
        for name, about, places, names in tables[key]:
            device = devices.setdefault(plain(name), Device(plain(name), about))
            setattr(device, role, True)
            device.places = re.findall(r"`([^`]+)`", places) or ([places] if places else [])
            device.images += [images[n] for n in re.findall(r"`([^`]+)`", names) if images[n] not in device.images]
            if about not in device.about:
                device.about += "; " + about
    for name, options in tables["device options of `run`"]:
        found = [part.strip() for part in options.replace("\\|", "|").split(";") if part.strip()]
        devices[plain(name)].options += [option for option in found if option not in devices[plain(name)].options]
    for row in tables["camera image"]:
        devices[plain(row[0])].lens = row[1:]
    for name, why in tables["device why, or what to try"]:
        devices[plain(name)].unready = why
    for name, tells in tables["device what it can tell"]:
        base = plain(name).split(":")[0]
        if base in devices and not devices[base].tells:
            devices[base].tells = tells
    devices["encoders"] = Device("encoders", "Quadrature encoders on a board's pins", odometry=True, images=[images["encoders"]])
    return devices


def lowest_address(sources, board):
    """That the board's two-wire bus can speak to."""
    if board not in PICOS:
        return 0
    text = (sources / "hal/boards/pico/board.hpp").read_text(encoding="utf-8")
    return int(re.search(r"kLowestAddress = (\d+);", text).group(1))


def page_of(sources, device):
    return Path(sources) / "host/share/doc/sensors" / f"{device.name}.md"
