#!/usr/bin/env python3
"""usage: dirty_start_test.py BUILD_DIR TABLES [unittest's arguments]

The images of the boards with an STM32F405, started from what boot loaders, debuggers and other programs leave behind.
Each has to come up at the right speed, by its own vector table, without breaking a rule of the part on its way. It
drives no pin that its board reserves. TABLES: tests/hal/boards.
"""

import csv
import pathlib
import sys
import unittest

from part import GATES, IWDG, PORTS, RCC, Part
from core import SYSTICK, SYSTICK_RELOAD, VTOR, Core  # by part's path
from settings import page_with

BUILD = pathlib.Path(sys.argv.pop(1))
TABLES = pathlib.Path(sys.argv.pop(1))
PERIPHERALS = 0x40000000
I2C1_CLOCK = 0x40005400 + 0x1C
# Image, console, crystals that its board is sold with.
BOARDS = {"netduino_plus_2": ("fencepost.elf", 0x40004400, [25_000_000]),
          "pyboard": ("fencepost-pyboard.elf", 0x40004400, [12_000_000, 8_000_000]),
          "feather_f405": ("fencepost-feather_f405.elf", 0x40004800, [12_000_000])}
# Low stops the motors.
STOP = {"netduino_plus_2": ("B", 12), "pyboard": ("B", 12), "feather_f405": ("C", 2)}
ROM = 0x1FFF0000  # the ROM's boot loader, and its vector table
FLASH = 0x40023C00
SETTINGS = 0x08004000  # hal/mcu/stm32f4/flash.hpp
USB, TIMER2, USART1 = 67, 28, 37  # interrupts


def from_reset(part):
    pass


def on_pll(part):
    """The ROM's boot loader for USB: the core on the PLL, which runs on the crystal."""
    clocks = part.clocks
    part.words[FLASH] = 5
    clocks.words[0x04] = clocks.crystal_hz // 1_000_000 | 120 << 6 | 5 << 24 | 1 << 22
    clocks.words[0x00] |= 1 << 16 | 1 << 24
    clocks.words[0x08] = 0x2 | 0x4 << 10
    clocks.start("hse", 0)
    clocks.start("pll", 0)
    clocks.switched = 2


def without_oscillator(part):
    on_pll(part)
    part.clocks.words[0x00] &= ~1


def at_full_speed(part):
    """A program that sets the PLL up as ours does, left by a debugger's reset of the core alone."""
    on_pll(part)
    part.clocks.words[0x04] = part.clocks.crystal_hz // 1_000_000 | 336 << 6 | 7 << 24 | 1 << 22
    part.clocks.words[0x08] = 0x2 | 0x5 << 10 | 0x4 << 13


def other_table(part):
    part.started_by_rom = True
    part.system[VTOR] = ROM


def interrupts_on(part):
    part.enabled |= {USB, TIMER2, USART1}
    part.pending |= {USB, TIMER2, USART1}


def ticks_on(part):
    part.system[SYSTICK_RELOAD] = 15_999
    part.system[SYSTICK] = 7
    part.pending.add("tick")


def watchdog_on(part):
    """By 4, 4095 counts: 0.35 s from feed to feed, most of which is over."""
    part.words[IWDG + 4] = 0
    part.words[IWDG + 8] = 0xFFF
    part.watchdog_until = 0.05


def peripherals_on(part):
    """Clocks on, a line that wants to send, a pin driven."""
    for enable, bit in GATES.values():
        part.clocks.words[enable] = part.clocks.words.get(enable, 0) | 1 << bit
    part.words[0x40011000 + 0x08] = 0x8B
    part.words[0x40011000 + 0x0C] = 0x20AC
    part.lines[0x40011000].wants_to_send = True
    part.words[0x40020000] = 0x00280000
    part.words[0x40000000] = 1


def everything(part):
    for leave in (without_oscillator, other_table, interrupts_on, ticks_on, Core.use_other_stack, watchdog_on, peripherals_on):
        leave(part)


STARTS = [from_reset, on_pll, without_oscillator, at_full_speed, other_table, interrupts_on, ticks_on, Core.mask_interrupts, Core.use_other_stack,
          watchdog_on, peripherals_on, everything]


def start(image, leave, crystal, seconds=0.15, part_of=Part):
    part = part_of(BUILD / image, crystal)
    leave(part)
    part.run(seconds)
    return part


def kept(*settings):
    """A start with these in the first of the settings' sectors."""
    return lambda part: part.uc.mem_write(SETTINGS, page_with(*settings))


def stop_pin(part, board):
    """Its mode, of which 1 is an output, and its level."""
    port, n = STOP[board]
    base = next(address for address, name in PORTS.items() if name == port)
    return part.words.get(base, 0) >> 2 * n & 3, part.words.get(base + 0x14, 0) >> n & 1


class DirtyStarts(unittest.TestCase):
    def expect_up(self, board, leave, crystal):
        image, line, _ = BOARDS[board]
        part = start(image, leave, crystal)
        console = part.lines[line]
        said = console.sent.decode(errors="replace")
        self.assertEqual((part.stop_reason, part.faults), (None, []), said)
        self.assertTrue(said.startswith(f"fencepost 0.1.0 for {board}, "), said)
        self.assertIn("READY\r\n", said)
        for baud in console.bauds:
            self.assertLess(abs(baud / 115_200 - 1), 0.005, console.bauds)
        self.assertEqual(part.clocks.core_hz(), 168_000_000)
        self.assertLess(abs(part.timer2_count() / 1e6 / (part.seconds - part.timer2[0]) - 1), 1e-3)
        self.assertGreater(part.interrupts, 50)
        self.assertEqual(stop_pin(part, board), (1, 0), "nothing is seen yet: the motors are held")
        self.assertTrue(0 <= part.guard() - part.symbols["image_stack_bottom"] < 32)
        self.assertNotIn("supply", said)

    def test_every_start_of_every_board(self):
        for board, (_, _, crystals) in BOARDS.items():
            for crystal in crystals:
                for leave in STARTS if board == "netduino_plus_2" else (from_reset, everything):
                    with self.subTest(board=board, start=leave.__name__, crystal=crystal):
                        self.expect_up(board, leave, crystal)

    def test_without_its_crystal_it_runs_on_the_oscillator(self):
        for crystal in (None, 16_000_000):
            with self.subTest(crystal=crystal):
                self.expect_up("feather_f405", from_reset, crystal)


    def test_a_battery_that_sags_is_told_of_once(self):
        class Sagging(Part):
            volts = 2.6

        for board, (image, line, crystals) in BOARDS.items():
            said = start(image, from_reset, crystals[0], part_of=Sagging).lines[line].sent
            self.assertEqual(said.count(b"error: the supply is too low: nothing moves"), 1, said)


class Rules(unittest.TestCase):
    def reserved(self, board):
        """{pin: what the board itself has there}"""
        lines = [line for line in (TABLES / f"{board}.csv").read_text().splitlines() if not line.startswith("#")]
        return {row["pin"]: row["reserved"] for row in csv.DictReader(lines)}

    def test_no_board_drives_a_pin_that_it_reserves(self):
        for board, (image, _, crystals) in BOARDS.items():
            part, driven = start(image, from_reset, crystals[0], 0.02), 0
            for base, port in PORTS.items():
                for n in range(16):
                    if part.words.get(base, 0) >> 2 * n & 3 in (1, 2):
                        driven += 1
                        what = self.reserved(board)[f"P{port}{n}"]
                        self.assertIn(what, ("", "led", "header's power"), f"{board}: P{port}{n}")
            self.assertGreaterEqual(driven, 5, board)
        self.assertEqual(self.reserved("pyboard")["PA9"], "USB VBUS")

    def expect_bus(self, part_of):
        part = start("fencepost.elf", kept("camera,pixy2_i2c", "odometry,encoders"), 25_000_000, 0.1, part_of)
        self.assertEqual((part.stop_reason, part.faults), (None, []))
        hz = part.clocks.bus_hz("apb1") / 2 / part.words[I2C1_CLOCK]
        self.assertLess(hz, 88_000)  # errata ES0182: or a repeated start comes too early
        self.assertGreater(hz, 70_000)
        return part

    def test_the_bus_and_the_encoders_break_none(self):
        class Hangs(Part):
            def write_bus(self, register, value, before):
                pass

        self.expect_bus(Hangs)
        self.assertEqual(self.expect_bus(Part).targets, {0x54}, "the camera, and nobody else")

    # Its maker's address lies where the bus reserves ones; this master, other than the RP2040's, speaks to it.
    def test_a_reserved_address_is_found(self):
        part = start("fencepost.elf", kept("camera,nxtcam_i2c", "odometry,create1"), 25_000_000, 0.1)
        self.assertEqual((part.stop_reason, part.faults), (None, ["the I2C master speaks to the reserved address 1"]))

    # A program that leaves a step out is found: here each step in turn has no effect.
    def without(self, leave, unheard, system=False):
        class Deaf(Part):
            def write(self, uc, offset, size, value, region):
                if system or not unheard(self, region + offset, value):
                    super().write(uc, offset, size, value, region)

            def write_system(self, uc, offset, size, value, data):
                if not system or not unheard(self, offset, value):
                    super().write_system(uc, offset, size, value, data)

        return start("fencepost.elf", leave, 25_000_000, 0.15, Deaf)

    def test_a_vector_table_that_is_not_set_is_found(self):
        part = self.without(from_reset, lambda _, offset, __: offset == VTOR, system=True)
        self.assertEqual(part.faults, ["an interrupt comes before the vector table is set"])
        part = self.without(other_table, lambda _, offset, __: offset == VTOR, system=True)
        self.assertIn("by a vector table at 1fff0000", part.stop_reason)

    def test_a_pll_that_is_not_stopped_is_found(self):
        part = self.without(on_pll, lambda _, address, value: address == RCC and not value & 1 << 24)
        self.assertIn("the PLL is set up while it runs", part.faults)

    def test_a_core_that_stays_on_its_pll_is_found(self):
        part = self.without(on_pll, lambda _, address, value: address == RCC + 8 and value & 3 == 0)
        self.assertIn("the pll is stopped while the core runs on it", part.faults)

    def test_a_pin_that_does_not_hold_the_motors_is_found(self):
        port = next(address for address, name in PORTS.items() if name == "B")
        part = self.without(from_reset, lambda _, address, __: address == port)
        self.assertEqual(stop_pin(part, "netduino_plus_2")[0], 0)

    # A loop that hangs, at the clock's fastest; 0.40 s at its usual 32 kHz.
    def test_the_watchdog_bites_in_time(self):
        fed = []

        class Hangs(Part):
            def write_watchdog(self, value):
                if len(fed) < 300:  # some hundred turns after the start
                    fed.append(self.seconds)
                    super().write_watchdog(value)

        part = start("fencepost.elf", from_reset, 25_000_000, 2.0, Hangs)
        self.assertEqual(part.stop_reason, "the watchdog has reset the part")
        self.assertLess(part.seconds - fed[-1], 0.30)
        self.assertGreater(part.seconds - fed[-1], 0.25)

    def test_a_watchdog_that_is_not_fed_is_found(self):
        part = self.without(watchdog_on, lambda _, address, value: address == IWDG)
        self.assertEqual(part.stop_reason, "the watchdog has reset the part")

    def test_interrupts_that_are_left_on_are_found(self):
        part = self.without(interrupts_on, lambda _, offset, __: 0xE180 <= offset < 0xE300, system=True)
        self.assertRegex(part.stop_reason, "interrupt \\d+, which nobody expects")

    def test_a_clock_that_is_given_no_time_is_found(self):
        part = Part(BUILD / "fencepost.elf")
        part.write(None, RCC + 0x30 - PERIPHERALS, 4, 1, PERIPHERALS)
        part.write(None, 0x20000, 4, 1, PERIPHERALS)
        part.write(None, 0x20400, 4, 1, PERIPHERALS)
        self.assertEqual(part.faults, ["write of 40020000 within two cycles of a clock enable at 40023830",
                                       "write of 40020400, whose clock is off"])


if __name__ == "__main__":
    unittest.main()
