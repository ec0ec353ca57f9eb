#!/usr/bin/env python3
"""usage: switchable_test.py

switchable.py on small texts, and on the tuned numbers of this tree: each is switchable, or in its list of those that cannot be.
"""

import pathlib
import re
import sys
import unittest

sys.dont_write_bytecode = True  # a checkout stays as it is
import switchable  # noqa: E402

TOP = pathlib.Path(__file__).resolve().parents[3]
TUNING = "firmware/recon/room/tuning.hpp"


def of(line, **others):
    files, numbers = switchable.tree({TUNING: "#pragma once\n" + line + "\n", **others}, replaced={})
    return files[TUNING].split("\n")[2], numbers, files


class Switchable(unittest.TestCase):
    def test_a_scalar(self):
        line, numbers, _ = of("inline constexpr float kGate = 3.0F;")
        self.assertEqual(line, 'inline const float kGate = tuned<float>("kGate", 3.0F, 0);')
        self.assertEqual(numbers, [("kGate", "3.0", False, "room")])

    def test_a_share_near_one(self):
        self.assertIn(', 0.95F, 1)', of("inline constexpr float kSameDepth = 0.95F;")[0])

    def test_a_duration(self):
        line, numbers, _ = of("/// Derived: five.\ninline constexpr base::Duration kWait{5 * kMoment.raw};")
        self.assertEqual(numbers, [("kWait", "5 * kMoment.raw", True, "room")])

    def test_what_is_by_design_is_not_tuned(self):
        _, numbers, _ = of("/// By design: a rule.\ninline constexpr int kRule = 4;")
        self.assertEqual(numbers, [("kRule", "4", True, "room")])

    def test_a_structure_but_for_what_switches(self):
        line, numbers, _ = of("inline constexpr Pace kPace{{0.04F, 80'000}, {0, -1}, true};")
        self.assertEqual(line, 'inline const Pace kPace{{Tuned{"kPace.0", 0.04F, 0}, Tuned{"kPace.1", 80\'000, 0}}, {0, -1}, true};')
        self.assertEqual([number.value for number in numbers], ["0.04", "80000"])

    def test_what_is_computed_from_one_is_no_constant_either(self):
        code = "static_assert(kTwice > 1);\nconstexpr float kTwice = 2 * kGate;\nconstexpr float kOther = 2;\n"
        files = of("inline constexpr float kGate = 3.0F;", **{"firmware/a.cpp": code})[2]
        self.assertEqual(files["firmware/a.cpp"], "\ninline const float kTwice = 2 * kGate;\nconstexpr float kOther = 2;\n")

    def test_each_number_of_the_tree(self):
        declared, found = set(), set()
        for path in (TOP / "firmware/recon").rglob("tuning.hpp"):
            text = path.read_text(encoding="utf-8")
            declared |= set(re.findall(r"^inline constexpr [^;{=]*?\b(k\w+)\s*[={]", text, re.M))
            found |= {number.name.split(".")[0] for number in switchable.switchable(text, "")[1]}
        self.assertGreater(len(found), 100)
        self.assertEqual(declared - found, switchable.FIXED)


if __name__ == "__main__":
    unittest.main()
