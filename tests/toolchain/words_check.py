#!/usr/bin/env python3
"""usage: words_check.py [ROOT]

Holds comments, documents, messages and names of bounds to the rules of plain English (REMEDIES).
Prints one line per fault; exit status 1 if there is any.
"""

import io
import pathlib
import re
import sys
import tokenize

from layer_check import NOT_OURS
from source_text import comments_of, strings_of

MAX_WORDS = 25
CODE = {".cpp", ".hpp", ".h", ".c", ".ino", ".js", ".mjs"}
HASHES = {".py", ".cmake", ".txt", ".sh"}
OWN = {"tests/toolchain/words_check.py", "tests/toolchain/words_check_test.py"}  # they have the words that they refuse

OPENING = re.compile(r"(what|of what|by so much)\b", re.IGNORECASE)
TOLD = re.compile(r"\btold\b", re.IGNORECASE)
EXTREME = re.compile(r"\bk(?:Most|Least)[A-Z]\w*")
ABBREVIATIONS = {"e.g.", "i.e.", "etc.", "vs.", "cf.", "sec.", "fig.", "no.", "approx.", "ca.", "..."}
CONSTANT = re.compile(r"\s*(?:(?:static|inline|extern)\s+)*(?:constexpr|constinit|const)\b[^(]*?\b(k[A-Z]\w*)")
FIELD = re.compile(r"(?:in|out|errors|cost|source):$")  # begins a line of a documented function

REMEDIES = {
    "long": f"a sentence has at most {MAX_WORDS} words; make two of it",
    "opening": "a comment does not open so; begin with the thing that it describes",
    "told": "write configured, given, reported or estimated",
    "constants": "one comment for several constants; give each its own, behind it or above",
    "extreme": "write kMax... or kMin...",
}


def kind_of(path):
    name = pathlib.PurePath(path)
    if path in OWN:
        return None
    if name.suffix in CODE:
        return "code"
    if name.suffix == ".md":
        return "document"
    if name.suffix in HASHES and (name.suffix != ".txt" or name.name == "CMakeLists.txt"):
        return "python" if name.suffix == ".py" else "hashes"
    return "hashes" if name.parts[0] == "toolchain" and not name.suffix else None


# A text is [(line number, words)]: what belongs together, without the marks around it.


def joined(comments):
    """[(line, text, stands alone)] as texts: comments on lines of their own that follow each other are one."""
    texts, last = [], None
    for line, comment, alone in comments:
        follows = alone and last == line - 1
        for number, part in enumerate(comment.split("\n"), line):
            words = part.split()
            if words and follows and words[0] not in ("-", "*") and not FIELD.match(words[0]):
                texts[-1].append((number, words))
            elif words:
                texts.append([(number, words)])
            follows = bool(words)
            last = number if alone and words else None
    return texts


def bare(text):
    """A comment of C++ or JavaScript without its marks."""
    if text.startswith("//"):
        return re.sub(r"^//[/!]*<?", "", text)
    return re.sub(r"(?m)^\s*\*(?!/)", "", text[2:].removesuffix("*/").lstrip("*"))


def in_code(text):
    """(texts of comments, [(line, message)])"""
    comments = [(line, bare(comment), alone) for line, comment, alone in comments_of(text)]
    return joined(comments), list(strings_of(text))


def in_python(text):
    comments, strings, before = [], [], tokenize.NEWLINE
    try:
        for token in tokenize.generate_tokens(io.StringIO(text).readline):
            line = token.start[0]
            if token.type == tokenize.COMMENT:
                alone = not token.line[: token.start[1]].strip()
                comments.append((line, token.string.lstrip("#!"), alone))
            elif token.type == tokenize.STRING:
                if before in (tokenize.NEWLINE, tokenize.INDENT, tokenize.NL, tokenize.ENCODING, tokenize.DEDENT):
                    comments.append((line, token.string.strip("rbuf\"'"), False))
                else:
                    strings.append((line, token.string))
            if token.type not in (tokenize.NL, tokenize.COMMENT):
                before = token.type
    except (tokenize.TokenError, IndentationError, SyntaxError):
        pass
    return joined(comments), strings


def in_hashes(text):
    comments = []
    for number, line in enumerate(text.split("\n"), 1):
        match = re.match(r"^(.*?)(?:(?<=^)|(?<=\s))#+(?!!)\s(.*)$", line)
        if match and not re.search(r"['\"]", match.group(1)):
            comments.append((number, match.group(2), not match.group(1).strip()))
    return joined(comments), []


def in_document(text):
    texts, current, fenced = [], [], False
    for number, line in enumerate(text.split("\n"), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        code = fenced or line.startswith("    ") or line.lstrip().startswith("```")
        plain = "" if code else line.strip()
        if not plain or plain.startswith(("#", "<", "|")) or re.match(r"(?:[-*+]|\d+\.)\s", plain):
            current = None
        if not plain or plain.startswith("<"):
            continue
        if plain.startswith("|"):
            texts += [[(number, cell.split())] for cell in plain.split("|") if cell.strip(" -:")]
        elif current is None:
            current = [(number, plain.split())]
            texts.append(current)
        else:
            current.append((number, plain.split()))
        if plain.startswith("#"):
            current = None
    return texts, []


def read(kind, text):
    return {"code": in_code, "python": in_python, "hashes": in_hashes, "document": in_document}[kind](text)


def sentences(text):
    """[(line number, [words])]; what stands in backticks is one word."""
    words, inside = [], False
    for number, part in text:
        for word in part:
            if inside:
                words[-1] = (words[-1][0], words[-1][1] + " " + word)
            else:
                words.append((number, word))
            inside ^= word.count("`") % 2 == 1
    sentence = []
    for i, (number, word) in enumerate(words):
        sentence.append((number, word))
        following = words[i + 1][1] if i + 1 < len(words) else ""
        ends = re.search(r"[.!?][\"')\]*`]*$", word) and word.lower().lstrip("(") not in ABBREVIATIONS
        if not following or ends or FIELD.match(following):
            yield sentence[0][0], [w for _, w in sentence]
            sentence = []


def counted(words):
    return sum(1 for word in words if re.search(r"\w", word))


def shared_comments(text):
    """(line number, names): two constants of which one comment stands above both."""
    lines = text.split("\n")
    i = 0
    while i < len(lines):
        if not lines[i].lstrip().startswith("//"):
            i += 1
            continue
        while i < len(lines) and lines[i].lstrip().startswith("//"):
            i += 1
        names, line = [], i + 1
        while i < len(lines) and (match := CONSTANT.match(lines[i])):
            begin = i
            while i < len(lines) and not re.search(r";\s*(//.*)?$", lines[i]):
                i += 1
            own = any("//" in one for one in lines[begin : i + 1])
            if names and own:
                break
            names.append(match.group(1))
            i += 1
        if len(names) > 1:
            yield line, names


def found_in(path, text):
    """[(line number, rule, what of the text breaks it)]"""
    kind = kind_of(path)
    texts, messages = read(kind, text)
    faults = []
    for one in texts:
        for i, (line, words) in enumerate(sentences(one)):
            said = " ".join(words)
            if counted(words) > MAX_WORDS:
                faults.append((line, "long", said))
            if TOLD.search(re.sub(r"`[^`]*`", "", said)):
                faults.append((line, "told", said))
            if i == 0 and kind != "document" and OPENING.match(said):
                faults.append((line, "opening", said))
    faults += [(line, "told", " ".join(said.split())) for line, said in messages if TOLD.search(said)]
    if kind == "code":
        faults += [(line, "constants", ", ".join(names)) for line, names in shared_comments(text)]
        for number, line in enumerate(text.split("\n"), 1):
            faults += [(number, "extreme", name) for name in EXTREME.findall(line)]
    return faults


def files_in(folder):
    for entry in sorted(folder.iterdir()):
        if entry.name in NOT_OURS or entry.is_symlink():
            continue
        if entry.is_dir():
            yield from files_in(entry)
        else:
            yield entry


def check(root):
    faults = []
    for file in files_in(root):
        path = file.relative_to(root).as_posix()
        if kind_of(path):
            text = file.read_text(encoding="utf-8", errors="replace")
            for line, rule, said in sorted(set(found_in(path, text))):
                faults.append(f"{path}:{line}: {rule}: {REMEDIES[rule]}: {said[:100]}")
    return faults


def main(arguments):
    if len(arguments) > 1 or "-h" in arguments or "--help" in arguments:
        print(__doc__.strip() + "\n")
        for rule, remedy in REMEDIES.items():
            print(f"{rule:>10}: {remedy}")
        return 2
    root = pathlib.Path(arguments[0] if arguments else pathlib.Path(__file__).parents[2]).resolve()
    faults = check(root)
    for fault in faults:
        print(fault)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
