#!/usr/bin/env python3
"""Plants one fault of each kind in a small repository, behind a commit to compare with, and expects exactly that fault."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import words_check
from words_check import check

LONG = "This sentence has one word more than " + "the rule " * 9 + "allows"  # 26 words
OLD = f"""// {LONG}.
// What it was.
// Two at once.
constexpr int kMostOld = 1;
constexpr int kMostOlder = 2;
const char* kText = "you were told";
int f();
"""
CLEAN = {
    "a.cpp": OLD,
    "moved.hpp": "int x;  // what is on the line\n",
    "b.md": f"# Words\n\n{LONG}. You are told.\n\n    {LONG} {LONG}\n",
    "c.py": f'"""{LONG}."""\n',
    "CMakeLists.txt": "",
    "toolchain/run": "#!/bin/sh\n",
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
    ("a.cpp", "int told = kMostOld;  // the flag `told`"),
    ("b.md", f"```\n{LONG} told\n```\n\n    {LONG} told"),
    ("b.md", "See `" + "one command " * 30 + "` there."),
    ("c.py", "x = 'What is in a string'"),
    ("words.json", f'{{"a": "{LONG} told"}}'),
]


def git(root, *arguments):
    identity = ["-c", "user.name=a", "-c", "user.email=a@b", "-c", "commit.gpgsign=false"]
    done = subprocess.run(["git", *identity, "-C", root, *arguments], capture_output=True, check=True)
    return done.stdout.decode().strip()


class WordsCheck(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name).resolve()
        for name, text in CLEAN.items():
            (self.root / name).parent.mkdir(exist_ok=True)
            (self.root / name).write_text(text)
        git(self.root, "init", "-q")
        git(self.root, "add", ".")
        git(self.root, "commit", "-qm", "base")
        self.base = git(self.root, "rev-parse", "HEAD")

    def append(self, name, text):
        before = CLEAN.get(name, "")
        (self.root / name).write_text(before + text + "\n")
        return before.count("\n")

    def faults(self):
        faults, missing = check(self.root, self.base)
        self.assertIsNone(missing)
        return faults

    def test_every_fault_is_found_where_it_is(self):
        self.assertEqual(self.faults(), [])
        for name, text, line, rule, begin in FAULTS:
            with self.subTest(name=name, text=text):
                where = f"{name}:{self.append(name, text) + line}: {rule}: {words_check.REMEDIES[rule]}: {begin}"
                found = self.faults()
                self.assertEqual([fault[: len(where)] for fault in found], [where])
                (self.root / name).write_text(CLEAN[name])

    def test_what_is_right_or_old_passes(self):
        for name, text in GOOD:
            with self.subTest(name=name, text=text):
                self.append(name, text)
                self.assertEqual(self.faults(), [])
                git(self.root, "checkout", "-q", ".")

    def test_old_words_may_move(self):
        (self.root / "a.cpp").unlink()
        (self.root / "new.cpp").write_text(OLD.replace("more than", "more\n// than"))
        self.assertEqual(self.faults(), [])
        (self.root / "new.cpp").write_text(OLD.replace("Two at", "Both at") + "// It was told.\n")
        self.assertEqual(len(self.faults()), 1, "a file that git does not know is looked at")

    def test_commits_are_looked_at(self):
        self.append("b.md", "It was told so.")
        git(self.root, "commit", "-qam", "more")
        self.assertEqual(len(self.faults()), 1)

    def test_it_says_what_it_cannot_compare(self):
        _, missing = check(self.root, "0" * 40)
        self.assertIn("has no commit 00000000", missing)
        with tempfile.TemporaryDirectory() as folder:
            _, missing = check(pathlib.Path(folder))
            self.assertIn("no git here", missing)
        _, missing = check(self.root / "toolchain", self.base)
        self.assertIn("no repository of its own", missing)
        program = [sys.executable, "-B", words_check.__file__]
        skipped = subprocess.run([*program, self.root, "0" * 40], capture_output=True)
        self.assertEqual((skipped.returncode, skipped.stdout), (words_check.SKIPPED, b""))
        self.append("b.md", "It was told so.")
        faulty = subprocess.run([*program, self.root, self.base], capture_output=True)
        self.assertEqual((faulty.returncode, faulty.stdout.count(b"\n")), (1, 1))


if __name__ == "__main__":
    if words_check.Git(".")("--version") is None:
        print("words_check_test: skipped: no git here", file=sys.stderr)
        sys.exit(words_check.SKIPPED)
    unittest.main()
