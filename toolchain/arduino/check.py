#!/usr/bin/env python3
"""usage: check.py LIBRARY_FOLDER

The rules of Arduino's library registry, as far as they can be checked without the network. Prints one line per fault;
exit status 1 if there is any.
"""

import json
import pathlib
import re
import sys

REQUIRED = ["name", "version", "author", "maintainer", "sentence", "paragraph", "category", "url", "architectures"]
OPTIONAL = ["depends", "dot_a_linkage", "includes", "precompiled", "ldflags", "license"]
CATEGORIES = ["Display", "Communication", "Signal Input/Output", "Sensors", "Device Control", "Timing", "Data Storage",
              "Data Processing", "Other"]
VERSION = re.compile(r"(?:0|[1-9]\d*)\.(?:0|[1-9]\d*)\.(?:0|[1-9]\d*)(?:-[0-9A-Za-z.-]+)?(?:\+[0-9A-Za-z.-]+)?")
NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9 _.-]*")
FILE = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_.-]*")
MOST_BYTES = 32 * 1024 * 1024
KINDS = {"KEYWORD1", "KEYWORD2", "KEYWORD3", "LITERAL1", "LITERAL2"}


def read_properties(file):
    """{field: value}, and the faults of its lines"""
    fields, faults = {}, []
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        field, equals, value = line.partition("=")
        if not equals or field in fields:
            faults.append(f"library.properties:{number}: not a new field=value")
        fields[field] = value.strip()
    return fields, faults


def faults_of_fields(root, fields):
    for field in REQUIRED:
        if not fields.get(field):
            yield f"library.properties: {field} is missing"
    for field in fields:
        if field not in REQUIRED + OPTIONAL:
            yield f"library.properties: no field is called {field}"
    name = fields.get("name", "")
    if not NAME.fullmatch(name) or len(name) > 63:
        yield f"library.properties: name '{name}' has characters that it may not, or too many"
    if re.search("arduino|library", name, re.IGNORECASE):
        yield f"library.properties: name '{name}' says arduino or library"
    if not VERSION.fullmatch(fields.get("version", "")):
        yield f"library.properties: version '{fields.get('version')}' is not MAJOR.MINOR.PATCH"
    if "arduino" in fields.get("maintainer", "").lower():
        yield "library.properties: maintainer says arduino"
    if fields.get("category") not in CATEGORIES:
        yield f"library.properties: category '{fields.get('category')}' is none of {', '.join(CATEGORIES)}"
    if not re.match(r"https?://", fields.get("url", "")):
        yield "library.properties: url is no address"
    if not re.fullmatch(r"\*|[a-z0-9_]+(?:,[a-z0-9_]+)*", fields.get("architectures", "")):
        yield f"library.properties: architectures '{fields.get('architectures')}' is no list"
    if fields.get("paragraph", "").startswith(fields.get("sentence", "-")):
        yield "library.properties: paragraph repeats sentence, which is shown before it"
    if fields.get("precompiled", "full") not in ("full", "true"):
        yield f"library.properties: precompiled is '{fields['precompiled']}'"
    for header in filter(None, fields.get("includes", "").split(",")):
        if not (root / "src" / header).is_file():
            yield f"library.properties: includes names {header}, which is not in src"


def faults_of_files(root):
    size = 0
    for path in sorted(root.rglob("*")):
        name = path.relative_to(root).as_posix()
        if path.is_symlink():
            yield f"{name}: a link"
        elif path.is_file():
            size += path.stat().st_size
        if path.suffix.lower() in (".exe", ".bat", ".dll", ".pde"):
            yield f"{name}: nothing of this kind may be in there"
        if not FILE.fullmatch(path.name):
            yield f"{name}: characters that a file may not have"
        if path.is_dir() and path.name in (".git", "utility", "example", "extra") or path.name in (".development", ".gitmodules"):
            yield f"{name}: nothing of this name may be in there"
    if size > MOST_BYTES:
        yield f"{size} bytes: at most {MOST_BYTES}"
    for name in ("LICENSE", "README.md", "keywords.txt", "src"):
        if not (root / name).exists():
            yield f"{name} is missing"
    if not list((root / "src").glob("*.h")):
        yield "src: no header in it"
    for name in ("Library.properties", "library.Properties", "Examples"):
        if name in [p.name for p in root.iterdir()]:
            yield f"{name}: its letters' case is wrong"


def faults_of_examples(root):
    folders = sorted(p for p in (root / "examples").glob("*") if p.is_dir())
    if not folders:
        yield "examples: there is none"
    for folder in folders:
        if not (folder / f"{folder.name}.ino").is_file():
            yield f"examples/{folder.name}: no sketch of its name"
        if len(folder.name) > 63:
            yield f"examples/{folder.name}: the name is too long"


def faults_of_keywords(root):
    for number, line in enumerate((root / "keywords.txt").read_text(encoding="utf-8").splitlines(), 1):
        if line and not line.startswith("#") and (len(line.split("\t")) < 2 or line.split("\t")[1] not in KINDS):
            yield f"keywords.txt:{number}: not a word, one tab, and one of {', '.join(sorted(KINDS))}"


def faults_of_manifest(root, fields):
    """PlatformIO's, which has to say the same."""
    try:
        manifest = json.loads((root / "library.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        yield f"library.json: {error}"
        return
    for field in ("name", "version"):
        if manifest.get(field) != fields.get(field):
            yield f"library.json: {field} is not that of library.properties"
    for example in manifest.get("examples", []):
        for file in example["files"]:
            if not (root / example["base"] / file).is_file():
                yield f"library.json: there is no {example['base']}/{file}"


def faults_of(root):
    root = pathlib.Path(root)
    if not (root / "library.properties").is_file():
        return ["library.properties is missing"]
    fields, faults = read_properties(root / "library.properties")
    faults += list(faults_of_fields(root, fields)) + list(faults_of_files(root)) + list(faults_of_examples(root))
    if (root / "keywords.txt").is_file():
        faults += list(faults_of_keywords(root))
    return faults + list(faults_of_manifest(root, fields))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        print(__doc__.strip(), file=sys.stderr)
        sys.exit(2)
    FOUND = faults_of(sys.argv[1])
    print("\n".join(FOUND + [f"{len(FOUND)} faults"]))
    sys.exit(1 if FOUND else 0)
