#!/usr/bin/env python3
"""Plants one fault of each kind in a small tree, and expects exactly that fault."""

import subprocess
import sys
import unittest

import words_check
from words_check import check
from planted import Planted

LONG = "This sentence has one word more than " + "the rule " * 9 + "allows"  # 26 words
CLEAN = {
    "a.cpp": "int f();\n",
    "moved.hpp": "int x;  // a line\n",
    "b.md": f"# Words\n\n    {LONG} {LONG}\n",
    "c.py": '"""A text."""\n',
    "CMakeLists.txt": "",
    "toolchain/run": "#!/bin/sh\n",
    "build/a.cpp": f"// {LONG}\n",
}

# (file, text put at its end, line there, rule, how the fault begins)
FAULTS = [
    ("a.cpp", f"// {LONG} too.", 1, "long", "This sentence"),
    ("a.cpp", "// Short.\n// " + LONG.replace("more", "more\n//") + ", and more.", 2, "long", "This sentence"),
    ("a.cpp", f"/* {LONG}, too */", 1, "long", "This sentence"),
    ("a.cpp", f"/// A short one. errors: none\n/// in: {LONG}", 2, "long", "in: This sentence"),
    ("b.md", f"| cell | {LONG} here |", 1, "long", "This sentence"),
    ("b.md", f"Some list:\n- one\n- {LONG} here", 3, "long", "- This sentence"),
    ("c.py", f"x = 1  # {LONG} here", 1, "long", "This sentence"),
    ("c.py", f'def f():\n    """{LONG} here"""', 2, "long", "This sentence"),
    ("CMakeLists.txt", f"# {LONG}, yes", 1, "long", "This sentence"),
    ("toolchain/run", f"# {LONG}, yes", 1, "long", "This sentence"),
    ("a.cpp", "int y;  ///< what is new", 1, "opening", "what is new"),
    ("a.cpp", "// Of what is new.", 1, "opening", "Of what"),
    ("a.cpp", "/// By so much it is new.", 1, "opening", "By so much"),
    ("c.py", "# What is new", 1, "opening", "What is new"),
    ("a.cpp", "// The value that the user told.", 1, "told", "The value"),
    ("a.cpp", 'say("it was "\n    "told so");', 1, "told", "it was told so"),
    ("c.py", "say('it was told so')", 1, "told", "'it was told so'"),
    ("b.md", "It was told so.", 1, "told", "It was"),
    ("a.cpp", "// Both.\nconstexpr int kA = 1;\nconstexpr int kB = 2;", 2, "constants", "kA, kB"),
    ("a.cpp", "// Both.\nconst std::array<int, 2> kA = {\n  1, 2};\nstatic constexpr int kB = 2;", 2, "constants", "kA, kB"),
    ("a.cpp", "constexpr int kMostNew = 1;", 1, "extreme", "kMostNew"),
    ("moved.hpp", "int f(int kLeastNew);", 1, "extreme", "kLeastNew"),
]

# Texts that pass.
GOOD = [
    ("a.cpp", "// A short one. " * 30),
    ("a.cpp", "// One.\nconstexpr int kA = 1;\n// Two.\nconstexpr int kB = 2;\n\nconstexpr int kC = 3;"),
    ("a.cpp", "// A section.\nconstexpr int kA = 1;  // one\nconstexpr int kB = 2;  // two"),
    ("a.cpp", "int told = kMaxOld;  // the flag `told`"),
    ("b.md", f"```\n{LONG} told\n```\n\n    {LONG} told"),
    ("b.md", "See `" + "one command " * 30 + "` there."),
    ("c.py", "x = 'What is in a string'"),
    ("words.json", f'{{"a": "{LONG} told"}}'),
]


class WordsCheck(Planted):
    FILES = CLEAN

    def append(self, name, text):
        before = CLEAN.get(name, "")
        (self.root / name).write_text(before + text + "\n")
        return before.count("\n")

    def restore(self, name):
        (self.root / name).write_text(CLEAN.get(name, ""))

    def test_every_fault_is_found_where_it_is(self):
        self.assertEqual(check(self.root), [])
        for name, text, line, rule, begin in FAULTS:
            with self.subTest(name=name, text=text):
                where = f"{name}:{self.append(name, text) + line}: {rule}: {words_check.REMEDIES[rule]}: {begin}"
                self.assertEqual([fault[: len(where)] for fault in check(self.root)], [where])
                self.restore(name)

    def test_what_is_right_passes(self):
        for name, text in GOOD:
            with self.subTest(name=name, text=text):
                self.append(name, text)
                self.assertEqual(check(self.root), [])
                self.restore(name)

    def test_the_program_prints_a_line_a_fault(self):
        program = [sys.executable, "-B", words_check.__file__, self.root]
        self.assertEqual(subprocess.run(program, capture_output=True).returncode, 0)
        self.append("b.md", "It was told so.")
        faulty = subprocess.run(program, capture_output=True)
        self.assertEqual((faulty.returncode, faulty.stdout.count(b"\n")), (1, 1))


if __name__ == "__main__":
    unittest.main()
