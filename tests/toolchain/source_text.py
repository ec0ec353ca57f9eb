"""C++ source without comments, or without comments and literals; line numbers stay."""

import re

_TOKEN = re.compile(
    r"""
    //(?:\\\n|[^\n])*                                  # line comment, with continued lines
  | /\*.*?(?:\*/|\Z)                                   # block comment
  | (?<!\w)(?:u8|[uUL])?R"(?P<mark>[^()\\\s]{0,16})\(.*?\)(?P=mark)"   # raw string
  | (?<!\w)(?:u8|[uUL])?"(?:\\.|[^"\\\n])*"            # string
  | (?<![0-9A-Fa-f])(?:u8|[uUL])?'(?:\\.|[^'\\\n])+'   # character; not a digit separator
    """,
    re.VERBOSE | re.DOTALL,
)


def _newlines(text):
    return "\n" * text.count("\n")


def comments_of(text):
    """(line number, comment with its marks, whether it has its line for itself)"""
    for match in _TOKEN.finditer(text):
        if match.group().startswith(("//", "/*")):
            before = text[text.rfind("\n", 0, match.start()) + 1 : match.start()]
            yield text.count("\n", 0, match.start()) + 1, match.group(), not before.strip()


def strings_of(text):
    """(line number, literal); literals that the compiler joins are one."""
    begin, end, parts = 0, 0, []
    for match in _TOKEN.finditer(text):
        token = match.group()
        if token.startswith(("//", "/*")) or not token.endswith('"'):
            continue
        if parts and text[end : match.start()].strip():
            yield text.count("\n", 0, begin) + 1, "".join(parts)
            parts = []
        begin = begin if parts else match.start()
        parts.append(token[token.index('"') + 1 : -1])
        end = match.end()
    if parts:
        yield text.count("\n", 0, begin) + 1, "".join(parts)


def without_comments(text):
    def replace(match):
        token = match.group()
        return " " + _newlines(token) if token.startswith(("//", "/*")) else token

    return _TOKEN.sub(replace, text)


def without_literals(text):
    """Code words only: what a rule about the language looks at."""

    def replace(match):
        token = match.group()
        if token.startswith(("//", "/*")):
            return " " + _newlines(token)
        return '""' + _newlines(token)

    return _TOKEN.sub(replace, text)
