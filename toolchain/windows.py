#!/usr/bin/env python3
"""usage: windows.py SOURCE_FOLDER BUILD_FOLDER OUT_FOLDER

Writes fencepost-VERSION-windows.zip of what the preset `windows` has built: the program, what it reads, licence and README.
"""

import pathlib
import re
import subprocess
import sys

from wheel import version_of, write_archive

STRIP = "x86_64-w64-mingw32-strip"
SHARE = ("recordings", "blocks", "schema", "examples", "doc")
PAGE = "host/web/dist/fencepost.html"
README = "host/share/doc/windows.md"


def content(source, build, out):
    """{name in the archive: file}"""
    program = out / "fencepost.exe"
    subprocess.run([STRIP, "--preserve-dates", "-o", str(program), str(build / "host/cli/fencepost.exe")], check=True)
    readme = out / "README.md"
    readme.write_text(re.sub(r"\]\((\w+\.md)", r"](share/fencepost/doc/\1", (source / README).read_text(encoding="utf-8")), encoding="utf-8")
    files = {"fencepost.exe": program, "LICENSE.txt": source / "LICENSE", "README.md": readme,
             f"share/fencepost/page/{pathlib.Path(PAGE).name}": source / PAGE}
    for folder in SHARE:
        top = source / "host/share"
        for file in sorted((top / folder).rglob("*")):
            if file.is_file() and "__pycache__" not in file.parts:
                files[f"share/fencepost/{file.relative_to(top).as_posix()}"] = file
    return files


def main():
    if len(sys.argv) != 4:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    source, build, out = (pathlib.Path(word).resolve() for word in sys.argv[1:])
    version = version_of(source)
    out.mkdir(parents=True, exist_ok=True)
    files = content(source, build, out)
    archive = out / f"fencepost-{version}-windows.zip"
    write_archive(archive, {f"fencepost-{version}/{name}": (file.read_bytes(), name.endswith(".exe"))
                            for name, file in files.items()})
    for made in ("fencepost.exe", "README.md"):
        files[made].unlink()
    print(archive)
    return 0


if __name__ == "__main__":
    sys.exit(main())
