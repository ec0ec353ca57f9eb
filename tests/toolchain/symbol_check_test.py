#!/usr/bin/env python3
"""usage: symbol_check_test.py COMPILER

Compiles a tiny offender of each kind and expects symbol_check.py to name the kind.
"""

import pathlib
import subprocess
import sys
import unittest

from planted import Planted

HERE = pathlib.Path(__file__).parent
COMPILER = "c++"

OFFENDERS = {
    "heap": "int* f() { return new int; }",
    "exceptions": "int f(int x) { if (x > 0) throw x; return x; }",
    "run-time types": "struct A { virtual void g(); }; struct B : A {}; B* f(A* a) { return dynamic_cast<B*>(a); }",
    "guarded statics": "int g(); int f() { static int x = g(); return x; }",
    "destructors at exit": "struct A { A(); ~A(); }; A a;",
    "printf and scanf": '#include <cstdio>\nvoid f(int x) { std::printf("%d", x); }',
    "streams, strings, locales": '#include <iostream>\nvoid f() { std::cout << "x"; }',
    "assert of the C library": "#include <cassert>\nvoid f(int x) { assert(x > 0); }",
    "libm that differs between C libraries": "#include <cmath>\nfloat f(float x) { return std::sin(x); }",
}
INNOCENT = """
#include <cmath>
#include <cstring>
int cosine(float x);
void send(const char* text, unsigned long size);
float f(float x, char* to, const char* from, unsigned long n) {
  std::memmove(to, from, n);
  send(to, n);
  return std::sqrt(x) + static_cast<float>(cosine(x));
}
"""


class SymbolCheck(Planted):
    def check(self, source, *options):
        (self.root / "a.cpp").write_text(source)
        object_file = str(self.root / "a.o")
        subprocess.run([COMPILER, "-std=c++20", "-O2", "-c", str(self.root / "a.cpp"), "-o", object_file], check=True)
        archive = str(self.root / "a.a")
        subprocess.run(["ar", "rcs", archive, object_file], check=True)
        command = [sys.executable, "-B", str(HERE / "symbol_check.py"), *options, archive]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        return done.returncode, done.stdout

    def test_each_offender_is_named(self):
        for kind, source in OFFENDERS.items():
            with self.subTest(kind=kind):
                status, output = self.check(source)
                self.assertEqual(status, 1)
                self.assertIn(f": {kind}\n", output)
                self.assertIn("a.a(a.o): ", output)

    def test_what_is_harmless_passes(self):
        status, output = self.check(INNOCENT)
        self.assertEqual((status, output), (0, output))
        self.assertIn(" 0 banned", output)

    def test_an_exception_to_the_rule_is_by_name(self):
        source = OFFENDERS["assert of the C library"]
        self.assertEqual(self.check(source, "--allow", "__assert_fail")[0], 0)

    def test_nothing_to_check_is_a_fault(self):
        self.assertEqual(self.check("int f() { return 1; }")[0], 1)


if __name__ == "__main__":
    if len(sys.argv) > 1:
        COMPILER = sys.argv.pop(1)
    unittest.main()
