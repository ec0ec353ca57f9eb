#!/usr/bin/env python3
"""usage: mutate.py TREE MUTANTS.json SOURCE...

Rewrites the sources (paths within TREE, a copy of this project) so that they hold every mutant at once, switched by
mutation.hpp, and lists them. Operators: comparisons with and without equality, equality, + and -, a sign, a negation,
one side of && and ||, constants, statements left out. Needs clang's Python bindings.
"""

import itertools
import json
import pathlib
import re
import sys

import clang.cindex as cindex
from clang.cindex import CursorKind, TokenKind

COMPARISONS = {"<": "lt", "<=": "le", ">": "gt", ">=": "ge", "==": "eq", "!=": "ne"}
BECOMES = {"<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "+": "-", "-": "+"}
OPERATORS = {"<": "bound", "<=": "bound", ">": "bound", ">=": "bound", "==": "equality", "!=": "equality", "+": "sum", "-": "sum"}
FUNCTIONS = {**COMPARISONS, "+": "plus", "-": "minus"}
STATEMENTS = (CursorKind.BINARY_OPERATOR, CursorKind.COMPOUND_ASSIGNMENT_OPERATOR, CursorKind.UNARY_OPERATOR,
              CursorKind.CALL_EXPR)
LITERALS = (CursorKind.INTEGER_LITERAL, CursorKind.FLOATING_LITERAL)
# Code that is computed while compiling, or never executed as it is written.
STATIC = (CursorKind.STATIC_ASSERT, CursorKind.ENUM_DECL, CursorKind.TEMPLATE_NON_TYPE_PARAMETER, CursorKind.CASE_STMT,
          CursorKind.TYPE_ALIAS_DECL, CursorKind.CONCEPT_DECL if hasattr(CursorKind, "CONCEPT_DECL") else None)
MOST = 1 << 15  # kMax of mutation.hpp
CLASSES = (CursorKind.CLASS_DECL, CursorKind.STRUCT_DECL, CursorKind.CLASS_TEMPLATE)
FUNCTION_KINDS = (CursorKind.FUNCTION_DECL, CursorKind.CXX_METHOD, CursorKind.FUNCTION_TEMPLATE)
NAMESPACE = "::fencepost::mutation::"


class Source:
    """One file: its text, and what is inserted where."""

    def __init__(self, tree, path, first):
        self.path, self.first = path, first
        self.text = (tree / path).read_bytes()
        self.seen = set()
        self.mutants, self.edits = [], []  # edits: (offset, order, text); in order at one offset
        arguments = ["-x", "c++", "-std=c++20", f"-I{tree}", "-isystem", "/usr/include/eigen3", "-DEIGEN_DONT_VECTORIZE",
                     "-DEIGEN_NO_MALLOC", "-DEIGEN_MPL2_ONLY", f"-DFENCEPOST_VERSION=\"0\""]
        self.unit = cindex.Index.create().parse(str(tree / path), arguments,
                                                options=cindex.TranslationUnit.PARSE_DETAILED_PROCESSING_RECORD)
        self.children = [c for c in self.unit.cursor.get_children() if c.kind != CursorKind.MACRO_DEFINITION and self.here(c)]
        self.macros = [self.span(c) for c in self.children if c.kind == CursorKind.MACRO_INSTANTIATION]

    def here(self, cursor):
        return cursor.location.file is not None and cursor.location.file.name == self.unit.spelling

    def span(self, cursor):
        return cursor.extent.start.offset, cursor.extent.end.offset

    def in_macro(self, begin, end):
        return any(begin < macro_end and macro_begin < end for macro_begin, macro_end in self.macros)

    def mutant(self, cursor, operator, what):
        self.mutants.append({"id": self.first + len(self.mutants), "file": str(self.path),
                             "line": cursor.location.line, "operator": operator, "what": what})
        return self.mutants[-1]["id"]

    # Of edits that begin at one offset the longer comes first, of those that end there the shorter.
    def around(self, begin, end, before, after):
        self.edits.append((begin, 1, -(end - begin), len(self.edits), before))
        self.edits.append((end, 0, end - begin, -len(self.edits), after))

    def replace(self, begin, end, text):
        self.edits.append((begin, 2, 0, len(self.edits), (end, text)))

    def walk(self, children, cursor):
        for child in children:
            compiled = child.kind in STATIC or self.is_constant(child) or self.is_consteval(child)
            if not self.here(child) or compiled or self.is_argument(child, cursor):
                continue
            self.offer(child, cursor)
            self.walk(child.get_children(), child)

    def is_argument(self, cursor, parent):
        """Of a template: an expression of a declaration before its name, or of a class outside its members."""
        before_name = cursor.extent.end.offset <= parent.location.offset
        return cursor.kind.is_expression() and parent.kind.is_declaration() and (before_name or parent.kind in CLASSES)

    def is_constant(self, cursor):
        if cursor.kind not in (CursorKind.VAR_DECL, CursorKind.FIELD_DECL):
            return False
        words = [token.spelling for token in cursor.get_tokens()]
        name = words.index(cursor.spelling) if cursor.spelling in words else 0
        return "constexpr" in words[:name + 1] or cursor.kind == CursorKind.FIELD_DECL

    def is_consteval(self, cursor):
        words = itertools.takewhile(lambda token: token.spelling != cursor.spelling, cursor.get_tokens())
        return cursor.kind in FUNCTION_KINDS and any(token.spelling == "consteval" for token in words)

    def offer(self, cursor, parent):
        begin, end = self.span(cursor)
        # One piece of text may be several nodes: of a default, or of a template and its instance.
        if begin >= end or self.in_macro(begin, end) or (begin, end, cursor.kind) in self.seen:
            return
        self.seen.add((begin, end, cursor.kind))
        if parent.kind == CursorKind.COMPOUND_STMT and cursor.kind in STATEMENTS:
            self.statement(cursor, begin)
        if cursor.kind == CursorKind.BINARY_OPERATOR:
            self.binary(cursor, begin, end)
        elif cursor.kind == CursorKind.UNARY_OPERATOR:
            self.unary(cursor, begin, end)
        elif cursor.kind in LITERALS and parent.kind != CursorKind.COMPOUND_STMT:
            self.literal(cursor, begin, end)

    def statement(self, cursor, begin):
        first = next(cursor.get_tokens(), None)
        if first is None or first.spelling in ("delete", "throw"):
            return
        number = self.mutant(cursor, "statement", "statement left out")
        self.edits.append((begin, 1, -(1 << 30), len(self.edits), f"if (!{NAMESPACE}on({number})) "))

    def operator_between(self, left, right):
        text = self.text[left:right].decode()
        found = re.fullmatch(r"\s*(<=|>=|==|!=|<|>|\+|-|&&|\|\|)\s*", text)
        return (found.group(1), left + found.start(1), left + found.end(1)) if found else None

    def binary(self, cursor, begin, end):
        children = list(cursor.get_children())
        if len(children) != 2:
            return
        (left_begin, left_end), (right_begin, right_end) = map(self.span, children)
        if left_begin != begin or right_end != end:
            return
        operator = self.operator_between(left_end, right_begin)
        if operator is None:
            return
        name, at, past = operator
        if name in ("&&", "||"):
            number = self.mutant(cursor, "condition", f"right side of {name} ignored")
            sense = "" if name == "&&" else "!"
            joined = "||" if name == "&&" else "&&"
            self.around(right_begin, right_end, f"({sense}{NAMESPACE}on({number}) {joined} (", "))")
            return
        number = self.mutant(cursor, OPERATORS[name], f"{name} is {BECOMES[name]}")
        self.around(begin, end, f"{NAMESPACE}{FUNCTIONS[name]}({number}, ", ")")
        self.replace(at, past, ",")

    def unary(self, cursor, begin, end):
        sign = self.text[begin:begin + 1]
        # An inequality that is made of an equality is a node that begins at its sign.
        if sign not in (b"-", b"!") or self.text[begin:begin + 2] in (b"--", b"!="):
            return
        name = "negative" if sign == b"-" else "negated"
        number = self.mutant(cursor, "sign" if sign == b"-" else "negation", f"{sign.decode()} left out")
        self.around(begin, end, f"{NAMESPACE}{name}({number}, ", ")")
        self.replace(begin, begin + 1, "")

    def literal(self, cursor, begin, end):
        text = self.text[begin:end].decode()
        # 0 may be a null pointer, and is what most things are made with.
        if not re.fullmatch(r"[0-9][0-9a-fA-FxX'.eE+-]*[uUlLfF]*", text) or text.rstrip("uUlLfF") in ("0", "0.0", "0."):
            return
        number = self.mutant(cursor, "constant", f"{text} is more")
        self.around(begin, end, f"{NAMESPACE}constant({number}, ", ")")

    def rewritten(self):
        out, at = [], 0
        for offset, _, _, _, what in sorted(self.edits, key=lambda edit: edit[:4]):
            if isinstance(what, tuple):
                out += [self.text[at:offset].decode(), what[1]]
                at = what[0]
            else:
                out += [self.text[at:offset].decode(), what]
                at = offset
        body = "".join(out) + self.text[at:].decode()
        return '#include "tests/mutation/mutation.hpp"\n' + body


def main():
    if len(sys.argv) < 4:
        sys.exit(__doc__)
    tree, mutants, sources = pathlib.Path(sys.argv[1]).resolve(), [], []
    for path in sys.argv[3:]:
        source = Source(tree, pathlib.Path(path), len(mutants))
        errors = [d for d in source.unit.diagnostics if d.severity >= cindex.Diagnostic.Error]
        if errors:
            print(f"{path}: {errors[0].spelling} ({errors[0].location.line})", file=sys.stderr)
        source.walk(source.children, source.unit.cursor)
        sources.append((path, source.rewritten()))
        mutants += source.mutants
    if len(mutants) > MOST:
        sys.exit(f"{len(mutants)} mutants are more than kMax of mutation.hpp")
    for path, text in sources:
        (tree / path).write_text(text)
    pathlib.Path(sys.argv[2]).write_text(json.dumps(mutants))
    print(f"{len(mutants)} mutants in {len(sources)} files")


if __name__ == "__main__":
    main()
