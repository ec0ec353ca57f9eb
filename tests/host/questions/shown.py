"""Documents that show commands and what they print: their pieces, and whether a print is what they show.

A block of lines that begin with "| " is the file named last before it. One that begins with "$ " is a command, and what
it prints, on either stream. A line "..." stands for any lines.
"""

import re

INDENT = "    "
MORE = "..."


def pieces(lines):
    """The document as (command, lines shown) and, for all else, (None, [line])."""
    found = []
    for line in lines:
        if line.startswith(INDENT + "$ "):
            found.append((line[len(INDENT) + 2:], []))
        elif found and found[-1][0] and line.startswith(INDENT):
            found[-1][1].append(line[len(INDENT):])
        elif found and found[-1][0] and not line and found[-1][1]:
            found[-1][1].append("")  # an empty line within what is printed, or the end of it: see trimmed()
        else:
            found.append((None, [line]))
    return found


def trimmed(shown):
    while shown and not shown[-1]:
        shown = shown[:-1]
    return shown


def parts(shown):
    """The parts between lines "...", each as a list of lines."""
    found = [[]]
    for line in shown:
        if line == MORE:
            found.append([])
        else:
            found[-1].append(line)
    return found


def is_shown(printed, shown):
    if MORE not in shown:
        return printed == shown
    first, *others = parts(shown)
    if printed[:len(first)] != first:
        return False
    at = len(first)
    for part in others[:-1]:
        starts = [i for i in range(at, len(printed) - len(part) + 1) if printed[i:i + len(part)] == part]
        if not starts:
            return False
        at = starts[0] + len(part)
    last = others[-1]
    return at <= len(printed) - len(last) and printed[len(printed) - len(last):] == last


def renewed(printed, shown):
    """The lines that the document is to show now: as many as it showed. With "..." before its end it stays as it is."""
    if MORE in shown[:-1]:
        return shown
    return [*printed[:len(shown) - 1], MORE] if shown and shown[-1] == MORE else printed


class Reading:
    """Goes through a document: writes the files that it shows, gives its commands, keeps its text."""

    def __init__(self, text, folder):
        self.text, self.folder = text, folder
        self.written = []

    def commands(self):
        """(command, lines shown, a function that takes the lines that the document is to show then)"""
        file = None
        for command, shown in pieces(self.text.splitlines()):
            if not command:
                line = shown[0]
                names = re.findall(r"`([\w.]+\.(?:txt|csv|json))`", line)
                file = names[-1] if names else file
                if line.startswith(INDENT + "| "):
                    with (self.folder / file).open("a") as out:
                        out.write(line[len(INDENT) + 2:] + "\n")
                self.written.append(line)
                continue
            at = len(self.written)
            ends = len(shown) - len(trimmed(shown))
            self.written.append(None)

            def put(lines, at=at, command=command, ends=ends):
                self.written[at] = "\n".join([INDENT + "$ " + command, *((INDENT + line).rstrip() for line in lines), *[""] * ends])

            put(trimmed(shown))
            yield command, trimmed(shown), put

    def document(self):
        return "\n".join(self.written) + "\n"
