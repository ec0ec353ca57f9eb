"""A test's own folder, with the files that it plants."""

import pathlib
import tempfile
import unittest


def plant(root, files):
    """`files`: texts by their paths."""
    for name, text in files.items():
        path = root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


class Planted(unittest.TestCase):
    FILES = {}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        plant(self.root, self.FILES)
