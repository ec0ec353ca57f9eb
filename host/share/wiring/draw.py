#!/usr/bin/env python3
"""usage: draw.py FOLDER [pins.md]

Draws the wirings of host/share/doc/FIRST_ALERT.md: FOLDER/wiring_*.svg. The boards' pins are those of host/share/doc/pins.md.
"""

import html
import pathlib
import re
import sys

TOP = pathlib.Path(__file__).resolve().parents[3]
ROW = 46  # px between two pins
MARGIN = 20
HEAD = 74  # of the title and the blocks' names
WIDTHS = {"block": 250, "small": 150, "gap": 130}
PAD = 10  # px below the last pin
COLOURS = {"ground": "#222222", "5 V": "#c62828", "3.3 V": "#ef6c00", "there": "#1565c0", "back": "#2e7d32", "stop": "#7b1fa2"}


def pins_of(text):
    """{board: {signal: (name, the rest)}}: the tables of pins.md, whose cells are `name, where` or `where, name`."""
    boards = {}
    columns = []
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")] if line.startswith("|") else []
        names = [(n, name) for n, cell in enumerate(cells) if cell.startswith("`") for name in re.findall(r"`(\w+)`", cell)]
        if names:
            columns = names
        elif not cells:
            columns = []
        elif not cells[0].startswith("-"):
            for n, board in columns:
                first, _, rest = cells[n].partition(", ")
                if first:  # a board has what another of its table has not
                    boards.setdefault(board, {})[cells[0]] = (first, rest)
    return boards


class Drawing:
    """Blocks beside each other, and straight wires between pins of one row."""

    def __init__(self, title, blocks, notes):
        self.parts = []
        self.left, self.right = [], []
        x = MARGIN
        rows = max(row for _, _, pins in blocks for row, *_ in pins) + 1
        self.bottom = HEAD + ROW * rows + PAD
        for name, width, pins in blocks:
            self.left.append(x)
            self.block(x, WIDTHS[width], name, pins)
            x += WIDTHS[width]
            self.right.append(x)
            x += WIDTHS["gap"]
        self.width = x - WIDTHS["gap"] + MARGIN
        self.title = title
        self.notes = notes

    def text(self, x, y, text, anchor="start", size=15, weight="normal", fill="#222222"):
        self.parts.append(f'<text x="{x}" y="{y}" text-anchor="{anchor}" font-size="{size}" font-weight="{weight}" '
                          f'fill="{fill}">{html.escape(text)}</text>')

    @staticmethod
    def y(row):
        return HEAD + ROW * row + ROW // 2

    def block(self, x, width, name, pins):
        self.parts.append(f'<rect x="{x}" y="{HEAD}" width="{width}" height="{self.bottom - HEAD}" rx="10" fill="#f3f6f9" '
                          'stroke="#455a64" stroke-width="2"/>')
        self.text(x + width // 2, HEAD - 12, name, "middle", 16, "bold")
        for row, side, label, more in pins:
            at = x if side == "left" else x + width
            inside = at + 14 if side == "left" else at - 14
            anchor = "start" if side == "left" else "end"
            self.parts.append(f'<circle cx="{at}" cy="{self.y(row)}" r="6" fill="#ffffff" stroke="#455a64" stroke-width="2"/>')
            self.text(inside, self.y(row) + (0 if more else 5), label, anchor, weight="bold")
            if more:
                self.text(inside, self.y(row) + 16, more, anchor, 13, fill="#555555")

    def wire(self, gap, row, kind, name=None):
        """In the gap behind the block of that number."""
        colour = COLOURS[kind]
        self.parts.append(f'<line x1="{self.right[gap] + 6}" y1="{self.y(row)}" x2="{self.left[gap + 1] - 6}" y2="{self.y(row)}" '
                          f'stroke="{colour}" stroke-width="4"/>')
        name = name or ("signal" if kind in ("there", "back") else kind)
        self.text(self.right[gap] + 12, self.y(row) - 7, name, size=12, fill=colour)

    def resistor(self, gap, row, value):
        """From that row's wire to the next one's."""
        x = self.left[gap + 1] - 60
        top, bottom = self.y(row), self.y(row + 1)
        self.parts.append(f'<line x1="{x}" y1="{top}" x2="{x}" y2="{bottom}" stroke="#222222" stroke-width="2"/>'
                          f'<rect x="{x - 6}" y="{top + 10}" width="12" height="{ROW - 20}" fill="#ffffff" stroke="#222222" stroke-width="2"/>')
        self.text(x + 11, (top + bottom) // 2 + 5, value, size=13)

    def connector(self, block, wired):
        """The Pixy2's I/O port as one looks at it, in that block: `wired` has the pins' kinds."""
        for pin in range(1, 11):
            x, y = self.left[block] + 26 + 22 * ((pin - 1) // 2), HEAD + 34 + 26 * ((pin - 1) % 2)
            fill = COLOURS[wired[pin]] if pin in wired else "#ffffff"
            self.parts.append(f'<rect x="{x - 9}" y="{y - 11}" width="18" height="20" fill="{fill}" stroke="#455a64"/>')
            self.text(x, y + 4, str(pin), "middle", 12, fill="#ffffff" if pin in wired else "#555555")

    def svg(self):
        lines = "".join(f'<text x="{MARGIN}" y="{self.bottom + 28 + 20 * n}" font-size="14" fill="#222222">{html.escape(note)}</text>\n'
                        for n, note in enumerate(self.notes))
        height = self.bottom + 20 * len(self.notes) + 28
        parts = "\n".join(self.parts)
        return (f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {self.width} {height}" width="{self.width}" height="{height}" '
                f'font-family="sans-serif" role="img">\n<title>{html.escape(self.title)}</title>\n'
                f'<rect width="{self.width}" height="{height}" fill="#ffffff"/>\n'
                f'<text x="{MARGIN}" y="32" font-size="19" font-weight="bold" fill="#222222">{html.escape(self.title)}</text>\n'
                f"{parts}\n{lines}</svg>\n")


PIXY2_SERIAL = [(0, "right", "1", "UART RX"), (1, "right", "4", "UART TX"), (2, "right", "6", "ground")]
DRIVER = [(0, "left", "enable", "ENA and ENB, or EN"), (1, "left", "ground", "")]


def pico(pins):
    """A Pixy2 by its serial line, and a motor driver at STOP."""
    board = [(0, "left", *pins["camera sends"]), (1, "left", *pins["camera receives"]), (2, "left", "GND", "pin 8"),
             (3, "left", "VBUS", "pin 40"), (0, "right", *pins["stop"]), (1, "right", "GND", "pin 18")]
    drawing = Drawing("Pixy2 or Pixy2.1 on a Raspberry Pi Pico", [
        ("Pixy2, I/O port", "block", [*PIXY2_SERIAL, (3, "right", "2", "5 V")]), ("Pico", "block", board), ("Motor driver", "block", DRIVER)],
        ["Sender to receiver, both ways. STOP is high while the robot may drive; the resistor holds it low in a reset.",
         "The motor driver's other pins are the driving program's. Its motors have a supply of their own: join the grounds."])
    for row, kind in enumerate(("there", "back", "ground", "5 V")):
        drawing.wire(0, row, kind)
    drawing.connector(0, {1: "there", 4: "back", 6: "ground", 2: "5 V"})
    drawing.wire(1, 0, "stop")
    drawing.wire(1, 1, "ground")
    drawing.resistor(1, 0, "10 kΩ")
    return drawing


def pico_shifter(pins):
    """A camera or a Create that speaks with 5 V."""
    drawing = Drawing("A serial camera or a Create with 5 V signals on a Pico", [
        ("Camera or Create", "block", [(0, "right", "RX", "receives"), (1, "right", "TX", "sends"), (2, "right", "ground", "")]),
        ("Level shifter", "small", [(0, "left", "HV1", ""), (1, "left", "HV2", ""), (2, "left", "GND", ""), (0, "right", "LV1", ""),
                                    (1, "right", "LV2", ""), (2, "right", "GND", ""), (3, "right", "LV", ""), (4, "right", "HV", "")]),
        ("Pico", "block", [(0, "left", *pins["camera sends"]), (1, "left", *pins["camera receives"]), (2, "left", "GND", "pin 8"),
                           (3, "left", "3V3(OUT)", "pin 36"), (4, "left", "VBUS", "pin 40")])],
        ["A level shifter for both directions (four channels, BSS138), 3.3 V on LV, 5 V on HV. The camera has a supply of its own.",
         "A socket with nine pins (RS-232) carries -10 to 10 V: that takes a MAX3232, not this."])
    for gap, kinds in ((0, ("there", "back", "ground")), (1, ("there", "back", "ground", "3.3 V", "5 V"))):
        for row, kind in enumerate(kinds):
            drawing.wire(gap, row, kind)
    return drawing


def pico_battery(pins):
    """A Pico that drives without a cable."""
    drawing = Drawing("A Pico on a battery, with a button", [
        ("Battery", "small", [(0, "right", "+", "fuse, switch"), (1, "right", "-", "")]),
        ("5 V regulator", "small", [(0, "left", "IN", ""), (1, "left", "GND", ""), (0, "right", "OUT", "1 A"), (1, "right", "GND", "")]),
        ("Pico", "block", [(0, "left", "VSYS", "pin 39, by the diode"), (1, "left", "GND", "pin 38"),
                           (0, "right", *pins["button"]), (1, "right", "GND", "pin 28")]),
        ("Push button", "small", [(0, "left", "one leg", ""), (1, "left", "the other", "")])],
        ["A Schottky diode (1N5817) from OUT to VSYS, its ring towards the Pico: battery and USB cable may both be there.",
         "The Pixy2's pin 2 goes to OUT, not to VBUS, which has 5 V from the cable alone. Battery: what motors and regulator bear.",
         "Press: go. Press again: stop. All grounds are joined."])
    for gap, kinds in ((0, ("5 V", "ground")), (1, ("5 V", "ground")), (2, ("there", "ground"))):
        for row, kind in enumerate(kinds):
            drawing.wire(gap, row, kind, "battery" if gap == 0 and row == 0 else None)
    return drawing


def xrp(pins, sold="of 2023", plug="servo 1", more=()):
    """A Pixy2 by its serial line, and a light at STOP. `more`: notes."""
    # "GP16, servo 1": the names of the controller's plugs are what one looks for.
    swapped = {signal: (where or name, name if where else "") for signal, (name, where) in pins.items()}
    drawing = Drawing(f"Pixy2 or Pixy2.1 on an XRP robot {sold}", [
        ("Pixy2, I/O port", "block", PIXY2_SERIAL),
        ("XRP controller", "block", [(0, "left", *swapped["camera sends"]), (1, "left", *swapped["camera receives"]),
                                     (2, "left", "ground", f"of {plug}'s plug"), (0, "right", *swapped["stop"]), (1, "right", "ground", "of the range plug")]),
        ("LED with its resistor", "block", [(0, "left", "long leg", "through 330 Ω"), (1, "left", "short leg", "")])],
        ["The Pixy2 gets its 5 V by its own USB plug, from a power bank: the middle pin of a servo's plug (5 V) stays free.",
         "The range plug takes the cable of the distance sensor, pulled off the sensor. The light shines while the robot may drive.",
         "Fencepost turns both wheels after go on the console, or the button USER, alone: lift them first.", *more])
    for row, kind in enumerate(("there", "back", "ground")):
        drawing.wire(0, row, kind)
    drawing.connector(0, {1: "there", 4: "back", 6: "ground"})
    drawing.wire(1, 0, "stop")
    drawing.wire(1, 1, "ground")
    return drawing


def xrp2(pins):
    """The same on the newer controller."""
    drawing = xrp(pins, "since late 2024", "servo 4", ["The resistor holds STOP low in a reset (erratum RP2350-E9)."])
    drawing.resistor(1, 0, "4.7 kΩ")
    return drawing


def microbit_v2(pins):
    """A Pixy2 by its serial line, from rings that crocodile clips reach."""
    board = [(0, "left", *pins["camera sends"]), (1, "left", *pins["camera receives"]), (2, "left", "GND", "ring"),
             (0, "right", *pins["stop"]), (1, "right", "GND", "the same")]
    drawing = Drawing("Pixy2 or Pixy2.1 on a micro:bit v2", [
        ("Pixy2, I/O port", "block", PIXY2_SERIAL), ("micro:bit v2", "block", board), ("Motor driver", "block", DRIVER)],
        ["Five crocodile clips. The Pixy2 gets its 5 V by its own USB plug, from a power bank: the micro:bit has none to give.",
         "STOP is high while the robot may drive; the resistor holds it low in a reset. The motor driver's other pins are the driving program's."])
    for row, kind in enumerate(("there", "back", "ground")):
        drawing.wire(0, row, kind)
    drawing.connector(0, {1: "there", 4: "back", 6: "ground"})
    drawing.wire(1, 0, "stop")
    drawing.wire(1, 1, "ground")
    drawing.resistor(1, 0, "10 kΩ")
    return drawing


DRAWINGS = {"pico": (pico, "pico"), "pico_shifter": (pico_shifter, "pico"), "pico_battery": (pico_battery, "pico"), "xrp": (xrp, "xrp"), "xrp2": (xrp2, "xrp2"), "microbit_v2": (microbit_v2, "microbit_v2")}
FILES = [f"wiring_{name}.svg" for name in DRAWINGS]


def draw(pins):
    """{file name: text}"""
    return {file: make(pins.get(board)).svg() for file, (make, board) in zip(FILES, DRAWINGS.values())}


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__.strip())
    pins = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else TOP / "host/share/doc/pins.md"
    for name, text in draw(pins_of(pins.read_text(encoding="utf-8"))).items():
        (pathlib.Path(sys.argv[1]) / name).write_text(text, encoding="utf-8")


if __name__ == "__main__":
    main()
