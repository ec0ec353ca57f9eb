#!/usr/bin/env python3
"""usage: installed_test.py CMAKE CXX BUILD_FOLDER SOURCE_FOLDER

Installs what has been built into a folder, moves it, and uses it as others do: the program, find_package, pkg-config.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

CMAKE, CXX, BUILD, SOURCE = sys.argv[1:5]
HERE = pathlib.Path(__file__).parent
LOG = "share/fencepost/recordings/stop_pixy2.log"


def run(*command, **options):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}\nexit {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.folder.name)
        run(CMAKE, "--install", BUILD, "--prefix", cls.root / "first")
        cls.prefix = cls.root / "elsewhere" / "fencepost"  # an installation may be moved
        cls.prefix.parent.mkdir()
        (cls.root / "first").rename(cls.prefix)

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def configured(self, project, *more):
        build = self.root / f"build_{project}"
        run(CMAKE, "-S", HERE / project, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}", f"-DCMAKE_CXX_COMPILER={CXX}",
            "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *more)
        return build

    def expect_a_stop(self, program):
        said = run(program).splitlines()
        levels = [line.split()[0] for line in said[:-1]]
        self.assertEqual(list(dict.fromkeys(levels))[:3], ["NOTICE", "WARN", "STOP"], said)
        self.assertRegex(said[-1], r"^0\.[23]\d m before the box$")
        shown = re.search(r"^```\n(NOTICE.*?)^```$", Page.page(), re.MULTILINE | re.DOTALL).group(1).splitlines()
        self.assertGreater(len(shown), 5)
        self.assertEqual([line for line in shown if line != "..." and line not in said], [])

    def test_program_runs_with_what_it_reads(self):
        program = self.prefix / "bin/fencepost"
        environment = {name: value for name, value in os.environ.items() if name != "FENCEPOST_SHARE"}
        said = run(program, "demo", "-o", self.root / "demo.html", env=environment, cwd=self.root)
        self.assertIn("STOP    red", said)
        for file in ("doc/embed.md", "schema/result.schema.json", "python/fencepost.py", LOG[16:]):
            self.assertTrue((self.prefix / "share/fencepost" / file).is_file(), file)
        for file in ("share/man/man1/fencepost-replay.1.gz", "share/bash-completion/completions/fencepost",
                     "share/zsh/site-functions/_fencepost", "share/fish/vendor_completions.d/fencepost.fish",
                     "share/doc/fencepost/copyright", "share/doc/libfencepost-dev/copyright"):
            self.assertTrue((self.prefix / file).is_file(), file)

    def test_find_package(self):
        build = self.configured("consumer")
        run(CMAKE, "--build", build)
        self.expect_a_stop(build / "stop")
        command = json.loads((build / "compile_commands.json").read_text())[0]["command"]
        self.assertNotRegex(command, r"\s-W")
        self.assertRegex(command, r"-std=\S*(?:2[0-9]|2a)")

    def test_core_needs_no_other_package(self):
        absent = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{p}=ON" for p in ("fmt", "nlohmann_json")]
        command = run(CMAKE, "--build", self.configured("consumer", *absent), "--clean-first", "-v")
        self.assertNotIn("include/eigen3", command)

    def test_pkg_config(self):
        environment = {**os.environ, "PKG_CONFIG_PATH": str(next(self.prefix.glob("lib*/**/pkgconfig")))}
        self.assertEqual(run("pkg-config", "--modversion", "fencepost", env=environment).strip(), self.version())
        flags = run("pkg-config", "--cflags", "--libs", "fencepost", env=environment).split()
        program = self.root / "by_pkg_config"
        run(CXX, "-std=c++11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", HERE / "consumer/main.cpp", HERE / "consumer/pretend.cpp", *flags, "-o", program)
        self.expect_a_stop(program)

    def test_desk_library_replays_as_the_program(self):
        build = self.configured("desk")
        run(CMAKE, "--build", build)
        log = self.prefix / LOG
        mine = json.loads(run(build / "replay_a_log", log))
        theirs = json.loads(run(self.prefix / "bin/fencepost", "replay", "--json", log))
        self.assertEqual(mine["digest"], theirs["digest"])
        self.assertEqual(mine["objects"], theirs["objects"])

    def test_every_header_finds_what_it_includes(self):
        include = self.prefix / "include/fencepost"
        headers = sorted(include.rglob("*.hpp"))
        self.assertGreater(len(headers), 100)
        for header in headers:
            for name in re.findall(r'^#include "([^"]+)"', header.read_text(), re.MULTILINE):
                self.assertTrue((include / name).is_file(), f"{header}: {name}")

    def test_no_path_of_the_build_is_left(self):
        files = [f for f in self.prefix.rglob("*") if f.is_file() and f.suffix in (".cmake", ".pc", ".hpp", ".md", ".py")]
        for file in files:
            text = file.read_text(encoding="utf-8")
            self.assertFalse(SOURCE in text or BUILD in text or str(self.root) in text, file)

    def version(self):
        text = (pathlib.Path(SOURCE) / "CMakeLists.txt").read_text()
        return re.search(r"project\(fencepost VERSION ([\d.]+)", text).group(1)


class Page(unittest.TestCase):
    def test_page_shows_the_program(self):
        blocks = re.findall(r"^```cpp\n(.*?)^```$", self.page(), re.MULTILINE | re.DOTALL)
        self.assertEqual(blocks, [(HERE / "consumer/main.cpp").read_text()])

    def test_page_tells_the_sizes_of_the_header(self):
        header = (pathlib.Path(SOURCE) / "firmware/fencepost/fencepost.hpp").read_text()
        sizes = re.findall(r"struct (\w+) {\s+static constexpr std::size_t kObjects = (\d+);\s+"
                           r"static constexpr std::size_t kBytes = (\d+) \* 1024;", header)
        self.assertEqual(len(sizes), 3)
        for name, objects, kilobytes in sizes:
            self.assertIn(f"| `{name}Core` | {objects} | {kilobytes} KB |", self.page())

    @staticmethod
    def page():
        return (pathlib.Path(SOURCE) / "host/share/doc/embed.md").read_text(encoding="utf-8")


class Part(unittest.TestCase):
    """The sources as a folder of another project: the core, without the desk's libraries and our warnings."""

    def test_add_subdirectory(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            text = (HERE / "consumer/CMakeLists.txt").read_text()
            text = text.replace("find_package(Fencepost REQUIRED)", f'add_subdirectory("{SOURCE}" fencepost EXCLUDE_FROM_ALL)')
            (root / "CMakeLists.txt").write_text(text)
            for file in ("main.cpp", "pretend.cpp"):
                shutil.copy(HERE / "consumer" / file, root)
            absent = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{p}=ON" for p in ("CLI11", "fmt", "nlohmann_json", "Ceres", "GTest")]
            run(CMAKE, "-S", root, "-B", root / "build", f"-DCMAKE_CXX_COMPILER={CXX}", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *absent)
            commands = json.loads((root / "build/compile_commands.json").read_text())
            mine = [c["command"] for c in commands if c["file"].endswith("main.cpp") and str(root / "main.cpp") == c["file"]]
            self.assertEqual(len(mine), 1)
            self.assertNotRegex(mine[0], r"\s-W")
            self.assertFalse([c for c in commands if "/host/" in c["file"] or "/boards/" in c["file"]])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
