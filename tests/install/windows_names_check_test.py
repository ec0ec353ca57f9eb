"""The check finds a name without a stand-in, and is content when it is there."""

import pathlib
import shutil
import tempfile
import unittest

from windows_names_check import check

ROOT = pathlib.Path(__file__).resolve().parents[2]


class WindowsNames(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        shutil.copytree(ROOT / "host" / "cli", self.root / "host" / "cli")
        self.missing = self.root / "host" / "cli" / "windows" / "missing.cpp"

    def test_the_tree_is_whole(self):
        self.assertEqual(check(self.root), [])

    def test_a_stand_in_that_went_is_found(self):
        text = self.missing.read_text()
        self.assertIn("bool has_lab() { return false; }\n", text)
        self.missing.write_text(text.replace("bool has_lab() { return false; }\n", ""))
        self.assertEqual(check(self.root), [
            "host/cli/command_doctor.cpp: asks for has_lab(), and host/cli/windows/missing.cpp has none"])

    def test_a_header_that_cannot_be_read_is_found(self):
        (self.root / "host" / "cli" / "lab.hpp").write_text("")
        self.assertEqual(len(check(self.root)), 1)


if __name__ == "__main__":
    unittest.main()
