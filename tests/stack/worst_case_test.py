#!/usr/bin/env python3
"""The stack check can fail: each fault, planted in a small call graph, is reported."""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).with_name("worst_case.py")


def graph(*nodes, edges=()):
    lines = ['graph: { title: "x.cpp"']
    lines += [f'node: {{ title: "{name}" label: "{name}\\nx.cpp:1:1\\n{size} bytes ({kind})\\n0 dynamic objects" }}'
              for name, size, kind in nodes]
    lines += [f'edge: {{ sourcename: "{a}" targetname: "{b}" label: "x.cpp:1:1" }}' for a, b in edges]
    return "\n".join([*lines, "}"])


class WorstCase(unittest.TestCase):
    def run_on(self, text, *budgets):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "x.ci").write_text(text)
            done = subprocess.run([sys.executable, str(CHECK), folder, *budgets], capture_output=True, text=True,
                                  check=False)
            return done.returncode, done.stdout + done.stderr

    def test_adds_up_the_deepest_path(self):
        text = graph(("root", 16, "static"), ("a", 100, "static"), ("b", 40, "static"), ("c", 80, "dynamic,bounded"),
                     edges=[("root", "a"), ("root", "b"), ("b", "c")])
        self.assertEqual(self.run_on(text, "root=136")[0], 0)
        code, output = self.run_on(text, "root=135")
        self.assertEqual(code, 1)
        self.assertIn("worst case 136 of 135", output)

    def test_refuses_what_it_cannot_bound(self):
        cases = {"recursion": graph(("root", 1, "static"), ("a", 1, "static"), edges=[("root", "a"), ("a", "root")]),
                 "unknown size": graph(("root", 8, "dynamic")),
                 "through a pointer": graph(("root", 8, "static"), edges=[("root", "__indirect_call")]),
                 "unknown outside function printf": graph(("root", 8, "static"), edges=[("root", "printf")])}
        for expected, text in cases.items():
            code, output = self.run_on(text, "root=1000")
            self.assertEqual(code, 1, expected)
            self.assertIn(expected, output)

    def test_passes_over_the_graph_of_an_object_that_is_optimised_at_link_time(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "program.ltrans0.ci").write_text(graph(("root", 16, "static")))
            pathlib.Path(folder, "x.cpp.ci").write_text(graph(("root", 8, "static"), edges=[("root", "printf")]))
            for content, code in ((b"code", 1), (b"\0.gnu.lto_.opts\0", 0)):
                pathlib.Path(folder, "x.cpp.obj").write_bytes(content)
                done = subprocess.run([sys.executable, str(CHECK), folder, "root=16"], capture_output=True, check=False)
                self.assertEqual(done.returncode, code, content)

    def test_passes_over_the_graph_of_an_object_that_nothing_builds_any_more(self):
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "x.cpp.ci").write_text(graph(("root", 16, "static")))
            pathlib.Path(folder, "gone.cpp.ci").write_text(graph(("root", 16, "static"), edges=[("root", "printf")]))
            for built, code in ((["x.cpp.obj", "gone.cpp.obj"], 1), (["x.cpp.obj"], 0)):
                commands = [{"directory": folder, "command": f"g++ -o {file} -c x.cpp"} for file in built]
                pathlib.Path(folder, "compile_commands.json").write_text(json.dumps(commands))
                done = subprocess.run([sys.executable, str(CHECK), folder, "root=16"], capture_output=True, check=False)
                self.assertEqual(done.returncode, code, built)

    def test_finds_a_template_where_it_is_defined(self):
        text = graph(("root", 16, "static"), ("t.cpp:_Z1tIiEvv", 100, "static"), ("u.cpp:_Z1tIiEvv", 40, "static"),
                     edges=[("root", "_Z1tIiEvv")])
        self.assertEqual(self.run_on(text, "root=116")[0], 0)
        self.assertEqual(self.run_on(text, "root=115")[0], 1)

    def test_refuses_to_compare_nothing(self):
        self.assertNotEqual(self.run_on(graph(("other", 8, "static")), "root=1000")[0], 0)
        with tempfile.TemporaryDirectory() as folder:
            self.assertNotEqual(subprocess.run([sys.executable, str(CHECK), folder, "root=1"], capture_output=True,
                                               check=False).returncode, 0)


unittest.main()
