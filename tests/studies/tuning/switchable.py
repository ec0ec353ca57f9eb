"""Makes the numbers of firmware/recon/**/tuning.hpp switchable at run time, in a copy of the sources.

Each becomes a constant that reads TUNING_NAME and TUNING_FACTOR from the environment when the program starts. What is
computed from one of them, anywhere, cannot be constexpr any more; assertions about it at compile time are dropped.
"""

import collections
import re

Number = collections.namedtuple("Number", "name value derived folder")
HEADER = """#pragma once
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <type_traits>
#include "hal/base/units.hpp"
inline double tuning_factor(std::string_view name) {
  const char* asked = std::getenv("TUNING_NAME");
  return asked != nullptr && name == asked ? std::atof(std::getenv("TUNING_FACTOR")) : 1.0;
}
template <class T> T tuned(const char* name, T value, double origin = 0) {
  const double factor = tuning_factor(name);
  if (factor == 1.0) return value;
  if constexpr (std::is_floating_point_v<T>) return static_cast<T>(origin + (value - origin) * factor);
  else if constexpr (std::is_integral_v<T>) {  // a count in a byte may not overflow
    const double most = std::numeric_limits<T>::max();
    return static_cast<T>(value * factor < most ? value * factor : most);
  } else return T{static_cast<std::int64_t>(static_cast<double>(value.raw) * factor)};
}
struct Tuned {  // in a braced list, of a type that is known later
  const char* name; double value; double origin;
  template <class T> operator T() const { return static_cast<T>(origin + (value - origin) * tuning_factor(name)); }
};
"""
# Sizes of arrays, and logarithms of sizes: no run time can change them.
FIXED = {"kMaxWaitingFrames", "kSpacingLog2", "kSpacing", "kSupportPasses"}
# Shares near one, and factors: their distance from one is halved and doubled.
FROM_ONE = {"kWidestSine", "kSameDepth", "kInlierShare", "kForgetting", "kLensWrong.0", "kLensRight.0"}
REPLACED = {
    "firmware/recon/models/inlier.hpp":
        ("constexpr float kOutlier = 0.1F;", 'static const float kOutlier = tuned("kInlierShare", 0.1F);'),
    "firmware/recon/track/correspondence.hpp":  # in a byte
        ("std::uint8_t kMemory = 2 * kIdsKept;", "std::uint8_t kMemory = kIdsKept < 128 ? 2 * kIdsKept : 255;"),
}

DECLARED = re.compile(r"inline constexpr ([\w:]+(?:<[^=]*?>)?)\s+(k\w+)\s*(?:=\s*([^;]+?)|(\{[^;]+?\}));", re.S)
NOT_TUNED = re.compile("Derived|By design")  # in its comment: the study need not judge the number
LITERAL = re.compile(r"(?<![\w.])\d[\d'.]*(?:e-?\d+)?F?(?![\w.])")


def switchable(text, folder):
    """The text of a tuning.hpp with its numbers switchable, and a Number for each; its comment says if it is derived."""
    names = []

    def replace(match):
        kind, name, value, braced = match.groups()
        if name in FIXED:
            return match[0]
        derived = NOT_TUNED.search(comment_before(text, match.start())) is not None
        if value and not value.startswith("{") and "std::span" not in kind:
            names.append(Number(name, plain(value), derived, folder))
            of = "" if kind == "auto" else f"<{kind}>"
            call = f'tuned{of}("{name}", {value}, {int(name in FROM_ONE)})'
            return f"inline const {kind} {name} = {call};"
        if kind.startswith("base::Duration"):
            names.append(Number(name, plain(braced), derived, folder))
            return f'inline const {kind} {name} = tuned("{name}", {kind}{braced});'
        count = 0

        def literal(number):
            nonlocal count
            if float(number[0].replace("'", "").rstrip("F")) in (0, 1) or number.string[number.start() - 1] == "-":
                return number[0]
            own = f"{name}.{count}"
            names.append(Number(own, plain(number[0]), derived, folder))
            count += 1
            return f'Tuned{{"{own}", {number[0]}, {int(own in FROM_ONE)}}}'
        values = LITERAL.sub(literal, value or braced)
        return f"inline const {kind} {name}{' = ' if value else ''}{values};"
    out = DECLARED.sub(replace, text)
    return out.replace("#pragma once\n", '#pragma once\n#include "hal/base/tuned.hpp"\n', 1), names


def plain(value):
    """As a table has it."""
    value = re.sub(r"(?<=\d)F\b|base::|static_cast<[\w:]+>|[{}']", "", value)
    return re.sub(r"milliseconds\((\d+)\)", r"\1 ms", " ".join(value.split()))


def comment_before(text, start):
    lines = text[:start].rstrip("\n").split("\n")
    comment = []
    while lines and lines[-1].lstrip().startswith("///"):
        comment.insert(0, lines.pop())
    return "\n".join(comment)


CONSTANT = re.compile(r"^([ \t]*)((?:static |inline )*)constexpr ([^;(){}=]*?\b(\w+))(\s*=[^;]*|\{[^;]*\});", re.M)
FUNCTION = re.compile(r"^([ \t]*)(?:inline )?constexpr ([^;=]*?\)[\w ]*\{(?:\n(?!\1\}).*)*?\n\1\}|[^;=\n]*\)[\w ]*\{.*\})", re.M)
ASSERTION = re.compile(r"static_assert\((?:[^;\"]|\"[^\"]*\")*\);")


def without_constexpr(files, names):
    """Takes constexpr from whatever uses the names, in {path: text}."""
    known = {name.split(".")[0] for name in names}
    own = {path: set() for path in files}  # of one file: in another, such a name is of another thing
    grown = True
    while grown:
        grown = False
        for path, text in files.items():
            uses = re.compile(r"\b(?:" + "|".join(known | own[path]) + r")\b")
            if not uses.search(text):
                continue

            def constant(match):
                nonlocal grown
                indent, kept, declared, name, value = match.groups()
                if not uses.search(value):
                    return match[0]
                grown = True
                (own[path] if indent or path.endswith(".cpp") else known).add(name)
                inline = "inline " if not indent or "static" in kept and path.endswith(".hpp") else ""
                return f"{indent}{kept.replace('inline ', '')}{inline}const {declared}{value};"

            def function(match):
                return f"{match[1]}inline {match[2]}" if uses.search(match[2]) else match[0]
            text = FUNCTION.sub(function, CONSTANT.sub(constant, text))
            files[path] = ASSERTION.sub(lambda match: "" if uses.search(match[0]) else match[0], text)


def tree(files, replaced=REPLACED):
    """{path: text} of a tree that is switchable, and its numbers"""
    files, numbers = dict(files), []
    for path in files:
        if path.startswith("firmware/recon/") and path.endswith("/tuning.hpp"):
            files[path], found = switchable(files[path], path.split("/")[-2])
            numbers += found
    for path, (old, new) in replaced.items():
        files[path] = files[path].replace(old, new)
    without_constexpr(files, [number.name for number in numbers])
    return files | {"hal/base/tuned.hpp": HEADER}, numbers
