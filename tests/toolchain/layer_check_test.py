#!/usr/bin/env python3
"""Plants one fault of each kind in a small clean tree and expects exactly that fault, by file, line and rule."""

import unittest

from layer_check import check
from planted import Planted

CLEAN = {
    "CMakeLists.txt": "project(x)  # file(GLOB) would be refused\nadd_subdirectory(hal)\n",
    "README.md": "\n".join(["The top one may be long."] * 40),
    "LICENSE": "",
    ".gitignore": "/build/\n",
    "hal/CMakeLists.txt": "add_library(hal STATIC\n  base/a.cpp)\n",
    "hal/README.md": "\n" * 15,
    "hal/base/a.hpp": "#pragma once\n",
    "hal/base/a.cpp": '#include "hal/base/a.hpp"\n',
    "hal/bus/link.hpp": "#pragma once\n",
    "hal/linux/tty.hpp": "#include <memory>\nauto* p = new int(1);\n",
    "drivers/wire/w.hpp": "#pragma once\n",
    "drivers/d/d.hpp": '#include "drivers/wire/w.hpp"\n#include "hal/bus/link.hpp"\n',
    "drivers/e/e.hpp": "#pragma once\n",
    "firmware/record/s.hpp": "#pragma once\n",
    "firmware/loop/f.hpp": '#include "drivers/d/d.hpp"\n#include "hal/base/a.hpp"\n',
    "firmware/recon/r.hpp": '#include "firmware/recon/geometry.hpp"\n',
    "firmware/recon/geometry.hpp": '#include "hal/base/a.hpp"\n',
    "host/h.hpp": '#include <string>\n#include "firmware/loop/f.hpp"\n',
    "host/CMakeLists.txt": "add_executable(h ${CMAKE_CURRENT_SOURCE_DIR}/h.cpp ${PROJECT_SOURCE_DIR}/host/i.cpp)\n",
    "host/h.cpp": "auto* p = new int(1);\ndouble x = std::sin(1.0);\nvoid f() { throw 1; }\n",
    "host/i.cpp": '#include "host/h.hpp"\n',
    "host/j.hpp": "#pragma once\n",
    "tests/t.hpp": '#include "host/h.hpp"\n',
    "toolchain/setup": "",
}

# Rows of their own: the test holds whatever the tree's table says.
ROOMS = {
    "hal/base": "",
    "hal/bus": "hal/base",
    "hal/linux": "hal/bus",
    "drivers/wire": "hal/bus",
    "drivers/*": "drivers/wire",
    "firmware/recon/geometry": "hal/base",
    "firmware/recon": "firmware/recon/geometry",
    "firmware/record": "",
    "firmware/loop": "drivers/* firmware/recon firmware/record",
    "host/h": "firmware/loop",
    "host/i": "host/h",
    "host/j": "host/i",
}

# (file, text put at its end after one line of its own, rule)
FAULTS = [
    ("hal/base/a.hpp", '#include "firmware/loop/f.hpp"', "layer"),
    ("hal/base/a.hpp", '#  include "drivers/d/d.hpp"', "layer"),
    ("hal/linux/tty.hpp", '#include "drivers/d/d.hpp"', "layer"),
    ("drivers/d/d.hpp", '#include "firmware/loop/f.hpp"', "layer"),
    ("firmware/loop/f.hpp", '#include "host/h.hpp"', "layer"),
    ("host/h.hpp", '#include "tests/t.hpp"', "layer"),
    ("firmware/recon/r.hpp", '#include "hal/bus/link.hpp"', "seam"),
    ("firmware/recon/r.hpp", '#include "drivers/d/d.hpp"', "seam"),
    ("firmware/recon/geometry.hpp", '#include "firmware/recon/r.hpp"', "room"),
    ("firmware/recon/r.hpp", '#include "firmware/record/s.hpp"', "room"),
    ("firmware/loop/f.hpp", '#include "hal/linux/tty.hpp"', "room"),
    ("drivers/wire/w.hpp", '#include "drivers/d/d.hpp"', "room"),
    ("drivers/d/d.hpp", '#include "drivers/e/e.hpp"', "room"),
    ("host/h.hpp", '#include "host/j.hpp"', "room"),
    ("hal/base/a.cpp", '#include "a.hpp"', "include-path"),
    ("hal/base/a.cpp", '#include "hal/base/gone.hpp"', "include-path"),
    ("hal/base/a.cpp", '#include "hal/bus/../base/a.hpp"', "include-path"),
    ("hal/base/a.cpp", "#include <iostream>", "header"),
    ("drivers/d/d.hpp", "#include <cstdio>", "header"),
    ("firmware/loop/f.hpp", "#include <functional>", "header"),
    ("hal/base/a.hpp", "#include <string>", "header"),
    ("hal/base/a.hpp", "#include <vector>", "header"),
    ("hal/base/a.hpp", "#include <map>", "header"),
    ("hal/base/a.hpp", "#include <memory>", "header"),
    ("hal/base/a.hpp", "struct A { virtual ~A() = default; };", "word"),
    ("hal/base/a.cpp", "int* p = new int;", "word"),
    ("hal/base/a.cpp", "void f(int* p) { delete p; }", "word"),
    ("hal/base/a.cpp", "void* p = malloc(3);", "word"),
    ("hal/base/a.cpp", "void f() { throw 1; }", "word"),
    ("drivers/d/d.hpp", "void f() { try { g(); } ", "word"),
    ("firmware/loop/f.hpp", "auto* b = dynamic_cast<B*>(a);", "word"),
    ("firmware/loop/f.hpp", "auto b = std::bit_cast<int>(1.0F);", "word"),
    ("firmware/recon/r.hpp", "float x = std::sin(1.0F);", "libm"),
    ("firmware/recon/r.hpp", "float x = atan2f(1.0F, y);", "libm"),
    ("firmware/recon/r.hpp", "float x = (::exp (1.0F));", "libm"),
    ("firmware/recon/r.hpp", "float x = -hypot(1.0F, y);", "libm"),
    ("firmware/recon/r.hpp", "float x = std :: cbrt(y);", "libm"),
    ("firmware/recon/r.hpp", "/* one\n*/ float x = std::pow(1.0F, y);", "libm"),
    ("host/CMakeLists.txt", "file(GLOB sources *.cpp)", "glob"),
    ("host/CMakeLists.txt", "FILE (GLOB_RECURSE sources *.cpp)", "glob"),
    ("hal/CMakeLists.txt", "add_compile_options(-f" "fast-math)", "fast-math"),
    ("hal/base/a.hpp", "// TO" "DO: later", "unfinished"),
    ("README.md", "FIX" "ME", "unfinished"),
    ("toolchain/setup", "cd /ho" "me/someone/project", "machine-path"),
    ("tests/t.hpp", '// as in "/wo' 'rk/main/x"', "machine-path"),
]

# Texts that look like a fault and are none.
INNOCENT = [
    ("hal/base/a.cpp", "// a new one; we throw nothing, std::sin(x) is refused"),
    ("hal/base/a.cpp", '/* #include "firmware/loop/f.hpp"\n new */'),
    ("hal/base/a.cpp", 'const char* s = "try a new sin(x) // and on"; int n = 1\'000\'000;'),
    ("hal/base/a.cpp", "const char* s = R\"(throw \" new)\"; char c = '\"';"),
    ("hal/base/a.cpp", "A(const A&) = delete;\nint renewed = newer(retry);"),
    ("hal/base/a.cpp", "#include <cmath>\nfloat x = std::sqrt(y) + p.cos * basin(2) + sine(y);"),
    ("hal/base/a.cpp", "struct A { ~A() = default; virtual void f() = 0; };"),
    ("toolchain/setup", "mount ${root}/home/x; see example.org/home/ and /dev/ttyUSB0"),
]


class LayerCheck(Planted):
    FILES = CLEAN

    def found(self, rooms=ROOMS, counted_as=None):
        faults, checked = check(self.root, rooms, counted_as or {})
        self.assertGreater(checked, 0)
        return [(file, line, rule) for file, line, rule, _ in faults]

    def test_the_clean_tree_is_clean(self):
        self.assertEqual(self.found(), [])

    def test_each_planted_fault_is_found_where_it_is(self):
        for name, text, rule in FAULTS:
            with self.subTest(name=name, text=text):
                path = self.root / name
                path.write_text(CLEAN[name] + "\n" + text + "\n")
                line = CLEAN[name].count("\n") + 2 + text.count("\n")
                self.assertEqual(self.found(), [(name, line, rule)])
                path.write_text(CLEAN[name])

    def test_what_only_looks_like_a_fault_is_left_alone(self):
        for name, text in INNOCENT:
            with self.subTest(text=text):
                path = self.root / name
                path.write_text(CLEAN[name] + "\n" + text + "\n")
                self.assertEqual(self.found(), [])
                path.write_text(CLEAN[name])

    def test_an_unlisted_source_is_found(self):
        (self.root / "drivers/d/d.cpp").write_text("")
        self.assertEqual(self.found(), [("drivers/d/d.cpp", 1, "unlisted")])

    def test_a_source_may_be_listed_by_a_pattern(self):
        (self.root / "drivers/d/d.cpp").write_text("")
        lists = self.root / "drivers/CMakeLists.txt"
        lists.write_text("file(GLOB s CONFIGURE_DEPENDS RELATIVE \"${CMAKE_CURRENT_SOURCE_DIR}\" ${driver}/*.cpp)\n")
        self.assertEqual(self.found(), [])
        lists.write_text("file(GLOB s CONFIGURE_DEPENDS ${driver}/*_test.cpp)\n")
        self.assertEqual(self.found(), [("drivers/d/d.cpp", 1, "unlisted")])

    def test_a_cycle_is_found_though_the_table_allows_each_of_its_edges(self):
        rooms = {**ROOMS, "host/h": "firmware/loop host/j", "host/j": "host/i"}
        self.assertEqual(self.found(rooms), [])
        (self.root / "host/h.hpp").write_text('\n#include "host/j.hpp"\n')
        self.assertEqual(self.found(rooms), [])
        (self.root / "host/j.hpp").write_text('#include "host/i.hpp"\n')
        (self.root / "host/i.hpp").write_text('#include "host/h.hpp"\n')
        self.assertEqual(self.found(rooms), [("host/h.hpp", 2, "room-cycle")])

    def test_a_file_may_count_as_another_room(self):
        (self.root / "hal/base/odd.hpp").write_text('#include "hal/bus/link.hpp"\n')
        self.assertEqual(self.found(), [("hal/base/odd.hpp", 1, "room")])
        self.assertEqual(self.found(counted_as={"hal/base/odd": "hal/bus"}), [])

    def test_a_room_without_a_row_a_row_without_a_room_and_a_misspelt_one_are_found(self):
        rooms = {**ROOMS, "host/gone": "", "host/i": "host/h host/x"}
        (self.root / "host/new").mkdir()
        (self.root / "host/new/n.hpp").write_text('#include "host/h.hpp"\n')
        faults = [("host/gone", 1, "room"), ("host/i", 1, "room"), ("host/new/n.hpp", 1, "room")]
        self.assertEqual(self.found(rooms), faults)

    def test_a_long_readme_is_found(self):
        (self.root / "host/share/doc").mkdir(parents=True)
        for name in ("hal/README.md", "README.md", "host/share/doc/README.md"):
            (self.root / name).write_text("line\n" * 16)
        self.assertEqual(self.found(), [("hal/README.md", 16, "readme-length")])

    def test_what_a_repository_has_for_its_visitors_is_no_stranger(self):
        (self.root / ".github").mkdir()
        for name in (".github/CONTRIBUTING.md", "CHANGELOG.md", "CITATION.cff", ".editorconfig"):
            (self.root / name).write_text("")
        self.assertEqual(self.found(), [])

    def test_a_stranger_at_the_top_is_found(self):
        (self.root / "docs").mkdir()
        self.assertEqual(self.found(), [("docs", 1, "top-level")])

    def test_build_folders_are_nobodys_business(self):
        (self.root / "build/host").mkdir(parents=True)
        (self.root / "build/host/a.cpp").write_text("int* p = new int;  // TO" "DO")
        self.assertEqual(self.found(), [])


if __name__ == "__main__":
    unittest.main()
