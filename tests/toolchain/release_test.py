#!/usr/bin/env python3
"""usage: release_test.py ROOT

toolchain/release on a small tree with one fault of each kind; and that ROOT has one version.
"""

import importlib.machinery
import importlib.util
import pathlib
import subprocess
import sys
import unittest

from planted import Planted

ROOT = pathlib.Path(sys.argv.pop(1))
loader = importlib.machinery.SourceFileLoader("release", str(ROOT / "toolchain/release"))
release = importlib.util.module_from_spec(importlib.util.spec_from_loader("release", loader))
loader.exec_module(release)

CHANGES = """# Changelog

## [Unreleased]

## [0.2.0] - 2026-11-28

### Added
- This.

## [0.1.0] - 2026-01-01

- That.
"""
TREE = {
    "CMakeLists.txt": "cmake_minimum_required(VERSION 3.25)\nproject(fencepost VERSION 0.2.0 LANGUAGES CXX)\n",
    "firmware/fencepost/fencepost.h": '#define FENCEPOST_VERSION "0.2.0"\n',
    "CITATION.cff": "cff-version: 1.2.0\nversion: 0.2.0\ndate-released: 2026-11-28\n",
    "CHANGELOG.md": CHANGES,
    "toolchain/arduino/library.properties": "version=@VERSION@\n",
    "toolchain/arduino/library.json": '"version": "@VERSION@"\n',
    "host/web/dist/fencepost.html": "the page",
    ".gitignore": "out/\n",
    "toolchain/setup": "#!/bin/sh\n",
    # Stands for the real ones, which take an hour: each leaves a file of the name that is expected.
    "toolchain/package": """#!/bin/sh
case $1 in
  deb) name=fencepost_0.2.0_amd64.deb ;;
  arduino) name=Fencepost-0.2.0.zip ;;
  wheel) name=fencepost-0.2.0-py3-none-any.whl ;;
  windows) name=fencepost-0.2.0-windows.zip ;;
esac
echo "$1" > "$2/$name"
""",
    "toolchain/images.py": """import pathlib, sys
out = pathlib.Path(sys.argv[3])
out.mkdir()
(out / f"fencepost-{sys.argv[4]}-pico.elf").write_text("image")
""",
}


class Release(Planted):
    FILES = TREE

    def setUp(self):
        super().setUp()
        for name in TREE:
            (self.root / name).chmod(0o755)

    def git(self, *words):
        subprocess.run(["git", "-c", "user.name=n", "-c", "user.email=e", *words], cwd=self.root, check=True, capture_output=True)

    def commit(self):
        self.git("init", "-q")
        self.git("add", "-A")
        self.git("commit", "-qm", "All")

    def edit(self, name, old, new):
        text = (self.root / name).read_text()
        self.assertIn(old, text)
        (self.root / name).write_text(text.replace(old, new))

    def test_one_version_everywhere_is_taken(self):
        self.assertEqual(release.version_of(self.root), "0.2.0")

    def test_another_version_in_any_file_is_refused(self):
        for name in [*(name for name, _ in release.VERSIONS), *release.TAKES_IT]:
            text = TREE[name]
            with self.subTest(name), self.assertRaisesRegex(release.Fault, name):
                self.edit(name, "@VERSION@" if "@" in text else "0.2.0", "0.3.0")
                release.version_of(self.root)
            (self.root / name).write_text(text)

    def test_another_day_or_none_is_refused(self):
        self.edit("CITATION.cff", "11-28", "11-29")
        self.assertRaisesRegex(release.Fault, "CITATION.cff says 2026-11-29; CHANGELOG.md says 2026-11-28", release.version_of, self.root)
        self.edit("CITATION.cff", "date-released: 2026-11-29\n", "")
        self.assertRaisesRegex(release.Fault, "CITATION.cff says nothing", release.version_of, self.root)

    def test_the_notes_are_the_section_of_the_version_alone(self):
        self.assertEqual(release.notes_of(self.root, "0.2.0"), "### Added\n- This.\n")
        self.assertEqual(release.notes_of(self.root, "0.1.0"), "- That.\n")
        self.assertRaisesRegex(release.Fault, "no section of 0.3.0", release.notes_of, self.root, "0.3.0")
        self.edit("CHANGELOG.md", "### Added\n- This.\n", "")
        self.assertRaisesRegex(release.Fault, "no section of 0.2.0", release.notes_of, self.root, "0.2.0")

    def test_lines_above_the_release_are_refused(self):
        self.edit("CHANGELOG.md", "## [Unreleased]\n", "## [Unreleased]\n\n### Fixed\n- Too late.\n")
        self.assertRaisesRegex(release.Fault, "lines above the release", release.notes_of, self.root, "0.2.0")

    def test_a_tree_with_changes_is_refused(self):
        self.commit()
        release.refuse_changes(self.root)
        (self.root / "new").write_text("")
        self.assertRaisesRegex(release.Fault, r"\?\? new", release.refuse_changes, self.root)

    def test_a_release_has_all_its_files_and_their_sums(self):
        self.commit()
        release.make(self.root)
        out = self.root / "out/release"
        self.assertEqual((out / "NOTES.md").read_text(), "### Added\n- This.\n")
        self.assertEqual((out / "fencepost-0.2.0.html").read_text(), "the page")
        self.assertEqual(len((out / "SHA256SUMS").read_text().splitlines()), 7)
        subprocess.run(["sha256sum", "--check", "--strict", "--quiet", "SHA256SUMS"], cwd=out, check=True)
        self.edit("toolchain/package", "Fencepost-0.2.0", "Fencepost-0.1.0")
        self.assertRaisesRegex(release.Fault, " M toolchain/package", release.make, self.root)
        self.commit()
        self.assertRaisesRegex(release.Fault, "no Fencepost-0.2.0.zip", release.make, self.root)

    def test_what_was_built_with_another_version_is_found(self):
        for name in ("fencepost-0.2.0.html", "images/fencepost-0.2.0-pico.elf", "fencepost_0.2.0_amd64.deb", "Fencepost-0.2.0.zip",
                     "fencepost-0.2.0-py3-none-any.whl", "fencepost-0.2.0-windows.zip", "NOTES.md"):
            self.assertRaisesRegex(release.Fault, "another version", release.refuse_missing, self.root, "0.2.0")
            path = self.root / name
            path.parent.mkdir(exist_ok=True)
            path.write_text(name)
        release.refuse_missing(self.root, "0.2.0")

    def test_this_tree_has_one_version(self):
        version = release.version_of(ROOT)
        changes = (ROOT / "CHANGELOG.md").read_text(encoding="utf-8")
        self.assertIn(f"## [{version}] - ", changes)
        self.assertTrue(changes.index("## [Unreleased]") < changes.index(f"## [{version}]"))


if __name__ == "__main__":
    unittest.main()
