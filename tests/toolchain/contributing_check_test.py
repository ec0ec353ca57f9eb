#!/usr/bin/env python3
"""A small tree with a document that is true, then with one fault of each kind."""

import unittest

from contributing_check import boards, cameras, check, models, settings, siblings
from planted import Planted, plant

DOCUMENT = """# Contributing
## Commits
| new | `nowhere` | no list |

## Add a board: BOARD
| | file | |
|---|---|---|
| new | `hal/boards/BOARD/board.hpp` | its pins |
| new | `tests/BOARD.hpp` or `tests/BOARD/BOARD.hpp` | its emulator |
| edit | `README.md` | its row |

## Add a setting: SETTING
| edit | `firmware/config/settings.hpp` | |
"""
TREE = {
    ".github/CONTRIBUTING.md": DOCUMENT,
    "hal/boards/template/board.hpp": "",
    "hal/boards/pico/board.hpp": "",
    "hal/boards/pico/image.ld": "",
    "hal/boards/f405/board.hpp": "",
    "hal/boards/f405/image.ld": "",
    "tests/pico.hpp": "",
    "tests/f405/f405.hpp": "",
    "README.md": "pico and f405",
    "firmware/config/settings.hpp": '    {"alert.stop", "m", 2},\n    {"robot.width", "m", 2},\n',
}
KINDS = {"BOARD": boards, "SETTING": settings}


class ContributingCheck(Planted):
    FILES = TREE

    def write(self, name, text):
        plant(self.root, {name: text})

    def faults(self, kinds=None):
        faults, _ = check(self.root, kinds or KINDS)
        return "\n".join(faults)

    def test_a_true_document_has_no_faults_and_was_compared(self):
        self.assertEqual(check(self.root, KINDS), ([], 2 * 3 + 2 * 1))

    def test_the_cameras_are_those_of_the_catalogue_with_a_driver(self):
        self.write("host/devices/pixy2.cpp", "  .role = Role::kCamera,")
        self.write("host/devices/console.cpp", "  row(Role::kCamera, ...")
        self.write("host/devices/create.cpp", "  .role = Role::kOdometry,")
        self.write("drivers/pixy2/README.md", "")
        self.write("drivers/create/README.md", "")
        self.assertEqual(cameras(self.root), ["pixy2"])
        self.write(".github/CONTRIBUTING.md", "## Add a camera: CAMERA\n| new | `host/emulate/models/CAMERA.cpp` | |\n")
        self.assertIn("CAMERA pixy2: there is no host/emulate/models/pixy2.cpp", self.faults({"CAMERA": cameras}))

    def test_a_board_of_pins_alone_is_a_sibling(self):
        self.write("hal/boards/f405/pins.hpp", "")
        self.write("hal/boards/pyboard/pins.hpp", "")
        self.assertEqual(siblings(self.root), ["pyboard"])
        self.assertEqual(boards(self.root), ["f405", "pico"])

    def test_a_file_that_is_missing_is_found(self):
        (self.root / "tests/f405/f405.hpp").unlink()
        self.assertEqual(self.faults().count("BOARD f405: there is no tests/f405.hpp or tests/f405/f405.hpp"), 1)

    def test_a_file_that_does_not_name_it_is_found(self):
        self.write("README.md", "pico")
        self.assertIn("BOARD f405: README.md does not name it", self.faults())

    def test_a_model_is_found_by_its_name_however_it_is_written(self):
        self.write("firmware/recon/models/x/y.hpp", '  static constexpr std::string_view kName = "cylinder_paper";\n')
        self.write("firmware/recon/models/z.hpp", "no model\n")
        self.write(".github/CONTRIBUTING.md", "## Add a model: MODEL\n| edit | `README.md` or `other` | |\n")
        self.write("other", "using Models = List<CylinderPaper>;")
        self.assertEqual(check(self.root, {"MODEL": models}), ([], 1))
        self.write("other", "using Models = List<Cylinder>;")
        self.assertIn("MODEL cylinder_paper: README.md does not name it", self.faults({"MODEL": models}))

    def test_a_list_has_as_many_files_as_it_says(self):
        said = "BOARD\nThree files, one of them edits.\n"
        self.write(".github/CONTRIBUTING.md", DOCUMENT.replace("BOARD\n", said, 1))
        self.assertEqual(self.faults(), "")
        for wrong in ("Two files, one of them", "Three files, two of them"):
            self.write(".github/CONTRIBUTING.md", DOCUMENT.replace("BOARD\n", said.replace("Three files, one of them", wrong), 1))
            self.assertIn(f"BOARD: 3 files, 1 of them edits, not '{wrong} edits'", self.faults())

    def test_a_list_that_names_a_file_that_was_moved_is_found(self):
        self.write(".github/CONTRIBUTING.md", DOCUMENT.replace("settings.hpp", "keys.hpp"))
        self.assertIn("SETTING alert.stop: there is no firmware/config/keys.hpp", self.faults())

    def test_a_list_that_is_missing_empty_or_of_nothing_known_is_found(self):
        self.assertIn("no list for CAMERA", self.faults({**KINDS, "CAMERA": boards}))
        self.assertIn("nothing is known of SETTING", self.faults({"BOARD": boards}))
        self.assertIn("BOARD: nothing to compare", self.faults({**KINDS, "BOARD": lambda root: []}))
        self.write(".github/CONTRIBUTING.md", "## Add a board: BOARD\n")
        self.assertIn("BOARD: nothing to compare", self.faults())


if __name__ == "__main__":
    unittest.main()
