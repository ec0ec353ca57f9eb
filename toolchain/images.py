#!/usr/bin/env python3
"""usage: images.py SOURCE BUILD OUT VERSION

Builds the image of every board. OUT gets fencepost-VERSION-BOARD.KIND, a page that says what to do with them,
SHA256SUMS, and the guide to a first alert with its drawings and examples. fencepost-boards.html is the page with all
images inside. Former contents of OUT are deleted, if they came from here.
"""

import base64
import gzip
import hashlib
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys

KINDS = ("uf2", "hex", "bin", "dfu", "gba", "elf")
DOCUMENT = "host/share/doc/boards.md"
GUIDE = "host/share/doc/FIRST_ALERT.md"
EXAMPLES = "host/share/examples"
WEB_PAGE = "host/web/dist/fencepost.html"
WEB_PLACE = "<!-- given -->"  # a copy of the page has its own data there
SUMS = "SHA256SUMS"
ROW = re.compile(r"\| `(\w+)` \|")  # of a board, in a table of boards
PICTURE = re.compile(r"(!\[[^\]]*\]\()([^)]+)\)")
PAGE = re.compile(r"(\[[^\]]*\]\()([^):]+\.md)\)")
STYLE = """body { font: 16px/1.5 sans-serif; max-width: 60em; margin: 2em auto; padding: 0 1em; color: #222; background: #fff }
table { border-collapse: collapse; margin: 1em 0; display: block; overflow-x: auto }
th, td { border: 1px solid #bbb; padding: .3em .6em; text-align: left; vertical-align: top }
thead th:empty { border: 0; padding: 0 } code, pre { background: #f1f1f1 } pre { padding: .6em; overflow-x: auto } img { max-width: 100% }
"""


class Fault(Exception):
    """The fault, and what to try."""


def boards(presets):
    """Presets that have their board's name: one that sets FENCEPOST_BOARD to another's is a variant of that."""
    by_name = {preset["name"]: preset for preset in presets["configurePresets"]}

    def board_of(preset):
        own = preset.get("cacheVariables", {}).get("FENCEPOST_BOARD")
        parents = preset.get("inherits", [])
        for parent in [parents] if isinstance(parents, str) else parents:
            own = own or board_of(by_name[parent])
        return own

    return [name for name, preset in by_name.items() if board_of(preset) == name]


def sections(text):
    """(what stands before the first, {board: its section}): each begins with `## ` and the preset's name in backticks."""
    head, *rest = re.split(r"^(?=## `)", text, flags=re.MULTILINE)
    return head, {re.match(r"## `(\w+)`", part).group(1): part for part in rest}


def table_of_boards(text):
    """The one that says in what each board was tested."""
    match = re.search(r"^\| preset \| board \|.*\n(?:\|.*\n)+", text, re.MULTILINE)
    if not match:
        raise Fault(f"{DOCUMENT} has no table that begins with | preset | board |")
    return match.group()


def page(text, version, collected):
    """The document of these boards alone, with the version; `collected`: {board: [file names]}."""
    head, parts = sections(text)
    rows = [row.group(1) for line in table_of_boards(head).splitlines() if (row := ROW.match(line))]
    missing = sorted(set(collected) - set(rows))
    if missing:
        raise Fault(f"{DOCUMENT}: the table of boards has no row for {', '.join(missing)}")
    missing = sorted(set(collected) - set(parts))
    if missing:
        raise Fault(f"{DOCUMENT} has no section for {', '.join(missing)}: say there what goes where")
    of_all = re.findall(r"^\| `\.(\w+)` \|", head, re.MULTILINE)  # kinds of files that the head explains
    for board, files in collected.items():
        named = set(re.findall(rf"fencepost-VERSION-{board}\.\w+", parts[board]))
        there = {name.replace(f"-{version}-", "-VERSION-", 1) for name in files}
        if named - there:
            raise Fault(f"{DOCUMENT} names {', '.join(sorted(named - there))}, which was not built: "
                        "toolchain/setup firmware installs what makes it")
        unexplained = sorted(name for name in there - named if pathlib.PurePath(name).suffix[1:] not in of_all)
        if unexplained:
            raise Fault(f"{DOCUMENT} does not say what {', '.join(unexplained)} is for")
    rows = [line for line in head.splitlines() if not (row := ROW.match(line)) or row.group(1) in collected]
    return "\n".join([*rows, "", ""]).replace("VERSION", version) + "".join(
        parts[board].replace("VERSION", version) for board in collected)


def to_html(markdown):
    """A whole page, by cmark-gfm."""
    tool = shutil.which("cmark-gfm")
    if not tool:
        raise Fault("there is no cmark-gfm, which makes the pages: toolchain/setup firmware installs it")
    title = re.match(r"# (.*)", markdown).group(1)
    body = subprocess.run([tool, "-e", "table"], input=markdown, capture_output=True, text=True, check=True).stdout
    return ('<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">\n'
            '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
            f"<title>{html.escape(title)}</title>\n<style>\n{STYLE}</style></head>\n<body>\n{body}</body></html>\n")


def build(source, folder, board):
    """Its build folder, up to date."""
    for command in (["cmake", "--fresh", "--preset", board, "-S", str(source), "-B", str(folder)], ["cmake", "--build", str(folder)]):
        done = subprocess.run(command, cwd=source, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise Fault(f"{' '.join(command)} failed:\n{done.stdout}{done.stderr}")


def collect(folder, out, board, version):
    names = []
    for kind in KINDS:
        file = folder / f"fencepost.{kind}"
        if file.is_file():
            names.append(f"fencepost-{version}-{board}.{kind}")
            shutil.copyfile(file, out / names[-1])
    if not names:
        raise Fault(f"{folder} has no image: the build left nothing")
    return names


def empty(out):
    """A folder of earlier images, or none; nothing else is deleted."""
    if out.exists() and any(out.iterdir()) and not (out / SUMS).is_file():
        raise Fault(f"{out} holds something else: name another folder, or delete it")
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    (out / SUMS).touch()  # so a run that fails leaves a folder that the next one knows


def page_of(name):
    """The page of a release that a linked document is."""
    name = pathlib.Path(name)
    return "START_HERE" if name.name == pathlib.Path(DOCUMENT).name else name.stem


def with_pages(text):
    """Its links, to pages of a release."""
    return PAGE.sub(lambda match: f"{match.group(1)}{page_of(match.group(2))}.html)", text)


def add_guide(source, out, version):
    """The guide to a first alert as a page, with the pictures that it shows, the pages that it links and the examples."""
    text = (source / GUIDE).read_text(encoding="utf-8")
    for _, name in PICTURE.findall(text):
        shutil.copyfile((source / GUIDE).parent / name, out / pathlib.Path(name).name)
    text = PICTURE.sub(lambda match: f"{match.group(1)}{pathlib.Path(match.group(2)).name})", text)
    for _, name in PAGE.findall(text):
        if page_of(name) != "START_HERE":
            linked = ((source / GUIDE).parent / name).read_text(encoding="utf-8")
            (out / f"{page_of(name)}.html").write_text(to_html(linked), encoding="utf-8")
    text = with_pages(text)
    (out / "FIRST_ALERT.html").write_text(to_html(text.replace("VERSION", version)), encoding="utf-8")
    shutil.copytree(source / EXAMPLES, out / "examples")


def page_with_images(page, images):
    """The page of host/web with images inside, `images`: {board: bytes}; host/web/src/board.js reads them."""
    if page.count(WEB_PLACE) != 1:
        raise Fault(f"{WEB_PAGE} has no {WEB_PLACE}: host/web/build makes it")
    packed = [{"board": board, "image": base64.b64encode(gzip.compress(image, 9, mtime=0)).decode()} for board, image in images.items()]
    return page.replace(WEB_PLACE, f'<script type="application/json" id="images">{json.dumps(packed)}</script>\n{WEB_PLACE}')


def add_page(source, out, collected, version):
    page = (source / WEB_PAGE).read_text(encoding="utf-8")
    images = {board: (out / f"fencepost-{version}-{board}.bin").read_bytes() for board in collected}
    (out / "fencepost-boards.html").write_text(page_with_images(page, images), encoding="utf-8")


def add_sums(out):
    lines = [f"{hashlib.sha256(path.read_bytes()).hexdigest()}  {path.relative_to(out).as_posix()}\n"
             for path in sorted(out.rglob("*")) if path.is_file() and path.name != SUMS]
    (out / SUMS).write_text("".join(lines), encoding="utf-8")


def make(source, build_folder, out, version, builder=build):
    names = boards(json.loads((source / "CMakePresets.json").read_text(encoding="utf-8")))
    if not names:
        raise Fault("CMakePresets.json has no preset with the name of its board")
    empty(out)
    collected = {}
    for board in names:
        print(f"images: {board}", flush=True)
        builder(source, build_folder / board, board)
        collected[board] = collect(build_folder / board, out, board, version)
    text = (source / DOCUMENT).read_text(encoding="utf-8")
    (out / "START_HERE.html").write_text(to_html(with_pages(page(text, version, collected))), encoding="utf-8")
    add_guide(source, out, version)
    add_page(source, out, collected, version)
    add_sums(out)
    print(f"images: {out}: {len(names)} boards, {sum(map(len, collected.values()))} images")


def main():
    if len(sys.argv) != 5:
        sys.exit(__doc__.strip())
    source, build_folder, out = (pathlib.Path(argument).absolute() for argument in sys.argv[1:4])
    try:
        make(source, build_folder, out, sys.argv[4])
    except Fault as fault:
        sys.exit(f"images: {fault}")


if __name__ == "__main__":
    main()
