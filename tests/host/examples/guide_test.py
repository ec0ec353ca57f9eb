"""The guide to a first alert: its drawings are those of the boards' pins, and no step is for one system alone.

usage: guide_test.py SOURCES
"""
import pathlib
import re
import sys
import unittest

TOP = pathlib.Path(sys.argv.pop(1))
sys.path.insert(0, str(TOP / "host/share/wiring"))
import draw  # noqa: E402

GUIDE = TOP / "host/share/doc/FIRST_ALERT.md"
PINS = (TOP / "host/share/doc/pins.md").read_text(encoding="utf-8")
SYSTEMS = ("Windows", "macOS", "Linux")
# About the desk's program, which is one for Linux, and says so.
OTHER_SECTIONS = ("## 10",)


def one_sided(text):
    """Paragraphs and tables that name one of the systems and not all."""
    sections = re.split(r"^(?=## )", text, flags=re.MULTILINE)
    blocks = [block for section in sections if not section.startswith(OTHER_SECTIONS) for block in re.split(r"\n\s*\n", section)]
    named = [block for block in blocks if any(system in block for system in SYSTEMS)]
    return [block for block in named if not all(system in block for system in SYSTEMS)], len(named)


class Guide(unittest.TestCase):
    def test_drawings_are_as_drawn(self):
        drawings = draw.draw(draw.pins_of(PINS))
        self.assertEqual(len(drawings), 6)
        for name, text in drawings.items():
            self.assertEqual((TOP / "host/share/doc" / name).read_text(encoding="utf-8"), text, f"{name}: draw.py host/share/doc")

    def test_drawings_follow_the_pins(self):
        for board, signal, name in (("pico", "camera sends", "GP4"), ("pico", "stop", "GP15"), ("xrp", "camera receives", "GP17"), ("xrp2", "stop", "GP0")):
            self.assertEqual(draw.pins_of(PINS)[board][signal][0], name)
        before, after = (draw.draw(draw.pins_of(text)) for text in (PINS, PINS.replace("| stop | GP15, pin 20 |", "| stop | GP14, pin 19 |")))
        self.assertIn(">GP15<", before["wiring_pico.svg"])
        self.assertNotIn(">GP15<", after["wiring_pico.svg"])

    def test_the_guide_shows_each(self):
        text = GUIDE.read_text(encoding="utf-8")
        shown = re.findall(r"!\[[^\]]+\]\(([^)]+)\)", text)
        self.assertEqual({pathlib.Path(name).name for name in shown}, set(draw.FILES))
        for name in re.findall(r"\]\((?!http)([^)]+)\)", text):
            self.assertTrue((GUIDE.parent / name).is_file(), name)

    def test_the_bench_and_its_form_have_the_same_steps(self):
        steps = [re.findall(row, (TOP / name).read_text(encoding="utf-8"), re.M)
                 for row, name in ((r"^\| (\d+) ", "firmware/BENCH.md"), (r"^- (\d+) ", ".github/ISSUE_TEMPLATE/bench.md"))]
        self.assertEqual(steps[0], [str(n + 1) for n in range(len(steps[0]))])
        self.assertEqual(*steps)
        self.assertGreaterEqual(len(steps[0]), 20)

    def test_each_system_has_its_way(self):
        found, looked_at = one_sided(GUIDE.read_text(encoding="utf-8"))
        self.assertGreaterEqual(looked_at, 4)
        self.assertEqual(found, [])
        self.assertEqual(len(one_sided("## 1\n\nOn Windows press F1.\n\nWindows, macOS and Linux alike.\n")[0]), 1)


unittest.main()
