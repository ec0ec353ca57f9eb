#!/usr/bin/env python3
"""usage: windows.py SOURCE_FOLDER BUILD_FOLDER OUT_FOLDER

Writes fencepost-VERSION-windows.zip of what the preset `windows` has built: the program, what it reads, licence and README.
"""

import os
import pathlib
import re
import subprocess
import sys
import time
import zipfile

STRIP = "x86_64-w64-mingw32-strip"
SHARE = ("recordings", "blocks", "schema", "examples", "doc")
PAGE = "host/web/dist/fencepost.html"
README = "host/share/doc/windows.md"


def content(source, build, out):
    """{name in the archive: file}"""
    program = out / "fencepost.exe"
    subprocess.run([STRIP, "-o", str(program), str(build / "host/cli/fencepost.exe")], check=True)
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
    version = re.search(r"project\(fencepost VERSION ([\d.]+)", (source / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)
    out.mkdir(parents=True, exist_ok=True)
    files = content(source, build, out)
    when = time.gmtime(max(int(os.environ.get("SOURCE_DATE_EPOCH", "315532800")), 315532800))[:6]
    archive = out / f"fencepost-{version}-windows.zip"
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED) as packed:
        for name, file in files.items():
            info = zipfile.ZipInfo(f"fencepost-{version}/{name}", when)
            info.external_attr = (0o100755 if name.endswith(".exe") else 0o100644) << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            packed.writestr(info, file.read_bytes())
    for made in ("fencepost.exe", "README.md"):
        files[made].unlink()
    print(archive)
    return 0


if __name__ == "__main__":
    sys.exit(main())
