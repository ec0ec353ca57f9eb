#!/usr/bin/env python3
"""usage: exports_test.py FENCEPOST_H LIBFENCEPOST_SO LIBFENCEPOST_CORE_A

The shared library exports the functions of the header and nothing else. In the static one a single object has a heap.
"""
import re
import subprocess
import sys
import unittest

HEADER, SHARED, STATIC = sys.argv[1:4]


def symbols(*arguments):
    return subprocess.run(["nm", *arguments], capture_output=True, text=True, check=True).stdout


class Exports(unittest.TestCase):
    def test_shared_library_exports_what_the_header_declares(self):
        with open(HEADER, encoding="utf-8") as file:
            code = re.sub(r"/\*.*?\*/", "", file.read(), flags=re.DOTALL)
        declared = set(re.findall(r"\bFENCEPOST_API\b[^;(]*?\b(fencepost_\w+)\(", code))
        exported = {line.split()[-1] for line in symbols("-D", "--defined-only", SHARED).splitlines()}
        self.assertGreater(len(declared), 20)
        self.assertEqual(declared, exported)

    def test_only_one_object_has_a_heap(self):
        with_heap, member = set(), ""
        for line in symbols(STATIC).splitlines():
            member = line[:-1] if line.endswith(":") else member
            if re.search(r"\bU (?:malloc|calloc|realloc|free|_Zn\w+|_Zd\w+)$", line):
                with_heap.add(member)
        self.assertEqual(with_heap, {"heap.cpp.o"})


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
