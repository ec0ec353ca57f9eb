#!/usr/bin/env python3
"""Proves that coverage.py fails where it has to: too few lines, a branch never taken, a source that nothing compiles."""

import contextlib
import io
import pathlib
import tempfile
import unittest

import coverage

SOURCE = """void feed(int byte) {
  if (byte > 3) stop();
  FENCEPOST_CHECK(byte >= 0);
}
"""


def line(number, count, *ways):
    return {"line_number": number, "count": count, "branches": [{"count": way, "throw": False} for way in ways]}


def document(root, *lines, name="drivers/cmucam/decoder.cpp"):
    return {"current_working_directory": str(root / "build"), "files": [{"file": f"../{name}", "lines": list(lines)}]}


class Coverage(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)
        self.source = self.root / "drivers/cmucam/decoder.cpp"
        self.source.parent.mkdir(parents=True)
        self.source.write_text(SOURCE)
        for other in ("hal", "firmware"):
            (self.root / other).mkdir()

    def judged(self, *documents):
        all_rooms = [document(self.root, line(1, 1), name=f"{room}/a.hpp") for room in ("hal", "firmware")]
        files = coverage.collect([*documents, *all_rooms], self.root)
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            enough = coverage.report(files, self.root, 95, coverage.sources(self.root))
        return enough, said.getvalue()

    def test_all_is_run(self):
        enough, said = self.judged(document(self.root, line(1, 5), line(2, 5, 2, 3), line(3, 5, 5, 0)))
        self.assertTrue(enough, said)
        self.assertIn("| drivers | 3 | 3 | 100.0 |", said)

    def test_a_branch_never_taken(self):
        enough, said = self.judged(document(self.root, line(1, 5), line(2, 5, 0, 5), line(3, 5)))
        self.assertFalse(enough)
        self.assertIn("drivers/cmucam/decoder.cpp:2: 1 of 2 branches never taken: if (byte > 3) stop();", said)

    def test_two_programs_together(self):
        enough, said = self.judged(document(self.root, line(1, 5), line(2, 5, 0, 5)),
                                   document(self.root, line(1, 1), line(2, 1, 1, 0)))
        self.assertTrue(enough, said)

    def test_branches_elsewhere_do_not_count(self):
        self.source.rename(self.root / "drivers/cmucam/session.cpp")
        enough, said = self.judged(document(self.root, line(2, 5, 0, 5), name="drivers/cmucam/session.cpp"))
        self.assertTrue(enough, said)

    def test_too_few_lines(self):
        enough, said = self.judged(document(self.root, line(1, 5), line(2, 0, 0, 0), line(3, 0)))
        self.assertFalse(enough)
        self.assertIn("| drivers | 3 | 1 | 33.3 |", said)
        self.assertIn("drivers/cmucam/decoder.cpp: 2 lines not run", said)

    def test_a_source_in_no_test(self):
        (self.root / "hal/forgotten.cpp").write_text("")
        enough, said = self.judged(document(self.root, line(1, 5)))
        self.assertFalse(enough)
        self.assertIn("hal/forgotten.cpp: in no unit test", said)

    def test_a_source_without_lines_is_in_a_test_where_its_object_ran(self):
        objects = self.root / "build/hal/CMakeFiles/hal.dir"
        (objects / "Unity").mkdir(parents=True)
        for unity, source in (("unity_0_cxx.cxx", "table.cpp"), ("unity_1_cxx.cxx", "never.cpp")):
            (objects / "Unity" / unity).write_text(f'#define X\n#include "{self.root}/hal/{source}"\n')
        (objects / "Unity/unity_0_cxx.cxx.gcda").write_text("")
        (objects / "base").mkdir()
        (objects / "base/apart.cpp.gcda").write_text("")
        self.assertEqual(coverage.compiled(self.root / "build", self.root), {"hal/table.cpp", "hal/base/apart.cpp"})

    def test_lines_not_run_are_told(self):
        files = coverage.collect([document(self.root, line(1, 5), line(2, 0))], self.root)
        self.assertEqual(list(coverage.lines_not_run(files, self.root)),
                         ["drivers/cmucam/decoder.cpp:2: if (byte > 3) stop();"])

    def test_a_call_that_may_throw_is_no_branch(self):
        ways = [{"count": 0, "throw": False}, {"count": 0, "throw": True}, {"count": 3, "throw": False}]
        self.assertEqual(coverage.decisions(ways), [3])

    def test_other_files_are_none_of_ours(self):
        files = coverage.collect([document(self.root, line(1, 1), name="tests/a.cpp"),
                                  document(self.root, line(1, 1), name="../usr/include/vector")], self.root)
        self.assertEqual(files, {})


if __name__ == "__main__":
    unittest.main()
