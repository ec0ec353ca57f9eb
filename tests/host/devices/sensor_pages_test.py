"""Planted faults of the sensors' pages are found: python3 sensor_pages_test.py SOURCES."""

import pathlib
import shutil
import sys
import tempfile
import unittest

import device_facts
import sensor_pages
import sensor_runs

SOURCES = pathlib.Path(sys.argv.pop(1)).resolve()
READ = (*device_facts.PAGES, "hal/boards/pico/board.hpp", "firmware/config/cameras.hpp", "firmware/config/devices.hpp")


class Planted(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        for name in READ:
            (self.root / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(SOURCES / name, self.root / name)
        shutil.copytree(SOURCES / "host/share/doc/sensors", self.root / "host/share/doc/sensors")
        self.pages = self.root / "host/share/doc/sensors"

    def faults(self):
        made, faults = sensor_pages.files_of(self.root)
        return faults + [path.name for path, text in made.items() if path.read_text(encoding="utf-8") != text]

    def edit(self, name, old, new):
        path = self.root / name
        text = path.read_text(encoding="utf-8")
        self.assertIn(old, text)
        path.write_text(text.replace(old, new), encoding="utf-8")

    def test_as_it_is(self):
        self.assertEqual(self.faults(), [])

    def test_each_is_found(self):
        plants = {
            "pixy2 has no page": lambda: (self.pages / "pixy2.md").unlink(),
            "old.md is of no device": lambda: (self.pages / "old.md").write_text(""),
            "cmucam4.md": lambda: self.edit("firmware/config/cameras.hpp", '"cmucam4", kLine, 19\'200', '"cmucam4", kLine, 38\'400'),
            "huskylens.json": lambda: self.edit("tests/host/devices/facts.txt", "| `huskylens` | 320 x 240", "| `huskylens` | 640 x 480"),
            "xbc.md lacks <!--wires-->": lambda: self.edit("host/share/doc/sensors/xbc.md", "<!--wires-->", ""),
            "xbc.md lacks ## Traps": lambda: self.edit("host/share/doc/sensors/xbc.md", "## Traps", "## More"),
            "huskylens.md": lambda: self.edit("host/share/doc/sensors/huskylens.md", "- *Not ready*: it has", "- *Not ready*: perhaps it has"),
            "create2.md": lambda: self.edit("host/share/doc/sensors/create2.md", "--log run.log", "--log it.log"),
        }
        for says, plant in plants.items():
            with self.subTest(says):
                plant()
                self.assertIn(says, "\n".join(self.faults()))
                self.setUp()

    def test_the_example_is_compared(self):
        devices = device_facts.devices_of(SOURCES)
        self.assertTrue(sensor_runs.example_is_shown(devices, SOURCES))
        self.edit(sensor_runs.EXAMPLE, "--seconds 14", "--seconds 1")
        self.assertFalse(sensor_runs.example_is_shown(devices, self.root))

    def test_a_sentence_is_compared_without_its_numbers(self):
        page = (SOURCES / sensor_runs.SENTENCES).read_text(encoding="utf-8")
        pattern = sensor_runs.sentence(page, "pixy2", "works:", "frames")
        self.assertRegex("note     pixy2 at ./camera works: 9 frames a second, 1.3 blobs each", pattern)
        self.assertNotRegex("note     pixy2 at ./camera works and sees nothing", pattern)
        self.assertNotRegex("note     pixy1 at ./camera works: 9 frames a second, 1.3 blobs each", pattern)
        with self.assertRaises(sensor_runs.Wrong):
            sensor_runs.sentence(page, "pixy2", "is on fire")


unittest.main()
