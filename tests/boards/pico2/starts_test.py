#!/usr/bin/env python3
"""usage: starts_test.py IMAGES TABLES [unittest's arguments]

The images of the boards with an RP2350, started as the boot ROM does it: from a reset, and after a debugger. Each has to
come up at the right speed and break no rule of the part. It drives no pin that its board reserves, and holds the motors.
IMAGES: the preset's folder. TABLES: tests/hal/boards.
"""

import csv
import pathlib
import re
import sys
import unittest

from unicorn import arm_const as arm

from rp2350 import (CLOCKS, FLASH, HELD, IO, PADS, PLL_SYS, PLL_USB, PWM, RESETS, SIO, SOFTWARE, TICKS, TIMER, TIMER_TICK, UART0, USB,
                    WATCHDOG, XOSC, I2C0, Part)
from core import RETURN, SYSTICK, SYSTICK_RELOAD, VTOR, Core  # by rp2350's path
from elf import output_of
from settings import page_with

IMAGES = pathlib.Path(sys.argv.pop(1))
TABLES = pathlib.Path(sys.argv.pop(1))
ROM = 0  # its vector table
SETTINGS = 2 * 1024 * 1024 - 2 * 4096  # hal/mcu/rp2/flash.hpp
BOARDS = {"pico2": "fencepost.elf", "xrp2": "fencepost-xrp2.elf"}
STOP = {"pico2": 15, "xrp2": 0}
MOTORS = {"pico2": (16, 17), "xrp2": (32, 33, 34, 35)}
SLICES = {"pico2": (0,), "xrp2": (8, 9)}  # of the modulator (12.5.1)
MEANT = ("", "led", "left motor", "right motor")


def from_reset(_part):
    pass


def on_plls(part):
    """A program that a debugger has ended: the core and USB on their PLLs, peripherals on."""
    part.held = 0
    part.crystal_since = -1.0
    part.pll_since = {PLL_SYS: -1.0, PLL_USB: -1.0}
    for base, first in ((PLL_SYS, 5), (PLL_USB, 5)):
        part.words.update({base: 1, base + 4: 0, base + 8: 125 if base == PLL_SYS else 100,
                           base + 0xC: first << 16 | (2 if base == PLL_SYS else 5) << 12})
    part.words.update({CLOCKS + 0x30: 2, CLOCKS + 0x34: 1 << 16, CLOCKS + 0x3C: 1, CLOCKS + 0x60: 1 << 11, CLOCKS + 0x48: 1 << 11})


def other_table(part):
    part.started_by_rom = True
    part.system[VTOR] = ROM


def interrupts_on(part):
    part.enabled |= {0, 14, 33, 40}
    part.pending |= {0, 14, 33, 40}


def ticks_on(part):
    part.system[SYSTICK_RELOAD] = 15_999
    part.system[SYSTICK] = 7
    part.pending.add("tick")


def watchdog_on(part):
    """Most of its time is over."""
    part.words.update({TICKS + 0x30: 1, TICKS + 0x34: 12, WATCHDOG: 1 << 30})
    part.watchdog_until = 0.1


def stop_high(part):
    """The motors of the program before may drive."""
    part.words.update({SIO + 0x10 + 4 * bank: 0xFFFFFFFF for bank in (0, 1)})
    for pin in range(48):
        part.words[PADS + 4 + 4 * pin] = 0x16
        part.words[IO + 4 + 8 * pin] = SOFTWARE


def everything(part):
    for leave in (on_plls, other_table, interrupts_on, ticks_on, Core.use_other_stack, watchdog_on, stop_high):
        leave(part)


STARTS = [from_reset, on_plls, other_table, interrupts_on, ticks_on, Core.mask_interrupts, Core.use_other_stack, watchdog_on, stop_high, everything]


def start(board, leave=from_reset, seconds=0.15, part_of=Part, **options):
    class OfBoard(part_of):
        STOP = STOP[board]

    part = OfBoard(IMAGES / BOARDS[board], **options)
    leave(part)
    part.run(seconds)
    return part


class Starts(unittest.TestCase):
    def expect_up(self, board, part):
        said = part.lines[UART0].sent.decode(errors="replace")
        self.assertEqual((part.stop_reason, part.faults), (None, []), said)
        self.assertGreater(part.interrupts, 50)
        self.assertGreater(part.fed, 50, "the loop runs")
        self.assertEqual(part.pin(STOP[board]), (SOFTWARE, True, 0), "nothing is seen yet: the motors are held")
        self.assertNotIn(True, [level for _, level in part.stop_levels[1:]], "nor were they free before")
        for pin in MOTORS[board]:
            self.assertEqual(part.pin(pin), (SOFTWARE, True, 0))
        for n in SLICES[board]:
            on, divider, wrap = (part.words[PWM + 0x14 * n + register] for register in (0x00, 0x04, 0x10))
            self.assertEqual((on, part.core_hz() / (divider / 16) / (wrap + 1)), (1, 50))
        if board == "pico2":
            self.assertTrue(said.startswith("fencepost 0.1.0 for pico2, profile small\r\n"), said)
            self.assertIn("READY\r\n", said)

    def test_every_start_of_every_board(self):
        for board in BOARDS:
            for leave in STARTS if board == "pico2" else (from_reset, everything):
                with self.subTest(board=board, start=leave.__name__):
                    part = start(board, leave)
                    self.expect_up(board, part)
                    self.assertEqual(part.core_hz(), 150_000_000)
                    self.assertLess(abs(part.count() / 1e6 / (part.seconds - part.timer[0]) - 1), 1e-4)
                    self.assertTrue(part.words[USB + 0x4C] & 1 << 16, "USB is there")
                    for baud in part.lines[UART0].bauds:
                        self.assertLess(abs(baud / 115_200 - 1), 0.005)

    def test_chips_whose_ring_is_faster_start_too(self):
        class A3(Part):
            ring_divider = 4

        self.expect_up("pico2", start("pico2", part_of=A3))

    def test_without_its_crystal_it_runs_on_the_ring(self):
        for divider in (1, 4):
            class OnRing(Part):
                ring_divider = divider

            part = start("pico2", seconds=1.0, part_of=OnRing, has_crystal=False)
            self.assertEqual((part.stop_reason, part.faults), (None, []))
            self.assertIn(b"READY\r\n", part.lines[UART0].sent)
            self.assertEqual(part.core_hz(), 11e6)
            self.assertFalse(part.words.get(USB + 0x4C, 0) & 1 << 16, "no clock for USB")
            for baud in part.lines[UART0].bauds:
                self.assertLess(abs(baud / 115_200 - 1), 0.01)

    def test_a_setting_is_kept(self):
        part = start("pico2")
        part.lines[UART0].here.extend(b"set alert.stop 0.41\r\n")
        part.run(1.0)
        self.assertEqual((part.stop_reason, part.faults), (None, []))
        self.assertTrue(part.programmed, part.lines[UART0].sent)
        self.assertTrue(all(SETTINGS <= offset < SETTINGS + 8192 for offset in part.programmed + part.erased))
        self.assertIn(b"$FPCFG,alert.stop,0.41*", bytes(part.uc.mem_read(FLASH + SETTINGS, 8192)))

    def test_a_board_has_a_serial_number_of_its_own(self):
        device, string = 0x100, 0x300
        for chip_id in (0xE6C1D8FA03B5720F, 0xE6C1D8FA03B57210):
            for leave in (from_reset, everything):
                part = start("pico2", leave, seconds=0.02, chip_id=chip_id)
                self.assertEqual(part.describe(device)[16], 3)
                self.assertEqual(part.describe(string | 3), b"\x22\x03" + f"{chip_id:016X}".encode("utf-16-le"))
                self.assertIsNone(part.describe(string | 4))
                self.assertEqual((part.stop_reason, part.faults), (None, []))

    def test_a_chip_without_an_id_has_no_serial_number(self):
        for chip_id in (None, 0, 0xFFFFFFFFFFFFFFFF):
            part = start("pico2", seconds=0.02, chip_id=chip_id)
            self.assertEqual(part.describe(0x100)[16], 0)
            self.assertIsNone(part.describe(0x303))
            self.assertEqual((part.stop_reason, part.faults), (None, []))

    def test_a_camera_on_the_bus_is_spoken_to(self):
        part = start("xrp2")
        self.assertEqual(part.targets, set())
        part = start("pico2")
        part.lines[UART0].here.extend(b"set camera pixy2_i2c\r\n")
        part.run(0.5)
        self.assertEqual((part.stop_reason, part.faults, part.targets), (None, [], {0x54}), part.lines[UART0].sent)
        high, low = part.words[I2C0 + 0x1C], part.words[I2C0 + 0x20]
        self.assertEqual(part.core_hz() / (high + low), 100_000)

    def test_wheels_are_counted(self):
        part = start("xrp2", lambda part: part.uc.mem_write(FLASH + SETTINGS, page_with("odometry,encoders")))
        a, b = 30, 31
        for n in range(8):  # forwards, A leads: two periods
            pin = (a, b)[n % 2]
            part.words[PADS + 4 + 4 * pin] ^= 8  # pulled up, or not
            part.words[IO + 0x230 + 4 * (pin // 8)] = 0xF << 4 * (pin % 8)
            if part.words.get(IO + 0x248 + 4 * (pin // 8), 0) >> 4 * (pin % 8) & 0xC:
                part.pending.add(21)
            part.run(0.001)
        self.assertEqual((part.stop_reason, part.faults), (None, []))
        left, = (address for name, address in part.symbols.items() if "board" in name and name.endswith("4leftE"))
        self.assertEqual(int.from_bytes(part.uc.mem_read(left + 8, 4), "little"), 8)  # behind its two pins

    def test_1200_baud_is_asked_of_usb_and_answered_by_the_rom(self):
        part = start("pico2")
        loader = next(address for name, address in part.symbols.items() if "start_boot_loader" in name)
        part.uc.reg_write(arm.UC_ARM_REG_LR, RETURN | 1)
        part.pc = loader & ~1
        part.run(0.01)
        self.assertEqual(part.stop_reason, "the boot ROM resets the part, 0x102")


class Rules(unittest.TestCase):
    def test_no_board_drives_a_pin_that_it_reserves(self):
        for board in BOARDS:
            lines = [line for line in (TABLES / f"{board}.csv").read_text().splitlines() if not line.startswith("#")]
            reserved = {row["pin"]: row["reserved"] for row in csv.DictReader(lines)}
            part, driven = start(board, seconds=0.02), 0
            for pin in range(48):
                if part.pin(pin)[0] in (2, SOFTWARE) and part.pin(pin)[1]:
                    driven += 1
                    self.assertIn(reserved[f"GP{pin}"], MEANT, f"{board}: GP{pin}")
            self.assertGreaterEqual(driven, 4, board)

    def test_the_stack_has_a_limit(self):
        def limit_of(part):
            part.until = part.next_look = float("inf")
            part.uc.mem_write(RETURN + 0x100, b"\xef\xf3\x0a\x80")  # mrs r0, msplim
            part.uc.emu_start(RETURN + 0x101, RETURN + 0x104)
            return part.uc.reg_read(arm.UC_ARM_REG_R0)

        def without(part):
            listing = output_of("arm-none-eabi-objdump", IMAGES / BOARDS["pico2"])
            for address in re.findall(r"^ *([0-9a-f]+):\tmsr\tMSPLIM", listing, re.MULTILINE):
                kept = int(address, 16) - part.table + part.symbols["image_program_source"]
                part.uc.mem_write(kept, b"\x00\xbf" * 2)

        part = start("pico2", seconds=0.02)
        self.assertEqual(limit_of(part), part.symbols["image_stack_bottom"])
        self.assertEqual(limit_of(start("pico2", without, seconds=0.02)), 0)

    # A program that leaves a step out is found: here each step in turn has no effect.
    def without(self, unheard, leave=from_reset, system=False, seconds=0.15, board="pico2"):
        class Deaf(Part):
            def write(self, uc, offset, size, value, region):
                if system or not unheard(self, region + offset, value):
                    super().write(uc, offset, size, value, region)

            def write_system(self, uc, offset, size, value, data):
                if not system or not unheard(self, offset, value):
                    super().write_system(uc, offset, size, value, data)

        return start(board, leave, seconds, Deaf)

    def test_an_image_without_its_block_is_found(self):
        class Blank(Part):
            def load(self, image):
                super().load(image)

            def begin(self):
                self.uc.mem_write(FLASH + 8, b"\xff" * 20)
                super().begin()

        self.assertIn("the boot ROM finds no image in the first 4 KB of the flash", start("pico2", part_of=Blank, seconds=0.001).faults)

    def test_a_pad_that_stays_isolated_is_found(self):
        part = self.without(lambda _, address, __: address & ~0x7FFF == PADS)
        self.assertIsNone(part.pin(STOP["pico2"])[0])

    def test_an_input_that_is_pulled_down_is_found(self):
        part = Part(IMAGES / BOARDS["pico2"])
        part.held = 0
        part.write(None, PADS + 4 + 4 * 15 - 0x40000000, 4, 0x56, 0x40000000)
        self.assertEqual(part.faults, ["GP15 is an input that is pulled down (RP2350-E9)"])

    def test_a_vector_table_that_is_not_set_is_found(self):
        part = self.without(lambda _, offset, __: offset == VTOR, other_table, system=True)
        self.assertIn("by a vector table at 00000000", part.stop_reason)

    def test_a_core_that_stays_on_its_pll_is_found(self):
        part = self.without(lambda _, address, __: address & ~0x3000 == CLOCKS + 0x3C, on_plls)
        self.assertIn("a PLL is reset while it is in use", part.faults)

    def test_usb_on_a_slow_core_is_found(self):
        part = self.without(lambda _, address, value: address == CLOCKS + 0x3C and value & 1)
        self.assertNotIn("USB begins with a core that is no faster (RP2350-E12)", part.faults)
        part.words[USB + 0x40] = 1
        part.check_usb()
        self.assertIn("USB begins with a core that is no faster (RP2350-E12)", part.faults)

    def test_a_timer_that_stops_with_a_debugger_is_found(self):
        part = self.without(lambda _, address, __: address == TIMER + 0x2C)
        self.assertIn("the timer stops while a debugger holds a core", part.faults)

    def test_a_timer_without_its_microseconds_is_found(self):
        part = self.without(lambda _, address, __: address == TIMER_TICK)
        self.assertIsNotNone(part.stop_reason)

    def test_a_crystal_without_time_is_found(self):
        part = self.without(lambda _, address, __: address == XOSC + 0x0C)
        self.assertIn("the crystal is given too little time to start", part.faults)

    def test_a_peripheral_in_reset_is_found(self):
        part = self.without(lambda _, address, value: address == RESETS + 0x3000 and value == 1 << HELD[UART0])
        self.assertIn("written to 40070000 in reset", " ".join(part.faults))

    def test_interrupts_that_are_left_on_are_found(self):
        part = self.without(lambda _, offset, __: 0xE180 <= offset < 0xE300, lambda part: part.enabled.add(40) or part.pending.add(40),
                            system=True)
        self.assertRegex(part.stop_reason, "interrupt \\d+, which nobody expects")

    def test_a_watchdog_that_pauses_is_found(self):
        part = Part(IMAGES / BOARDS["pico2"])
        part.write(None, WATCHDOG - 0x40000000, 4, 1 << 30 | 7 << 24, 0x40000000)
        self.assertEqual(part.faults, ["the watchdog pauses while a debugger holds the core"])

    def test_the_watchdog_bites_in_time(self):
        fed = []

        class Hangs(Part):
            def write_watchdog(self, register, value):
                if len(fed) < 300:  # some hundred turns after the start
                    fed.append(self.seconds)
                    super().write_watchdog(register, value)

        part = start("pico2", seconds=2.0, part_of=Hangs)
        self.assertEqual(part.stop_reason, "the watchdog has reset the part")
        self.assertAlmostEqual(part.seconds - fed[-1], 0.4, places=2)


if __name__ == "__main__":
    unittest.main()
