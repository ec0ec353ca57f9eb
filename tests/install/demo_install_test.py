#!/usr/bin/env python3
"""usage: demo_install_test.py CMAKE SOURCE_FOLDER

Whatever `cmake --install` takes after `toolchain/demo` is among what that command builds. Nothing is compiled: files stand
for what the build would leave.
"""

import json
import pathlib
import shutil
import subprocess
import sys
import tempfile

CMAKE, SOURCE = sys.argv[1:3]


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, cwd=SOURCE)
    if done.returncode != 0:
        sys.exit(f"{command}\nexit {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


def main():
    presets = json.loads((pathlib.Path(SOURCE) / "CMakePresets.json").read_text())["buildPresets"]
    targets = next(preset["targets"] for preset in presets if preset["name"] == "demo")
    with tempfile.TemporaryDirectory() as folder:
        build, prefix = pathlib.Path(folder) / "build", pathlib.Path(folder) / "prefix"
        run(CMAKE, "--preset", "demo", "-B", build, "-Wno-dev")
        built = run("ninja", "-C", build, "-t", "inputs", *targets).split()
        libraries = [name for name in built if name.endswith(".a")]
        assert libraries, built
        for name in libraries:
            (build / name).parent.mkdir(parents=True, exist_ok=True)
            (build / name).touch()
        (build / "host/cli").mkdir(parents=True, exist_ok=True)
        shutil.copy("/bin/true", build / "host/cli/fencepost")
        made = build / "host/cli/made"  # by the program itself, when it is linked
        (made / "man1").mkdir(parents=True)
        for name in ("man1/fencepost.1.gz", "fencepost", "_fencepost", "fencepost.fish"):
            (made / name).touch()
        run(CMAKE, "--install", build, "--prefix", prefix)
        assert (prefix / "bin/fencepost").is_file()
        assert not list(prefix.rglob("*.hpp")), "headers without their library"


main()
