#!/usr/bin/env python3
"""usage: demo_install_test.py CMAKE SOURCE_FOLDER

Whatever `cmake --install` takes after `toolchain/demo` is among what that command builds, and likewise with FENCEPOST_LAB.
Nothing is compiled: files stand for what the build would leave.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

CMAKE, SOURCE = sys.argv[1:3]
PROGRAMS = ("host/cli/fencepost", "host/cli/fencepost-lab")


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, cwd=SOURCE)
    if done.returncode != 0:
        sys.exit(f"{command}\nexit {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def built(build, targets):
    """Files that these targets make, themselves included. Their inputs also name the system's files, which stay out."""
    ninja = ("ninja", "-C", build, "-t")
    names = run(*ninja, "inputs", *targets).split() + run(*ninja, "query", *targets).split()
    within = [name for name in names if (build / name).resolve().is_relative_to(build.resolve())]
    return [name for name in within if name in PROGRAMS or ".so" in name or name.endswith(".a")]


def install(folder, lab):
    presets = json.loads((pathlib.Path(SOURCE) / "CMakePresets.json").read_text())["buildPresets"]
    targets = next(preset["targets"] for preset in presets if preset["name"] == "demo")
    build, prefix = folder / "build", folder / "prefix"
    run(CMAKE, "--preset", "demo", "-B", build, "-Wno-dev", f"-DFENCEPOST_LAB={lab}")
    for name in built(build, targets):
        (build / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy("/bin/true", build / name)
    for library in build.rglob("lib*.so.*.*.*"):
        library.with_suffix("").touch()  # the link of its soname
    made = build / "host/cli/made"  # by the program itself, when it is linked
    (made / "man1").mkdir(parents=True)
    for name in ("man1/fencepost.1.gz", "fencepost", "_fencepost", "fencepost.fish"):
        (made / name).touch()
    run(CMAKE, "--install", build, "--prefix", prefix)
    assert (prefix / "bin/fencepost").is_file()
    return prefix


def main():
    with tempfile.TemporaryDirectory() as folder:
        prefix = install(pathlib.Path(folder), "OFF")
        assert not list(prefix.rglob("*.hpp")), "headers without their library"
    with tempfile.TemporaryDirectory() as folder:
        prefix = install(pathlib.Path(folder), "ON")
        assert (prefix / "libexec/fencepost/fencepost-lab").is_file()
        assert len(list(prefix.rglob("libfencepost_*.a"))) == 2, "the libraries of the headers"


main()
