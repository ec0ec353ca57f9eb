#!/usr/bin/env python3
"""usage: wheel.py SOURCE_FOLDER BUILD_FOLDER OUT_FOLDER

Writes the Python wheel of what is built in BUILD_FOLDER: package, shared library, program, recordings and page.
The libraries that other systems may lack go along where the program looks for them beside itself (preset `wheel`).
The tag is manylinux then, by the newest symbols that anything inside asks for. Else it is that of this machine alone.
"""

import base64
import hashlib
import os
import pathlib
import platform
import re
import subprocess
import sys
import tempfile
import time
import zipfile

# Every system has these (PEP 600), of all that our programs link.
SYSTEM = {"libc.so.6", "libm.so.6", "libpthread.so.0", "libdl.so.2", "librt.so.1", "libgcc_s.so.1", "libstdc++.so.6",
          "ld-linux-x86-64.so.2", "ld-linux-aarch64.so.1"}
# The first glibc of systems whose libstdc++ has these symbols: GCC 11 and Fedora 35, GCC 12 and Ubuntu 22.04.
GLIBC_OF_LIBSTDCXX = {(3, 4, 28): (2, 31), (3, 4, 29): (2, 34), (3, 4, 30): (2, 35)}
BESIDE = "$ORIGIN/../lib"
INSIDE = "fencepost/_install"


def run(*command):
    return subprocess.run([str(word) for word in command], capture_output=True, text=True, check=True).stdout


def dynamic(file, tag):
    """Values of that tag in the dynamic section of a program or library."""
    return re.findall(rf"\({tag}\).*\[(.*)\]", run("readelf", "-dW", file))


def versions(file, name):
    """The versions of symbols, such as GLIBC_2.34, that a file asks for, as tuples."""
    found = re.findall(rf"\b{re.escape(name)}_(\d+(?:\.\d+)+)\b", run("readelf", "-VW", file))
    return {tuple(int(part) for part in version.split(".")) for version in found}


def needed_glibc(files):
    newest = {(2, 17)}  # of manylinux2014, the oldest that there is a reason to name
    for file in files:
        newest |= versions(file, "GLIBC")
        for version in versions(file, "GLIBCXX"):
            newest.add(next((GLIBC_OF_LIBSTDCXX[known] for known in sorted(GLIBC_OF_LIBSTDCXX) if version <= known), (99, 0)))
    glibc = max(newest)
    if glibc == (99, 0):
        raise SystemExit("wheel.py: a symbol of libstdc++ is newer than GLIBC_OF_LIBSTDCXX knows; add its row")
    return glibc


def machine_of(file):
    """As Linux calls it."""
    elf = re.search(r"Machine: *(.*)", run("readelf", "-hW", file)).group(1)
    names = {"Advanced Micro Devices X86-64": "x86_64", "AArch64": "aarch64"}
    if elf not in names:
        raise SystemExit(f"wheel.py: {file} is for {elf}; wheels are made for {' and '.join(names.values())}")
    return names[elf]


def libraries_beside(files):
    """{name: file} of the libraries that these need, and those that they need, without the system's."""
    found, waiting = {}, list(files)
    while waiting:
        file = waiting.pop()
        folder = pathlib.Path(f"/usr/lib/{machine_of(file)}-linux-gnu")
        for name in dynamic(file, "NEEDED"):
            if name in SYSTEM or name in found:
                continue
            places = [folder / name, pathlib.Path(str(folder).removeprefix("/usr")) / name]
            library = next((place.resolve() for place in places if place.is_file()), None)
            if library is None:
                raise SystemExit(f"wheel.py: {file} needs {name}, which is not in {folder}")
            found[name] = library
            waiting.append(library)
    return found


def licence_of(library):
    """Where Debian keeps it."""
    for name in (library, str(library).removeprefix("/usr")):  # where packages had it before the two were one
        done = subprocess.run(["dpkg-query", "-S", str(name)], capture_output=True, text=True, check=False)
        if done.returncode == 0:
            package = done.stdout.split(":")[0]
            return pathlib.Path("/usr/share/doc", package, "copyright")
    raise SystemExit(f"wheel.py: {library} is of no package, so its licence is not known")


def metadata(source, version):
    text = (source / "host/share/python/fencepost/__init__.py").read_text(encoding="utf-8").split('"""')[1]
    return f"""Metadata-Version: 2.1
Name: fencepost
Version: {version}
Summary: {text.splitlines()[0]}
License: MIT
Requires-Python: >=3.9
Classifier: License :: OSI Approved :: MIT License
Classifier: Operating System :: POSIX :: Linux
Classifier: Topic :: Scientific/Engineering
Classifier: Typing :: Typed
Description-Content-Type: text/plain

{text}""".encode()


def content(source, build, version, machine, beside):
    """{name in the wheel: (bytes, whether it is a program)}"""
    files = {}

    def add(name, data, program=False):
        files[name] = (data.read_bytes() if isinstance(data, pathlib.Path) else data, program)

    def stripped(file):
        with tempfile.TemporaryDirectory() as folder:
            prefix = "" if machine == platform.machine() else f"{machine}-linux-gnu-"
            run(f"{prefix}strip", "--strip-unneeded", "-o", f"{folder}/stripped", file)
            return pathlib.Path(folder, "stripped").read_bytes()

    package = source / "host/share/python/fencepost"
    for file in sorted(package.iterdir()):
        if file.suffix == ".py" or file.name == "py.typed":
            add(f"fencepost/{file.name}", file)
    add(f"{INSIDE}/bin/fencepost", stripped(build / "host/cli/fencepost"), program=True)
    add(f"{INSIDE}/lib/libfencepost.so", stripped(build / "firmware/fencepost/libfencepost.so"), program=True)
    for name, library in sorted(beside.items()):
        add(f"{INSIDE}/lib/{name}", library, program=True)
    for part in ("recordings", "schema"):
        for file in sorted((source / "host/share" / part).iterdir()):
            add(f"{INSIDE}/share/fencepost/{part}/{file.name}", file)
    add(f"{INSIDE}/share/fencepost/page/fencepost.html", source / "host/web/dist/fencepost.html")

    about = f"fencepost-{version}.dist-info"
    add(f"{about}/METADATA", metadata(source, version))
    add(f"{about}/entry_points.txt", b"[console_scripts]\nfencepost = fencepost._program:main\n")
    add(f"{about}/licenses/LICENSE", source / "LICENSE")
    for name, library in sorted(beside.items()):
        add(f"{about}/licenses/{name}.txt", licence_of(library))
    return files, about


def version_of(source):
    return re.search(r"project\(fencepost VERSION ([\d.]+)", (source / "CMakeLists.txt").read_text(encoding="utf-8")).group(1)


def write_archive(file, files):
    """`files`: {name in the archive: (data, is a program)}. The same files give the same bytes."""
    when = time.gmtime(max(int(os.environ.get("SOURCE_DATE_EPOCH", "315532800")), 315532800))[:6]
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, (data, program) in files.items():
            info = zipfile.ZipInfo(name, when)
            info.external_attr = (0o100755 if program else 0o100644) << 16
            info.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(info, data)


def write(file, files, about, tag):
    wheel = f"Wheel-Version: 1.0\nGenerator: fencepost (toolchain/wheel.py)\nRoot-Is-Purelib: false\nTag: {tag}\n"
    files = {**files, f"{about}/WHEEL": (wheel.encode(), False)}
    record = ""
    for name, (data, _) in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(data)}\n"
    files[f"{about}/RECORD"] = (f"{record}{about}/RECORD,,\n".encode(), False)
    write_archive(file, files)


def main():
    if len(sys.argv) != 4:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    source, build, out = (pathlib.Path(word).resolve() for word in sys.argv[1:])
    version = version_of(source)
    program, library = build / "host/cli/fencepost", build / "firmware/fencepost/libfencepost.so"
    system, beside = "linux", {}
    if BESIDE in dynamic(program, "RPATH"):  # not RUNPATH: what its libraries need is looked for there, too
        beside = libraries_beside([program, library])
        system = "manylinux_%d_%d" % needed_glibc([program, library, *beside.values()])
    machine = machine_of(program)
    tag = f"py3-none-{system}_{machine}"
    files, about = content(source, build, version, machine, beside)
    out.mkdir(parents=True, exist_ok=True)
    wheel = out / f"fencepost-{version}-{tag}.whl"
    write(wheel, files, about, tag)
    print(wheel)
    return 0


if __name__ == "__main__":
    sys.exit(main())
