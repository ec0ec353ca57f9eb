#!/usr/bin/env python3
"""The check of registers compares a part that nobody makes; and each fault, planted, is found."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

CHECK = pathlib.Path(__file__).with_name("svd_check.py")
ROOT = CHECK.parents[2]

PART = """<device><peripherals>
  <peripheral><name>LINE0</name><baseAddress>0x40002000</baseAddress>
    <interrupt><name>LINE0_IRQ</name><value>9</value></interrupt>
    <registers>
      <register><name>ENABLE</name><addressOffset>0x500</addressOffset><fields><field><name>ENABLE</name><lsb>0</lsb><msb>3</msb>
        <enumeratedValues><enumeratedValue><name>On</name><value>0x4</value></enumeratedValue></enumeratedValues></field>
        <field><name>FAST</name><bitOffset>7</bitOffset><bitWidth>1</bitWidth></field></fields></register>
      <register><dim>4</dim><dimIncrement>4</dimIncrement><name>CC[%s]</name><addressOffset>0x540</addressOffset></register>
      <cluster><name>PSEL</name><addressOffset>0x508</addressOffset>
        <register><name>TXD</name><addressOffset>4</addressOffset><fields><field><name>PIN</name><bitRange>[4:0]</bitRange></field>
        </fields></register></cluster>
    </registers></peripheral>
  <peripheral derivedFrom="LINE0"><name>LINE1</name><baseAddress>0x40002300</baseAddress></peripheral>
</peripherals></device>"""
HEADER = """inline constexpr std::uint32_t kLine = 0x4000'2000;
inline constexpr std::uint32_t kStride = 0x300;
inline constexpr std::uint32_t kEnable = kLine + 0x500;  // what turns it on
inline constexpr std::uint32_t kOn = 1U << 2;
inline constexpr std::uint32_t kBoth = (1U << 2) | (1U << 7);
inline constexpr std::uint32_t kThird =
    0x548;
inline constexpr std::uint32_t kPin = kLine + 0x300 + 0x50C;
inline constexpr std::uint32_t kPinBits = 0x1F;
inline constexpr std::uint32_t kInterrupt = 9;
inline constexpr std::uint32_t kSize = 77;
"""
TABLE = """constant,part,other
kLine,LINE0,
kStride,LINE1-LINE0,
kEnable,LINE0.ENABLE,
kOn,LINE0.ENABLE.ENABLE=On,
kBoth,LINE0.ENABLE.ENABLE=4 + LINE0.ENABLE.FAST,
kThird,LINE0.CC[2],
kPin,LINE1.PSEL.TXD,
kPinBits,LINE0.PSEL.TXD.PIN,
kInterrupt,@LINE0_IRQ,
kSize,- a size,
"""


class SvdCheck(unittest.TestCase):
    def check(self, header=HEADER, table=TABLE, part=PART, name="PART.svd"):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "hal/mcu/part").mkdir(parents=True)
            (root / "tests/hal/mcu/registers").mkdir(parents=True)
            (root / "files").mkdir()
            (root / "hal/mcu/part/registers.hpp").write_text(header)
            (root / "tests/hal/mcu/registers/part.csv").write_text(table)
            if part:
                (root / "files" / name).write_text(part)
            done = subprocess.run([sys.executable, "-B", str(CHECK), folder, str(root / "files")], capture_output=True,
                                  text=True, check=False)
            return done.returncode, done.stdout + done.stderr

    def test_what_agrees_is_compared(self):
        code, output = self.check()
        self.assertEqual(code, 0, output)
        self.assertIn("part: 9 constants compared", output)
        self.assertIn("NOT COMPARED: other: there is no other.svd", output)

    def expect(self, text, **changes):
        code, output = self.check(**changes)
        self.assertEqual(code, 1, output)
        self.assertIn(text, output)

    def test_a_wrong_offset_bit_value_or_number_is_found(self):
        self.expect("kEnable is 0x40002504; part has 0x40002500 for LINE0.ENABLE", header=HEADER.replace("0x500;", "0x504;"))
        self.expect("kThird is 0x544; part has 0x548", header=HEADER.replace("0x548", "0x544"))
        self.expect("kOn is 0x8; part has 0x4", header=HEADER.replace("kOn = 1U << 2", "kOn = 1U << 3"))
        self.expect("kBoth is 0x44; part has 0x84", header=HEADER.replace("(1U << 7)", "(1U << 6)"))
        self.expect("kPinBits is 0xf; part has 0x1f", header=HEADER.replace("0x1F", "0xF"))
        self.expect("kInterrupt is 0x8; part has 0x9", header=HEADER.replace("= 9", "= 8"))
        self.expect("kStride is 0x400; part has 0x300", header=HEADER.replace("= 0x300", "= 0x400"))

    def test_a_constant_without_a_row_and_a_row_without_a_constant_are_found(self):
        self.expect("kNew is in no row", header=HEADER + "inline constexpr std::uint32_t kNew = 1;\n")
        self.expect("kSize is not in hal/mcu/part/registers.hpp", header=HEADER.replace("kSize", "kSizes"))
        self.expect("kSize: no reason", table=TABLE.replace("- a size", "-"))

    def test_names_that_the_vendor_does_not_have_are_found(self):
        self.expect("no register ENABEL in LINE0", table=TABLE.replace("LINE0.ENABLE,", "LINE0.ENABEL,"))
        self.expect("no field SLOW", table=TABLE.replace("ENABLE.FAST", "ENABLE.SLOW"))
        self.expect("no value Off", table=TABLE.replace("=On", "=Off"))
        self.expect("no interrupt LINE1_IRQ", table=TABLE.replace("@LINE0_IRQ", "@LINE1_IRQ"))

    def test_a_folder_without_files_is_no_success(self):
        code, output = self.check(part="")
        self.assertEqual(code, 77, output)
        self.assertIn("NOT COMPARED: part", output)

    # The vendors' files are not here, the tables are.
    def test_the_tables_have_every_constant_of_the_tree(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-B", str(CHECK), str(ROOT), folder], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 77, done.stdout)


unittest.main()
