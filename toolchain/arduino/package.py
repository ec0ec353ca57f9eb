#!/usr/bin/env python3
"""usage: package.py SOURCE_FOLDER OUT_FOLDER [--from-source]

Writes Fencepost-VERSION.zip, the library for Arduino and PlatformIO: the core's sources, one file a room, so that they
compile within a minute. Unless --from-source, it also has them compiled for the Cortex-M0+, M4, M7 and M33.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time
import zipfile

import check

HERE = pathlib.Path(__file__).parent
ROOTS = [f"firmware/fencepost/{name}.cpp" for name in ("convert", "interface", "micro", "plain", "small")]
INCLUDE = re.compile(r'^#include "([^"]+)"', re.MULTILINE)
FLAGS = ["-std=gnu++20", "-Os", "-mthumb", "-fno-exceptions", "-fno-rtti", "-fno-threadsafe-statics", "-ffp-contract=off",
         "-ffunction-sections", "-fdata-sections", "-fno-asynchronous-unwind-tables", "-DNDEBUG"]
# The folder is Arduino's {build.mcu}/{build.fpu}-{build.float-abi}.
PARTS = {
    "cortex-m0plus": ["-mcpu=cortex-m0plus", "-mfloat-abi=soft"],
    "cortex-m4/fpv4-sp-d16-hard": ["-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16", "-mfloat-abi=hard"],
    "cortex-m4/fpv4-sp-d16-softfp": ["-mcpu=cortex-m4", "-mfpu=fpv4-sp-d16", "-mfloat-abi=softfp"],
    "cortex-m7/fpv5-d16-hard": ["-mcpu=cortex-m7", "-mfpu=fpv5-d16", "-mfloat-abi=hard"],
    "cortex-m7/fpv5-d16-softfp": ["-mcpu=cortex-m7", "-mfpu=fpv5-d16", "-mfloat-abi=softfp"],
    "cortex-m33/fpv5-sp-d16-hard": ["-mcpu=cortex-m33", "-mfpu=fpv5-sp-d16", "-mfloat-abi=hard"],
    "cortex-m33/fpv5-sp-d16-softfp": ["-mcpu=cortex-m33", "-mfpu=fpv5-sp-d16", "-mfloat-abi=softfp"],
}
TOO_OLD = """// Above all sources: what they need.
#if __cplusplus < 201709L
#error "Fencepost is compiled as C++20: put compiler.cpp.extra_flags=-std=gnu++20 into the board's platform.local.txt; README.md"
#endif
#if defined(__FAST_MATH__)
#error "Fencepost's results are checked without the compiler's fast mathematics: leave that option out"
#endif
#pragma GCC optimize("fp-contract=off")
"""


def sources_of(root):
    """(headers, sources) that the library needs, by their paths: what is included, and what defines what is declared there."""
    headers, sources = set(), set(ROOTS)
    first_include = {}
    for layer in ("hal", "drivers", "firmware"):
        for path in (root / layer).rglob("*.cpp"):
            if path.is_relative_to(root / "hal/mcu"):
                continue  # a board has a start-up of its own
            match = INCLUDE.search(path.read_text(encoding="utf-8"))
            if match:
                first_include.setdefault(match.group(1), []).append(path.relative_to(root).as_posix())
    waiting = list(ROOTS)
    while waiting:
        file = waiting.pop()
        for name in INCLUDE.findall((root / file).read_text(encoding="utf-8")):
            beside = f"{os.path.dirname(file)}/{name}"
            header = name if (root / name).is_file() else beside
            if header in headers:
                continue
            headers.add(header)
            waiting.append(header)
            new = [s for s in first_include.get(header, []) if s not in sources and not s.startswith("firmware/fencepost/")]
            sources.update(new)
            waiting += new
    return sorted(headers), sorted(sources)


def room_of(source):
    return "_".join(source.split("/")[:2])


def version_of(root):
    return re.search(r"project\(fencepost VERSION ([\d.]+)", (root / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)


def write_sources(root, to):
    headers, sources = sources_of(root)
    for header in headers:
        put(to / "src" / header, (root / header).read_bytes())
    rooms = {}
    for source in sources:
        # Not .cpp: Arduino compiles each of those, and would compile it again.
        name = source.removesuffix(".cpp") + ".ipp"
        put(to / "src" / name, (root / source).read_bytes())
        rooms.setdefault(room_of(source), []).append(name)
    for room, names in rooms.items():
        text = '#include "fencepost_options.h"\n\n' + "".join(f'#include "{name}"\n' for name in names)
        put(to / f"src/fencepost_{room}.cpp", text.encode())
    put(to / "src/fencepost_options.h", TOO_OLD.encode())


def write_library(root, to):
    version = version_of(root)
    for name in ("library.properties", "library.json"):
        put(to / name, (HERE / name).read_text(encoding="utf-8").replace("@VERSION@", version).encode())
    put(to / "keywords.txt", (HERE / "keywords.txt").read_bytes())
    put(to / "src/Fencepost.h", (HERE / "Fencepost.h").read_bytes())
    put(to / "README.md", (HERE / "LIBRARY.md").read_bytes())
    put(to / "LICENSE", (root / "LICENSE").read_bytes())
    put(to / "extras/embed.md", (root / "host/share/doc/embed.md").read_bytes())
    for example in sorted((HERE / "examples").rglob("*.ino")):
        put(to / example.relative_to(HERE), example.read_bytes())
    write_sources(root, to)


def compile_part(to, flags, archive, jobs=2):
    """Compiles the library as it lies in `to`; returns the seconds that it took."""
    begun = time.monotonic()
    with tempfile.TemporaryDirectory() as folder:
        objects, running = [], []
        for source in sorted((to / "src").glob("*.cpp")):
            objects.append(pathlib.Path(folder) / (source.stem + ".o"))
            # Relative paths: the bytes are the same wherever this runs.
            running.append(subprocess.Popen(["arm-none-eabi-g++", *FLAGS, *flags, "-Isrc", "-c", f"src/{source.name}", "-o", objects[-1]], cwd=to))
            while len([p for p in running if p.poll() is None]) >= jobs:
                time.sleep(0.05)
        if any(p.wait() != 0 for p in running):
            raise SystemExit(f"package.py: {archive.parent} was not compiled")
        archive.parent.mkdir(parents=True, exist_ok=True)
        subprocess.run(["arm-none-eabi-ar", "rcsD", archive, *objects], check=True)
    return time.monotonic() - begun


def write_zip(folder, name, file):
    when = time.gmtime(max(int(os.environ.get("SOURCE_DATE_EPOCH", "315532800")), 315532800))[:6]
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for path in sorted(p for p in folder.rglob("*") if p.is_file()):
            info = zipfile.ZipInfo(f"{name}/{path.relative_to(folder).as_posix()}", when)
            info.external_attr = 0o644 << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, path.read_bytes())


def put(path, data):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_bytes(data)


def main():
    words = [w for w in sys.argv[1:] if not w.startswith("-")]
    if len(words) != 2:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    root, out = pathlib.Path(words[0]).resolve(), pathlib.Path(words[1])
    out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        library = pathlib.Path(folder) / "Fencepost"
        write_library(root, library)
        if "--from-source" not in sys.argv:
            for part, flags in PARTS.items():
                seconds = compile_part(library, flags, library / "src" / part / "libFencepost.a")
                print(f"{part}: {seconds:.0f} s", file=sys.stderr)
        faults = check.faults_of(library)
        for fault in faults:
            print(fault, file=sys.stderr)
        if faults:
            return 1
        file = out / f"Fencepost-{version_of(root)}.zip"
        write_zip(library, "Fencepost", file)
    print(file)
    return 0


if __name__ == "__main__":
    sys.exit(main())
