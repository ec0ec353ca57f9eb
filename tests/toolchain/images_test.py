#!/usr/bin/env python3
"""usage: images_test.py

toolchain/images.py: which boards there are, what it leaves, what it refuses; and that host/share/doc/boards.md has each
preset. Nothing is compiled: the build is the test's own.
"""

import base64
import gzip
import hashlib
import json
import pathlib
import re
import sys
import unittest

TOP = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(TOP / "toolchain"))
import images  # noqa: E402
from planted import Planted

TEXT = (TOP / images.DOCUMENT).read_text(encoding="utf-8")
BOARDS = images.boards(json.loads((TOP / "CMakePresets.json").read_text(encoding="utf-8")))
KINDS_OF = {"pico": ("uf2", "hex", "bin", "elf")}


def row_cells(text, heading):
    """{board: {column: cell}} of the first table of the text that has this column."""
    lines = text.splitlines()
    start = next(n for n, line in enumerate(lines) if line.startswith("|") and f"| {heading} |" in line)
    columns = [cell.strip() for cell in lines[start].strip("|").split("|")]
    rows = {}
    for line in lines[start + 2:]:
        if not line.startswith("|"):
            break
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        rows[cells[0].strip("`")] = dict(zip(columns, cells))
    return rows


class Boards(unittest.TestCase):
    def test_variants_of_a_board_are_no_boards(self):
        presets = {"configurePresets": [
            {"name": "base", "hidden": True},
            {"name": "one", "inherits": "base", "cacheVariables": {"FENCEPOST_BOARD": "one"}},
            {"name": "one-console", "inherits": "one"},
            {"name": "two", "inherits": ["base", "one"], "cacheVariables": {"FENCEPOST_BOARD": "two"}},
            {"name": "host"}]}
        self.assertEqual(images.boards(presets), ["one", "two"])

    def test_each_preset_is_a_folder_of_boards(self):
        self.assertGreaterEqual(len(BOARDS), 7)
        for board in BOARDS:
            self.assertTrue((TOP / "hal/boards" / board / "CMakeLists.txt").is_file(), board)

    def test_the_document_has_each_board_for_three_systems(self):
        head, parts = images.sections(TEXT)
        self.assertLessEqual(set(BOARDS), set(parts))
        for title in ("Onto a board", "The console"):
            part = head.split(f"## {title}\n")[1].split("\n## ")[0]
            self.assertEqual(re.findall(r"^\| (Windows|macOS|Linux) \|", part, re.MULTILINE), ["Windows", "macOS", "Linux"], title)
        for board, part in parts.items():
            self.assertRegex(part, r"by DFU|the drive\b|As the v1|emulator \(", board)
            self.assertEqual(set(re.findall(r"fencepost-VERSION-(\w+)\.", part)), {board})

    def test_each_board_has_what_was_tested_and_what_was_not(self):
        tested = images.table_of_boards(TEXT)
        never = row_cells(TEXT, "never tried")
        for board in BOARDS:
            self.assertIn(f"| `{board}` |", tested)
            self.assertTrue(never[board]["never tried"], board)


    def test_a_release_has_each_page_that_it_links(self):
        guide = (TOP / images.GUIDE).read_text(encoding="utf-8")
        there = {images.page_of(name) for _, name in images.PAGE.findall(guide)} | {"FIRST_ALERT", "START_HERE"}
        for text in (TEXT, guide):
            linked = images.PAGE.findall(text)
            self.assertTrue(linked)
            self.assertEqual(len(linked), len(re.findall(r"(?<!!)\[[^\]]+\]\((?!http)", text)), "a link that no page of a release answers")
            self.assertLessEqual({images.page_of(name) for _, name in linked}, there)


class Images(Planted):
    def setUp(self):
        super().setUp()
        self.out = self.root / "out"

    def source(self, text):
        """A tree with the Pico alone."""
        source = self.root / "source"
        for name, content in (("CMakePresets.json", json.dumps({"configurePresets": [
                {"name": "pico", "cacheVariables": {"FENCEPOST_BOARD": "pico"}}]})), (images.DOCUMENT, text),
                (images.GUIDE, "# First\n\n![wires](wires.svg) fencepost-VERSION-pico.uf2 [seen](seen.md) [boards](boards.md)\n"),
                ("host/share/doc/wires.svg", "<svg/>"), ("host/share/doc/seen.md", "# Seen\n"), (images.EXAMPLES + "/stop.py", "pass\n"),
                (images.WEB_PAGE, f"<html>{images.WEB_PLACE}<script></script></html>")):
            path = source / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(content, encoding="utf-8")
        return source

    def make(self, text=TEXT, kinds=KINDS_OF["pico"]):
        def build(_source, folder, board):
            folder.mkdir(parents=True, exist_ok=True)
            for kind in kinds:
                (folder / f"fencepost.{kind}").write_bytes(f"{board} {kind}".encode())
        images.make(self.source(text), self.root / "build", self.out, "1.2.3", build)

    def test_leaves_images_pages_and_sums(self):
        self.make()
        names = {path.relative_to(self.out).as_posix() for path in self.out.rglob("*") if path.is_file()}
        self.assertEqual(names, {"SHA256SUMS", "START_HERE.html", "FIRST_ALERT.html", "wires.svg", "seen.html", "examples/stop.py", "fencepost-boards.html",
                                 *(f"fencepost-1.2.3-pico.{kind}" for kind in KINDS_OF["pico"])})
        sums = dict(reversed(line.split("  ")) for line in (self.out / "SHA256SUMS").read_text().splitlines())
        self.assertEqual(set(sums), names - {"SHA256SUMS"})
        for name, digest in sums.items():
            self.assertEqual(hashlib.sha256((self.out / name).read_bytes()).hexdigest(), digest, name)
        start, guide = ((self.out / f"{name}.html").read_text() for name in ("START_HERE", "FIRST_ALERT"))
        self.assertIn("fencepost-1.2.3-pico.uf2", start)
        self.assertIn("<td>rp2040js</td>", start)
        self.assertNotIn("<code>pyboard</code>", start, "a board that is not there")
        self.assertIn('<img src="wires.svg"', guide)
        self.assertIn('<a href="seen.html"', guide)
        self.assertIn('<a href="START_HERE.html"', guide)
        self.assertNotIn("VERSION", start + guide)

    def test_the_page_has_the_images_inside(self):
        self.make()
        text = (self.out / "fencepost-boards.html").read_text()
        inside = json.loads(re.search(r'id="images">(.*?)</script>', text).group(1))
        self.assertEqual([(one["board"], gzip.decompress(base64.b64decode(one["image"]))) for one in inside], [("pico", b"pico bin")])
        self.assertIn(images.WEB_PLACE, text, "logs can still be put into it")
        with self.assertRaisesRegex(images.Fault, "host/web/build makes it"):
            images.page_with_images("<html></html>", {})

    def test_is_the_same_again_and_keeps_nothing_of_before(self):
        self.make()
        first = (self.out / "SHA256SUMS").read_bytes()
        (self.out / "fencepost-0.0.1-pico.uf2").write_bytes(b"old")
        self.make()
        self.assertEqual((self.out / "SHA256SUMS").read_bytes(), first)
        self.assertFalse((self.out / "fencepost-0.0.1-pico.uf2").exists())

    def refused(self, why, **how):
        with self.assertRaisesRegex(images.Fault, why):
            self.make(**how)

    def test_a_board_that_the_table_leaves_out_is_refused(self):
        self.refused("the table of boards has no row for pico", text=TEXT.replace("| `pico` |", "| `pica` |"))
        self.refused("has no table that begins", text=TEXT.replace("| preset |", "| name |"))

    def test_a_board_without_a_section_is_refused(self):
        self.refused("no section for pico", text=TEXT.replace("## `pico`", "## `picoo`"))

    def test_a_file_that_is_named_and_not_built_is_refused(self):
        self.refused("names fencepost-VERSION-pico.uf2, which was not built", kinds=("hex", "bin", "elf"))

    def test_a_file_that_nobody_explains_is_refused(self):
        self.refused("does not say what fencepost-VERSION-pico.elf is for", text=TEXT.replace("| `.elf` |", "| elf |"))

    def test_a_build_that_leaves_nothing_is_refused(self):
        self.refused("has no image", kinds=())

    def test_a_folder_of_something_else_is_kept(self):
        self.out.mkdir()
        (self.out / "thesis.tex").write_text("years")
        self.refused("holds something else")
        self.assertEqual((self.out / "thesis.tex").read_text(), "years")


unittest.main()
