#!/usr/bin/env python3
"""usage: same_bytes_check.py SOURCE WORK [--plant]

The same sources make the same bytes in any folder. Builds the start-up code of one board in two copies of the robot's
sources and compares the object files, debug information included. `toolchain/long images` does that with whole releases.
--plant: without the compiler's flags that keep the folders out.
"""

import pathlib
import re
import shutil
import subprocess
import sys

PRESET, TARGET = "gba", "fencepost_board_gba"
PARTS = ("CMakeLists.txt", "CMakePresets.json", "hal", "drivers", "firmware", "toolchain")
FOLDERS = ("a", "another/folder")
FLAG = re.compile(r"-ffile-prefix-map=\S+ ")


def objects(source, folder, plant):
    """{name: bytes} of what one copy makes."""
    for part in PARTS:
        copy = shutil.copytree if (source / part).is_dir() else shutil.copyfile
        (folder / part).parent.mkdir(parents=True, exist_ok=True)
        copy(source / part, folder / part)
    if plant:
        flags = folder / "toolchain/cmake/arm-none-eabi.cmake"
        text, count = FLAG.subn("", flags.read_text())
        if count == 0:
            sys.exit("same_bytes_check: there are no flags to take away")
        flags.write_text(text)
    for command in (["cmake", "--preset", PRESET], ["cmake", "--build", f"build/{PRESET}", "--target", TARGET]):
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            sys.exit(f"same_bytes_check: {' '.join(command)} failed:\n{done.stdout}{done.stderr}")
    build = folder / "build" / PRESET
    return {path.relative_to(build).as_posix(): path.read_bytes() for path in build.rglob("*.obj")}


def main():
    if len(sys.argv) not in (3, 4) or sys.argv[3:] not in ([], ["--plant"]):
        sys.exit(__doc__.strip())
    source, work = (pathlib.Path(argument).absolute() for argument in sys.argv[1:3])
    shutil.rmtree(work, ignore_errors=True)
    first, second = (objects(source, work / folder, len(sys.argv) == 4) for folder in FOLDERS)
    different = sorted(name for name in {*first, *second} if first.get(name) != second.get(name))
    print(*different, sep="\n", end="\n" if different else "")
    print(f"{len(first)} objects, {len(different)} differ")
    return 1 if different or not first else 0


if __name__ == "__main__":
    sys.exit(main())
