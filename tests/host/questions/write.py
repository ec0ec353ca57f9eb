"""Renews every document of this folder's and of tests/host/devices' tests: python3 write.py BUILD [CXX], from the top of the sources.

devices.md (of BUILD's devices_test, where that was built), the pages of the sensors, questions.md, segment.md, the three paths, the README's picture. The
engineer's path installs what BUILD has built, which has to be whole for it. Read the difference afterwards.
"""

import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
SOURCES = HERE.parents[2]


def python(script, *arguments):
    subprocess.run([sys.executable, "-B", script, *(str(a) for a in arguments), "--write"], check=True)


def main(build, compiler="c++"):
    program = build / "host/cli/fencepost"
    with tempfile.TemporaryDirectory() as folder:
        catalogue = build / "tests/host/devices/devices_test"
        if catalogue.exists():
            subprocess.run([catalogue, "--gtest_brief=1", "--gtest_filter=Catalogue.TheDocumentShowsIt"], cwd=folder, check=False)
        written = Path(folder) / "devices.md"
        if written.exists():
            shutil.copyfile(written, SOURCES / "host/share/doc/devices.md")
        python(HERE.parent / "devices/sensor_pages.py", SOURCES)
        python(HERE / "questions.py", program, SOURCES, Path(folder) / "questions")
        python(HERE / "picture.py", program, SOURCES)
        python(HERE.parent / "cli/document.py", program, SOURCES, "segment.md")
        python(HERE / "paths.py", program, SOURCES, build, compiler, "student", "teacher", "engineer")


os.chdir(SOURCES)
main(Path(sys.argv[1]).resolve(), *sys.argv[2:])
