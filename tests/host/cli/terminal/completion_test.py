#!/usr/bin/env python3
"""usage: completion_test.py FENCEPOST

The manual pages and the completion of shells, against what --help prints. zsh, fish and man are asked where they are.
"""

import fcntl
import os
import pathlib
import pty
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import termios
import unittest

PROGRAM = sys.argv[1]


def run(*command, **options):
    return subprocess.run([str(c) for c in command], capture_output=True, text=True, check=False, **options)


def said(*words):
    done = run(PROGRAM, *words)
    assert done.returncode == 0, (words, done.stderr)
    return done.stdout


def entries(text, heading):
    """The names of the lines below "Commands:" or "Options:"."""
    part = re.search(rf"^{heading}:\n((?:  .*\n)*)", text, re.MULTILINE)
    return re.findall(r"^  (\S+)", part.group(1), re.MULTILINE) if part else []


def commands(words=()):
    """Each command as its words, the program first."""
    yield list(words)
    text = said(*words, "--help")
    for name in entries(text, "Subcommands") if words else entries(text, "Commands"):
        yield from commands([*words, name])


def options_of(words):
    return [flag for names in entries(said(*words, "--help"), "Options") for flag in names.split(",")]


ALL = list(commands())


class Shells(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.TemporaryDirectory()
        cls.root = pathlib.Path(cls.folder.name)
        for shell in ("bash", "zsh", "fish"):
            (cls.root / shell).write_text(said("completion", shell))
        (cls.root / "run.log").write_text("")

    @classmethod
    def tearDownClass(cls):
        cls.folder.cleanup()

    def by_bash(self, *words):
        script = ('source "$1"; shift; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); COMPREPLY=(); _fencepost; '
                  'printf "%s\\n" "${COMPREPLY[@]}"')
        done = run("bash", "--norc", "-c", script, "bash", self.root / "bash", "fencepost", *words, cwd=self.root)
        self.assertEqual((done.returncode, done.stderr), (0, ""), words)
        return done.stdout.split()

    def test_bash_offers_each_command_and_option(self):
        self.assertGreater(len(ALL), 20)
        for words in ALL:
            if words:
                self.assertIn(words[-1], self.by_bash(*words[:-1], words[-1][:-1]))
            offered = self.by_bash(*words, "-")
            self.assertEqual(sorted(offered), sorted(options_of(words)), words)

    def test_bash_offers_values_and_files(self):
        self.assertEqual(self.by_bash("replay", "--profile", ""), ["micro", "small", "full"])
        self.assertEqual(self.by_bash("replay", "--profile", "=", "s"), ["small"])
        self.assertEqual(self.by_bash("replay", "--profile", "="), ["micro", "small", "full"])
        self.assertEqual(self.by_bash("replay", "--json", "ru"), ["run.log"])
        self.assertEqual(self.by_bash("replay", "--camera", "ru"), ["run.log"])
        self.assertEqual(self.by_bash("completion", ""), ["bash", "zsh", "fish"])
        self.assertEqual(self.by_bash("rep"), ["replay", "report"])
        self.assertEqual(self.by_bash("import", "m"), ["mrclam", "mcap"])
        self.assertEqual(self.by_bash("import", "--nonsense"), [])

    @unittest.skipUnless(shutil.which("zsh"), "no zsh")
    def test_zsh_reads_it(self):
        done = run("zsh", "-f", "-n", self.root / "zsh")
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        done = run("zsh", "-f", "-c", f'autoload -U compinit; compinit -D; source "{self.root}/zsh"; echo $_comps[fencepost]')
        self.assertEqual((done.stdout.strip(), done.stderr), ("_fencepost", ""))

    @unittest.skipUnless(shutil.which("fish"), "no fish")
    def test_fish_offers_the_same(self):
        done = run("fish", "--no-config", "-n", self.root / "fish")
        self.assertEqual((done.returncode, done.stderr), (0, ""))

        def by_fish(line):
            found = run("fish", "--no-config", "-c", f"source {self.root}/fish; complete -C '{line}'", cwd=self.root)
            return [row.split("\t")[0] for row in found.stdout.splitlines()]

        self.assertEqual(by_fish("fencepost replay --prof"), ["--profile"])
        self.assertEqual(sorted(by_fish("fencepost replay --profile ")), ["full", "micro", "small"])
        self.assertEqual(sorted(by_fish("fencepost rep")), ["replay", "report"])
        self.assertIn("csv", by_fish("fencepost import c"))


class Manual(unittest.TestCase):
    @unittest.skipUnless(shutil.which("man"), "no man")
    def test_pages_say_what_help_says(self):
        with tempfile.TemporaryDirectory() as folder:
            said("help", "--pages", folder)
            pages = sorted(p.name for p in pathlib.Path(folder).iterdir())
            self.assertEqual(pages, sorted("-".join(["fencepost", *words]) + ".1" for words in ALL))
            for words in ALL:
                page = pathlib.Path(folder) / ("-".join(["fencepost", *words]) + ".1")
                self.assertEqual(page.read_text(), said("help", "--roff", *words))
                self.compare(page, said(*words, "--help"), words)

    def compare(self, page, help_text, words):
        done = run("man", "--warnings=w", "-l", page, env={"MANWIDTH": "400", "LC_ALL": "C.UTF-8", "PATH": "/usr/bin:/bin"})
        self.assertEqual(done.stderr, "", words)
        text = done.stdout.lower().replace(":", "")
        shown = set(text.split())
        missing = [w for w in help_text.lower().replace(":", "").split() if w not in shown and w not in ("usage", "\\")]
        self.assertEqual(missing, [], words)


    def test_pages_have_the_usual_order(self):
        usual = ["NAME", "SYNOPSIS", "DESCRIPTION", "ARGUMENTS", "COMMANDS", "SUBCOMMANDS", "OPTIONS", "NOTES", "EXAMPLES", "SEE ALSO"]
        for words in ALL:
            found = re.findall(r'^\.SH "?([A-Z ]+?)"?$', said("help", "--roff", *words), re.MULTILINE)
            self.assertEqual(found, [name for name in usual if name in found], words)
            self.assertLessEqual({"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXAMPLES"}, set(found), words)


class Width(unittest.TestCase):
    """Whatever the width, lines keep within it, and are the same words."""

    def compare(self, text, columns, words):
        bare = lambda help_text: [word for word in help_text.split() if word != "\\"]  # noqa: E731
        self.assertEqual(bare(text), bare(said("help", *words)), words)
        for line in text.splitlines():
            if len(bare(line)) > 2:  # one long word, perhaps behind its name, may stick out
                self.assertLessEqual(len(line), columns, (words, line))

    def test_of_the_environment(self):
        for words in ALL:
            for columns in (40, 80, 100):
                done = run(PROGRAM, "help", *words, env={"COLUMNS": str(columns)})
                self.compare(done.stdout, columns, words)
            self.assertEqual(run(PROGRAM, "help", *words, env={}).stdout, run(PROGRAM, "help", *words, env={"COLUMNS": "80"}).stdout)

    def test_of_a_terminal(self):
        for columns in (50, 132):
            ours, theirs = pty.openpty()
            fcntl.ioctl(theirs, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
            with subprocess.Popen([PROGRAM, "run", "--help"], stdin=theirs, stdout=theirs, env={"COLUMNS": "200"}):
                os.close(theirs)
                text = ""
                while True:
                    try:
                        part = os.read(ours, 65536)
                    except OSError:  # all of it was read
                        break
                    text += part.decode()
            os.close(ours)
            self.compare(text.replace("\r\n", "\n"), columns, ["run"])

    def test_commands_can_be_copied(self):
        text = run(PROGRAM, "help", "run", env={"COLUMNS": "60"}).stdout
        examples = text[text.index("\nExamples:\n"):]
        self.assertIn(" \\\n      --", examples)
        whole = run(PROGRAM, "help", "run", env={"COLUMNS": "999"}).stdout
        self.assertEqual(re.sub(r" \\\n +", " ", examples), whole[whole.index("\nExamples:\n"):])


class Help(unittest.TestCase):
    def test_help_of_a_command_is_what_follows_it(self):
        for words in ALL:
            self.assertEqual(said("help", *words), said(*words, "--help"))

    def test_version(self):
        self.assertEqual(said("-V"), said("--version"))

    def test_guesses(self):
        for line, guess in {
            "replay --jsno x": "no option --jsno in fencepost replay; did you mean --json? See fencepost replay --help",
            "replay x --proflie=small": "no option --proflie in fencepost replay; did you mean --profile?",
            "import csv a --posse b": "no option --posse in fencepost import csv; did you mean --poses?",
            "replay -q x": "no option -q in fencepost replay; see fencepost replay --help",
            "--versoin": "did you mean --version?",
            "help repaly": "did you mean replay?",
            "help import cvs": "did you mean csv?",
            "completion bsh": "bsh",
        }.items():
            done = run(PROGRAM, *line.split())
            self.assertEqual((done.returncode, done.stdout), (2, ""), line)
            self.assertIn(guess, done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
