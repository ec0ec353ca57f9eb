#!/usr/bin/env python3
"""usage: starts_test.py IMAGES TABLES [unittest's arguments]

The images of both micro:bits, started from a reset and from what a debugger leaves behind, which ends a program and
starts ours without one. Each has to come up, break no rule of its part, and drive no pin that its board reserves. It
holds the motors until it may drive. IMAGES: the folder of the presets' folders. TABLES: tests/hal/boards.
"""

import binascii
import csv
import math
import pathlib
import re
import struct
import sys
import unittest

from nrf5 import (EDGES, ERROR, INTERRUPTS_ON, PINS, POWER, RECEIVED, RESET_PINS, SENT, TIMER, TWI, UART, WATCHDOG, ENABLE, Nrf51,
                  Nrf52, number_of)
import uarte
from core import SYSTICK, SYSTICK_RELOAD, VTOR, Core  # by nrf5's path
from huskylens import HuskyLens
from pixy2 import Pixy2

IMAGES = pathlib.Path(sys.argv.pop(1))
TABLES = pathlib.Path(sys.argv.pop(1))
RADIO = 1  # an interrupt
PARTS = {"microbit": Nrf51, "microbit_v2": Nrf52}
# A hundred times nothing, and back.
HANG = b"\x00\xbf" * 100 + struct.pack("<H", 0xE000 | -(100 + 2) & 0x7FF)
LIGHTS = ("", "light of the display", "USB serial line")


def from_reset(part):
    pass


def other_table(part):
    part.system[VTOR] = 0x1000


def interrupts_on(part):
    part.enabled |= {RADIO, number_of(UART), number_of(TIMER)}
    part.pending |= {RADIO, number_of(UART)}


def ticks_on(part):
    part.system[SYSTICK_RELOAD] = 63_999
    part.system[SYSTICK] = 7
    part.pending.add("tick")


def watchdog_on(part):
    """Its time is another program's, and most of it is over."""
    part.words[WATCHDOG + 0x504] = WATCHDOG_LEFT_ON
    part.words[WATCHDOG + 0x50C] = 1
    part.watchdog_until = 0.01


def crystal_on(part):
    part.crystal_since = -1.0


def timer_on(part):
    part.words[TIMER + 0x508], part.words[TIMER + 0x510] = 3, 4
    part.words[TIMER + INTERRUPTS_ON] = 0xF << 16
    part.timer = (-100.0, 0)
    part.words[TIMER + 0x144] = 1  # another of its events


def line_on(part):
    part.words.update({UART + ENABLE: 4, UART + INTERRUPTS_ON: 1 << 2 | 1 << 7 | 1 << 9 | 1 << 17, UART + RECEIVED: 1,
                       UART + SENT: 1, UART + ERROR: 1, UART + 0x50C: 0, UART + 0x514: 0})


def bus_on(part):
    part.words.update({TWI + ENABLE: 5, TWI + INTERRUPTS_ON: 1 << 2 | 1 << 7, TWI + RECEIVED: 1, TWI + SENT: 1})


def second_line_on(part):
    """It goes on writing what comes to somewhere in memory."""
    line, words = part.second, part.words
    words.update({uarte.LINE + uarte.ENABLE: uarte.ENABLED, uarte.LINE + INTERRUPTS_ON: 1 << 4 | 1 << 8 | 1 << 17, uarte.LINE + 0x200: 1 << 5,
                  uarte.LINE + uarte.RECEIVES_TO: LEFT_ON_AT, uarte.LINE + uarte.RECEIVES_BYTES: 4, uarte.LINE + uarte.BAUD: 0x0F000000})
    line.receives = line.transfers = True
    line.feed(b"left" * 1000, 0)


def edges_on(part):
    part.words.update({EDGES + 0x510: 1 | 3 << 16, EDGES + INTERRUPTS_ON: 1, EDGES + 0x100: 1})


def everything(part):
    for leave in (other_table, interrupts_on, ticks_on, Core.use_other_stack, watchdog_on, crystal_on, timer_on, line_on, bus_on,
                  second_line_on, edges_on):
        leave(part)


WATCHDOG_LEFT_ON = 32_767  # a second
LEFT_ON_AT = 0x20000400
LEFT, RIGHT = (17, 1), (13, 34)  # pins of encoders
FASTEST = 1 / 10_000  # s from an edge to the next, as hal/boards/README.md says
STARTS = {"microbit": [from_reset, crystal_on, Core.mask_interrupts],
          "microbit_v2": [from_reset, other_table, interrupts_on, ticks_on, Core.mask_interrupts, Core.use_other_stack, watchdog_on, crystal_on,
                          timer_on, line_on, bus_on, second_line_on, edges_on, everything]}


def start(board, leave=from_reset, seconds=0.05, part_of=None, **facts):
    part = (part_of or PARTS[board])(IMAGES / board / "fencepost.elf", **facts)
    leave(part)
    part.run(seconds)
    return part


def said(part):
    return part.line.sent.decode(errors="replace")


class Starts(unittest.TestCase):
    def expect_up(self, part, board):
        text = said(part)
        self.assertEqual((part.stop_reason, part.faults), (None, []), text)
        self.assertTrue(text.startswith(f"fencepost 0.1.0 for {board}, profile "), text)
        self.assertIn("READY\r\n", text)
        self.assertEqual(len(part.line.bauds), 1)
        self.assertLess(abs(part.line.bauds.pop() / 115_200 - 1), 0.005)
        self.assertLess(abs(part.timer_count() / 1e6 / (part.seconds - part.timer[0]) - 1), 1e-3)
        self.assertGreater(part.interrupts, 50)
        self.assertGreater(part.fed, 10)
        self.assertEqual(part.pin(part.STOP), (True, 0), "nothing is seen yet: the motors are held")
        self.assertEqual([level for _, level in part.stop_levels], [0], "and were never released")

    def test_every_start_of_every_board(self):
        for board, starts in STARTS.items():
            for leave in starts:
                with self.subTest(board=board, start=leave.__name__):
                    self.expect_up(start(board, leave), board)

    # A v2's board takes a file whose words 4 to 6 are zero for that of a v1, and refuses it (DAPLink).
    def test_a_v2_refuses_the_image_of_a_v1(self):
        for board, wanted in (("microbit", 0), ("microbit_v2", 3)):
            words = struct.unpack("<7I", bytes(start(board, seconds=0).uc.mem_read(0, 28)))
            self.assertEqual(sum(word != 0 for word in words[4:]), wanted, board)

    def test_only_a_v2_can_guard_its_stack(self):
        self.assertIsNone(start("microbit").guard(), "its core has no memory protection")
        part = start("microbit_v2")
        self.assertTrue(0 <= part.guard() - part.symbols["image_stack_bottom"] < 32)

    def test_without_its_crystal_it_runs_on_the_oscillator(self):
        for board in PARTS:
            with self.subTest(board=board):
                self.expect_up(start(board, has_crystal=False, seconds=0.1), board)

    # A mass erasure, as the board's drive begins with, takes the reset button's pin away.
    def test_it_connects_its_reset_pin_and_starts_again(self):
        class Erased(Nrf52):
            reset_pin = None

        part = start("microbit_v2", part_of=Erased)
        self.assertEqual((part.stop_reason, part.faults), ("the program has reset the part", []))
        self.assertEqual(part.reset_pins(), (18, 18))
        self.assertEqual(part.pin(part.STOP), (True, 0), "the motors are held meanwhile")
        self.assertEqual(said(part), "")

        class HalfErased(Nrf52):
            def prepare_memories(self):
                super().prepare_memories()
                self.uc.mem_write(RESET_PINS[1], b"\xff\xff\xff\xff")

        part = start("microbit_v2", part_of=HalfErased)
        self.assertEqual((part.stop_reason, part.faults, part.reset_pins()), ("the program has reset the part", [], (18, 18)))

        class SomebodyElses(Nrf52):
            reset_pin = 21

        part = start("microbit_v2", part_of=SomebodyElses)
        self.expect_up(part, "microbit_v2")
        self.assertEqual(part.reset_pins(), (21, 21))


def record(body):
    return f"${body}*{binascii.crc_hqx(body.encode(), 0xFFFF):04X}\r\n".encode()


class Lens:
    """Projects the place before a camera to its image, px."""

    def __init__(self, device, focal, centre, rows):
        self.device, self.focal, self.centre, self.rows = device, focal, centre, rows

    def post(self, distance):
        """Of 0.1 m, whose foot is 0.12 m below the lens; both ends inside."""
        scale, (u, v) = self.focal / distance, self.centre
        return [(1, int(u - 0.05 * scale), int(v - 3), int(u + 0.05 * scale), int(min(self.rows - 1, v + 0.12 * scale)))]


LENSES = {"pixy2": Lens(Pixy2, 273.6, (157.5, 103), 208), "pixy2_i2c": Lens(Pixy2, 273.6, (157.5, 103), 208), "pixy2.1_i2c": Lens(Pixy2, 188.3, (157.5, 103), 208),
          "huskylens_i2c": Lens(HuskyLens, 277.13, (159.5, 119.5), 240)}


class Drive:
    """Towards a post with a camera on the bus and odometry over the console."""

    SPEED, FRONT = 0.25, 0.5

    def __init__(self, board, camera="pixy2_i2c"):
        """A v2 begins with `pixy2`, a v1 with `pixy2_i2c`."""
        self.lens, self.begin = LENSES[camera], float("inf")
        place = "device" if camera.endswith("_i2c") else "line_device"
        self.part = PARTS[board](IMAGES / board / "fencepost.elf", **{place: self.lens.device(self.view)})
        self.part.run(0.05)
        if camera != ("pixy2_i2c" if board == "microbit" else "pixy2"):
            self.part.line.feed(f"set camera {camera}\r".encode(), self.part.seconds)
            self.part.run(0.3)
        self.begin = self.part.seconds + 0.15

    def x(self, seconds):
        return self.SPEED * max(0.0, seconds - self.begin)

    def view(self, seconds):
        return self.lens.post(max(0.1, self.FRONT - self.x(seconds)))

    def run(self, seconds, hears=True):
        end = self.part.seconds + seconds
        while self.part.seconds < end and self.part.stop_reason is None:
            if hears:
                self.part.line.feed(record(f"FPODO,,{self.x(self.part.seconds):.4f},0.0000,0.0000"), self.part.seconds)
            self.part.run(0.02)

    def until(self, text, seconds):
        end = self.part.seconds + seconds
        while text not in said(self.part) and self.part.seconds < end and self.part.stop_reason is None:
            self.run(0.02)
        return text in said(self.part)


class Driving(unittest.TestCase):
    def follows_the_alert(self, board, camera):
        drive = Drive(board, camera)
        part = drive.part
        part.line.feed(b"mode log\r", part.seconds)
        drive.run(0.4)
        text = said(part)
        self.assertEqual((part.stop_reason, part.faults), (None, []), text)
        self.assertEqual(part.pin(part.STOP), (True, 1), text)
        self.assertEqual([level for _, level in part.stop_levels], [0, 1], text)
        self.assertTrue(drive.until(",stop,", 2.5), said(part))
        drive.run(0.02)
        self.assertEqual(part.pin(part.STOP), (True, 0), said(part))
        self.assertEqual((part.stop_reason, part.faults), (None, []), said(part))
        return part

    def test_the_stop_pin_follows_the_alert(self):
        for board in PARTS:
            for camera, lens in LENSES.items():
                if not camera.endswith("_i2c"):
                    continue
                with self.subTest(board=board, camera=camera):
                    part = self.follows_the_alert(board, camera)
                    self.assertIn(lens.device.address, part.targets)
                    self.assertLessEqual(part.targets, {0x54, lens.device.address})

    def test_the_stop_pin_follows_a_camera_on_the_second_line(self):
        part = self.follows_the_alert("microbit_v2", "pixy2")
        self.assertEqual(part.targets, set(), "nothing is asked on the bus any more")
        (baud,) = part.second.bauds
        self.assertLess(abs(baud / 115_200 - 1), 0.005)

    def turn(self, part, counts, seconds=0.0005):
        """An edge of each so often. Wheels whose A leads, or B where the count is negative: {(A's pin, B's pin): how many edges}."""
        for n in range(max(map(abs, counts.values()))):
            for (a, b), count in counts.items():
                if n < abs(count):
                    first, second = (a, b) if count > 0 else (b, a)
                    part.turn_pin(first if n % 2 == 0 else second, n % 4 > 1)
            part.run(seconds)
        part.run(0.05)
        return [float(word) for word in re.findall(r"\$FPODO,([^*]*)\*", said(part))[-1].split(",")[1:4]]

    # Both wheels one turn ahead, then the right one back alone.
    def test_it_counts_the_edges_of_wheels(self):
        part = start("microbit_v2", seconds=0.05)
        for line in (b"set odometry encoders", b"set wheel.diameter 100", b"set wheel.counts 100", b"set wheel.track 200", b"mode log"):
            part.line.feed(line + b"\r", part.seconds)
            part.run(0.3)
        x, y, heading = self.turn(part, {LEFT: 100, RIGHT: 100}, FASTEST)
        self.assertAlmostEqual(x, math.pi * 0.1, delta=1e-3)
        self.assertAlmostEqual(y, 0, delta=1e-3)
        self.assertAlmostEqual(heading, 0, delta=0.02)
        heading = self.turn(part, {RIGHT: -50})[2]
        self.assertAlmostEqual(heading, -math.pi * 0.1 / 2 / 0.2, delta=1e-3)
        self.assertEqual((part.stop_reason, part.faults), (None, []), said(part))

    def test_the_stop_pin_falls_when_the_odometry_does(self):
        drive = Drive("microbit_v2")
        drive.run(0.3)
        self.assertEqual(drive.part.pin(drive.part.STOP), (True, 1), said(drive.part))
        drive.run(0.4, hears=False)
        self.assertEqual(drive.part.pin(drive.part.STOP), (True, 0), said(drive.part))

    # Of the micro:bit v2 alone: QEMU's nRF51, on which the other is tested, reads every event of POWER as set.
    def test_a_supply_that_fell_holds_the_motors_and_keeps_the_flash(self):
        drive = Drive("microbit_v2")
        part = drive.part
        drive.run(0.5)
        self.assertEqual(part.pin(part.STOP), (True, 1), said(part))
        part.sag()
        drive.run(0.04)
        self.assertEqual(part.pin(part.STOP), (True, 0), said(part))
        self.assertEqual(said(part).count("error: the supply is too low: nothing moves"), 1, said(part))
        before = bytes(part.uc.mem_read(part.FLASH_SIZE - 2 * part.PAGE, 2 * part.PAGE))
        part.line.feed(b"set alert.stop 0.41\r", part.seconds)
        drive.run(0.3)
        self.assertIn("could not be written", said(part))
        self.assertEqual(bytes(part.uc.mem_read(part.FLASH_SIZE - 2 * part.PAGE, 2 * part.PAGE)), before)
        self.assertEqual([level for _, level in part.stop_levels], [0, 1, 0])

    # Hangs in the middle of a turn: the watchdog is fed at its end.
    def test_the_watchdog_bites_in_time(self):
        for board in PARTS:
            with self.subTest(board=board):
                part = start(board, seconds=0.1)
                fed, at = part.fed, part.seconds
                work = next(address for name, address in part.symbols.items() if "Robot4work" in name) & ~1
                part.uc.mem_write(work, HANG)
                part.uc.ctl_remove_cache(work, work + len(HANG))
                part.run(1.0)
                self.assertEqual(part.stop_reason, "the watchdog has reset the part")
                self.assertLessEqual(part.fed - fed, 1)
                self.assertLess(part.seconds - at, 0.45)
                self.assertGreater(part.seconds - at, 0.35)


    def test_the_watchdog_goes_on_while_a_debugger_holds_the_core(self):
        for board in PARTS:
            with self.subTest(board=board):
                part = start(board, seconds=0.1)
                part.hold(0.3)
                self.assertIsNone(part.stop_reason)
                part.hold(0.2)
                self.assertEqual(part.stop_reason, "the watchdog has reset the part")


class Rules(unittest.TestCase):
    def reserved(self, board):
        """{pin: what the board itself has there}"""
        lines = [line for line in (TABLES / f"{board}.csv").read_text().splitlines() if not line.startswith("#")]
        return {row["pin"]: row["reserved"] for row in csv.DictReader(lines)}

    def test_no_board_drives_a_pin_that_it_reserves(self):
        for board in PARTS:
            part, table = start(board, seconds=0.05), self.reserved(board)
            driven = [n for n in range(64) if part.pin(n)[0]]
            for n in driven:
                self.assertIn(table[f"P{n // 32}.{n % 32:02}"], LIGHTS, f"{board}: {n}")
            self.assertGreaterEqual(len(driven), 5, board)

    # A program that leaves a step out is found: here each step in turn has no effect.
    def without(self, unheard, leave=from_reset, board="microbit_v2", system=False, seconds=0.05):
        class Deaf(PARTS[board]):
            def write(self, uc, offset, size, value, region):
                if system or not unheard(region + offset, value):
                    super().write(uc, offset, size, value, region)

            def write_system(self, uc, offset, size, value, data):
                if not system or not unheard(offset, value):
                    super().write_system(uc, offset, size, value, data)

        return start(board, leave, seconds, Deaf)

    def test_a_vector_table_that_is_not_set_is_found(self):
        part = self.without(lambda offset, _: offset == VTOR, other_table, system=True)
        self.assertIn("by a vector table at 00001000", part.stop_reason)

    def test_interrupts_that_are_left_on_are_found(self):
        part = self.without(lambda offset, _: 0xE180 <= offset < 0xE300, interrupts_on, system=True)
        self.assertEqual(part.stop_reason, "interrupt 1, which nobody expects")

    def test_a_line_that_is_left_on_is_found(self):
        part = self.without(lambda address, value: address == UART + ENABLE and value == 0, line_on)
        self.assertIn("pins chosen at 4000250c while the peripheral is on", part.faults)

    def test_a_second_line_that_is_left_on_is_found(self):
        part = self.without(lambda address, _: address in (uarte.LINE + uarte.STOP_RECEIVING, uarte.LINE + uarte.ENABLE), second_line_on)
        self.assertTrue(part.second.receives, "it still writes to memory")
        part = self.without(lambda address, _: address == uarte.LINE + uarte.STOP_RECEIVING, second_line_on)
        self.assertIn("the second line is switched off while it works", part.faults)

    def test_a_timer_that_is_left_on_is_found(self):
        part = self.without(lambda address, _: address == TIMER + 0x004, timer_on)
        self.assertIn("the timer is set up while it runs", part.faults)

    def test_a_crystal_that_is_not_started_is_found(self):
        for board in PARTS:
            part = self.without(lambda address, _: address == POWER, board=board, seconds=0.1)
            self.assertIn("a byte is sent before the crystal runs", part.faults)

    def test_a_watchdog_that_is_not_fed_is_found(self):
        class Hungry(Nrf52):
            def feed(self):
                if self.watchdog_until is None:
                    super().feed()

        part = start("microbit_v2", seconds=1.0, part_of=Hungry)
        self.assertEqual(part.stop_reason, "the watchdog has reset the part")

    def test_a_pin_that_does_not_hold_the_motors_is_found(self):
        part = self.without(lambda address, _: address == PINS + 0x700 + 4 * Nrf52.STOP)
        self.assertEqual(part.pin(part.STOP)[0], False)

    def test_a_bus_that_drives_both_ways_is_found(self):
        clock = 0
        part = self.without(lambda address, value: address == PINS + 0x700 + 4 * clock and value >> 8 & 7 == 6, board="microbit")
        self.assertIn("the bus's clock is not set up to be pulled down only", part.faults)

    def test_flash_that_is_not_open_and_a_reserved_address_are_found(self):
        part = start("microbit", seconds=0.05)
        part.on_flash(part.uc, 0, 0x3F800, 4, 0, None)
        part.erase(0x3F800)
        part.words[TWI + 0x588] = 1
        part.write(None, 0x3000, 4, 1, 0x40000000)
        self.assertEqual(part.faults, ["write of 0003f800 in flash that is not open for it, or busy",
                                       "a page is erased at 0003f800 in flash that is not open for it",
                                       "the I2C master speaks to the reserved address 1"])


class Settings(unittest.TestCase):
    def pages(self, part):
        return part.FLASH_SIZE - 2 * part.PAGE, 2 * part.PAGE

    def expect_kept(self, board, before):
        """`before`: what the pages are full of."""
        part = start(board, lambda part: part.uc.mem_write(self.pages(part)[0], before * self.pages(part)[1]), 0.3)
        part.line.feed(b"set alert.stop 0.41\r", part.seconds)
        part.run(0.3)
        self.assertEqual((part.stop_reason, part.faults), (None, []), said(part))
        self.assertNotIn("could not be written", said(part))
        kept = bytes(part.uc.mem_read(*self.pages(part)))
        again = start(board, lambda part: part.uc.mem_write(self.pages(part)[0], kept), 0.3)
        again.line.feed(b"get alert.stop\r", again.seconds)
        again.run(0.05)
        self.assertIn("0.41", said(again))
        self.assertEqual((again.stop_reason, again.faults), (None, []))

    def test_what_is_set_is_kept_by_the_parts_own_rules(self):
        for board in PARTS:
            with self.subTest(board=board):
                self.expect_kept(board, b"\xff")

    def test_pages_of_somebody_elses_are_erased_first(self):
        for board in PARTS:
            with self.subTest(board=board):
                self.expect_kept(board, b"\x5a")


if __name__ == "__main__":
    unittest.main()
