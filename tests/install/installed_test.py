#!/usr/bin/env python3
"""usage: installed_test.py CMAKE CC CXX BUILD_FOLDER SOURCE_FOLDER

Installs what has been built into a folder, moves it, and uses it as others do: the program, find_package, pkg-config.
They do it from C++, C and, where a JDK is installed, Java.
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

CMAKE, CC, CXX, BUILD, SOURCE = sys.argv[1:6]
HERE = pathlib.Path(__file__).parent
WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
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
            f"-DCMAKE_C_COMPILER={CC}", "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *more)
        return build

    def flags_of_pkg_config(self, *more):
        environment = {**os.environ, "PKG_CONFIG_PATH": str(next(self.prefix.glob("lib*/**/pkgconfig")))}
        self.assertEqual(run("pkg-config", "--modversion", "fencepost", env=environment).strip(), self.version())
        return run("pkg-config", "--cflags", "--libs", *more, "fencepost", env=environment).split()

    def shared_library(self):
        return next(self.prefix.glob("lib*/**/libfencepost.so"))

    def expect_a_stop(self, program, page=True):
        said = run(*([program] if isinstance(program, pathlib.Path) else program)).splitlines()
        levels = [line.split()[0] for line in said[:-1]]
        self.assertEqual(list(dict.fromkeys(levels))[:3], ["NOTICE", "WARN", "STOP"], said)
        self.assertRegex(said[-1], r"^0\.[23]\d m before the box$")
        if not page:
            return
        path = (pathlib.Path(SOURCE) / "host/share/doc/path_engineer.md").read_text(encoding="utf-8")
        shown = re.findall(r"^    ((?:NOTICE|WARN|STOP) +signature 1 .*)$", path, re.MULTILINE)
        self.assertGreater(len(shown), 5)
        self.assertEqual([line for line in shown if line not in said], [])

    def test_program_runs_with_what_it_reads(self):
        program = self.prefix / "bin/fencepost"
        environment = {name: value for name, value in os.environ.items() if name != "FENCEPOST_SHARE"}
        said = run(program, "demo", "-o", self.root / "demo.html", env=environment, cwd=self.root)
        self.assertIn("STOP    red", said)
        for file in ("doc/embed.md", "schema/result.schema.json", "python/fencepost/stream.py", LOG[16:]):
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
        self.assertNotRegex(command, r"\s-[Wf]")

    def test_core_needs_no_other_package(self):
        absent = [f"-DCMAKE_DISABLE_FIND_PACKAGE_{p}=ON" for p in ("fmt", "nlohmann_json")]
        command = run(CMAKE, "--build", self.configured("consumer", *absent), "--clean-first", "-v")
        self.assertNotIn("include/eigen3", command)

    def test_pkg_config(self):
        program = self.root / "by_pkg_config"
        run(CXX, "-std=c++11", *WARNINGS, HERE / "consumer/main.cpp", HERE / "consumer/pretend.cpp", *self.flags_of_pkg_config(), "-o", program)
        self.expect_a_stop(program)

    def test_c_by_find_package(self):
        build = self.configured("c")
        run(CMAKE, "--build", build)
        self.expect_a_stop(build / "stop", page=False)

    def test_c_by_pkg_config(self):
        program = self.root / "c_by_pkg_config"
        run(CC, "-std=c11", *WARNINGS, HERE / "c/main.c", HERE / "c/pretend.c", *self.flags_of_pkg_config("--static"), "-o", program)
        self.expect_a_stop(program, page=False)

    def test_a_forgotten_answer_is_a_warning(self):
        source = self.root / "forgets.cpp"
        source.write_text("#include <fencepost/fencepost.hpp>\nvoid f(fencepost::SmallCore& c) { c.odometry(0, {0, 0, 0}); }\n")
        for standard in ("c++11", "c++20"):
            done = subprocess.run([CXX, f"-std={standard}", "-c", f"-I{self.prefix / 'include'}", source, "-o", os.devnull],
                                  capture_output=True, text=True, check=True)
            self.assertIn("warn_unused_result" if standard == "c++11" else "nodiscard", done.stderr)

    def test_java(self):
        compiler = shutil.which("javac")
        if compiler is None:
            self.skipTest("no JDK: Java's use of the C interface is not tested")
        jdk, example = pathlib.Path(compiler).resolve().parents[1], self.prefix / "share/fencepost/examples/java"
        library = self.shared_library().parent
        run(CC, "-shared", "-fPIC", "-Wall", "-Werror", f"-I{jdk}/include", f"-I{jdk}/include/linux", f"-I{self.prefix}/include",
            example / "fencepost_jni.c", f"-L{library}", "-lfencepost", f"-Wl,-rpath,{library}", "-o", self.root / "libfencepost_jni.so")
        run(compiler, "-Xlint:all", "-Werror", "-d", self.root, example / "Fencepost.java", example / "Stop.java")
        self.expect_a_stop([shutil.which("java"), "-Xcheck:jni", f"-Djava.library.path={self.root}", "-cp", self.root, "Stop"], page=False)

    def test_desk_library_replays_as_the_program(self):
        build = self.configured("desk")
        run(CMAKE, "--build", build)
        log = self.prefix / LOG
        mine = json.loads(run(build / "replay_a_log", log))
        theirs = json.loads(run(self.prefix / "bin/fencepost", "replay", "--json", log))
        self.assertEqual(mine["digest"], theirs["digest"])
        self.assertEqual(mine["objects"], theirs["objects"])

    def test_installed_headers_are_public_and_need_no_other(self):
        include = self.prefix / "include"
        headers = sorted(f.relative_to(include).as_posix() for f in include.rglob("*") if f.is_file())
        self.assertEqual(headers, ["fencepost/fencepost.h", "fencepost/fencepost.hpp", "fencepost/replay.hpp"])
        for header, compiler in (("fencepost.h", [CC, "-std=c99"]), ("fencepost.h", [CC, "-std=c2x"]), ("fencepost.h", [CXX, "-std=c++11"]),
                                 ("fencepost.hpp", [CXX, "-std=c++11"]), ("replay.hpp", [CXX, "-std=c++17"])):
            source = self.root / ("alone.c" if compiler[0] == CC else "alone.cpp")
            source.write_text(f"#include <fencepost/{header}>\n")
            run(*compiler, *WARNINGS, "-fsyntax-only", f"-I{include}", source)

    def test_no_path_of_the_build_is_left(self):
        files = [f for f in self.prefix.rglob("*") if f.is_file() and f.suffix in (".cmake", ".pc", ".h", ".hpp", ".md", ".py")]
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
        shown = re.findall(r"^    (.*(?:memory\[|fencepost_init).*)$", self.page(), re.MULTILINE)
        self.assertEqual(len(shown), 2)
        for line in shown:
            self.assertIn(f"  {line}\n", (HERE / "c/main.c").read_text())

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
            self.assertNotRegex(mine[0], r"\s-[Wf]")
            self.assertFalse([c for c in commands if "/host/" in c["file"] or "/boards/" in c["file"]])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
