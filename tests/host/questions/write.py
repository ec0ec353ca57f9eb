"""Renews every document of this folder's and of tests/host/devices' tests: python3 write.py BUILD [CXX], from the top of the sources.

devices.md (of BUILD's devices_test, where that was built), the pages of the sensors, questions.md, segment.md, the three paths, the README's demo (its picture:
tests/host/web/picture_test.mjs --write). The engineer's path installs what BUILD has built, which has to be whole for it. Read the difference afterwards.
"""

import os
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SOURCES = HERE.parents[2]
PAGES = ("host/share/doc/devices.md", "tests/results/devices.csv", "tests/host/devices/facts.txt")


def python(script, *arguments):
    subprocess.run([sys.executable, "-B", script, *(str(a) for a in arguments), "--write"], check=True)


def write_demo(program, folder):
    """README.md's five lines of `fencepost demo`, which commands_test compares."""
    said = subprocess.run([program, "demo", "-o", Path(folder) / "demo.html"], check=True, capture_output=True, text=True).stdout
    shown = "".join(("    " + line if line else "") + "\n" for line in said.splitlines()[:5])
    readme = SOURCES / "README.md"
    text = readme.read_text(encoding="utf-8")
    renewed, found = re.subn(r"(?:^ {4} +\d+\.\d{3} s  .*\n){5}", lambda _: shown, text, count=1, flags=re.MULTILINE)
    assert found, "README.md shows no demo"
    readme.write_text(renewed, encoding="utf-8")


def main(build, compiler="c++"):
    program = build / "host/cli/fencepost"
    with tempfile.TemporaryDirectory() as folder:
        catalogue = build / "tests/host/devices/devices_test"
        if catalogue.exists():
            subprocess.run([catalogue, "--gtest_brief=1", "--gtest_filter=Catalogue.The*ShowIt:Catalogue.The*ShowsIt"], cwd=folder, check=False)
        for page in PAGES:
            if (Path(folder) / page).exists():
                shutil.copyfile(Path(folder) / page, SOURCES / page)
        python(HERE.parent / "devices/sensor_pages.py", SOURCES)
        python(HERE / "questions.py", program, SOURCES, Path(folder) / "questions")
        write_demo(program, folder)
        python(HERE.parent / "cli/document.py", program, SOURCES, "segment.md")
        python(HERE / "paths.py", program, SOURCES, build, compiler, "student", "teacher", "engineer")


os.chdir(SOURCES)
main(Path(sys.argv[1]).resolve(), *sys.argv[2:])
