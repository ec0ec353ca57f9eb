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
