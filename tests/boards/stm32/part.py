"""An STM32F405 with a program in its flash: small models of what the program's start touches.

QEMU's machine has no clock control, so it cannot say what a boot loader's leftovers do to a program; this can. Registers
by RM0090.
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cortex"))
from clock_tree import ENABLES, RESETS, ClockTree  # noqa: E402
from core import Core  # noqa: E402

RCC, FLASH, PWR, IWDG = 0x40023800, 0x40023C00, 0x40007000, 0x40003000
TIMER2, TIMER11 = 0x40000000, 0x40014800
PORTS = {0x40020000 + 0x400 * n: "ABCDEFGHI"[n] for n in range(9)}
# Which clock a peripheral needs: the offset of its enable register, the bit (7.3.10 to 7.3.14); serial lines: interrupt.
GATES = {0x40000000: (0x40, 0), 0x40000400: (0x40, 1), 0x40000800: (0x40, 2), 0x40000C00: (0x40, 3),
         0x40004400: (0x40, 17), 0x40004800: (0x40, 18), 0x40004C00: (0x40, 19), 0x40005400: (0x40, 21),
         0x40007000: (0x40, 28), 0x40011000: (0x44, 4), 0x40011400: (0x44, 5), 0x40014800: (0x44, 18),
         **{port: (0x30, n) for n, port in enumerate(PORTS)}}
LINES = {0x40011000: ("USART1", 37, "apb2"), 0x40004400: ("USART2", 38, "apb1"), 0x40004800: ("USART3", 39, "apb1"),
         0x40004C00: ("UART4", 52, "apb1"), 0x40011400: ("USART6", 71, "apb2")}
# A gate's enable register is that of the resets 0x20 before it.
LSI_HZ = 47_000  # the fastest that it may be (datasheet)
I2C1, I2C1_EVENT, I2C1_ERROR = 0x40005400, 31, 32
RESERVED_TARGETS = [*range(0x08), *range(0x78, 0x80)]  # of the I2C bus (UM10204, 3.1.12)


class Line:
    """A serial line: what it sent, how fast."""

    def __init__(self):
        self.sent = bytearray()
        self.bauds = set()
        self.wants_to_send = False


class Part(Core):
    FIRST = 0x08000000
    RAM_SIZE = 128 << 10
    MEMORIES = [(0x08000000, 1 << 20), (0x1FFF0000, 1 << 16)]
    volts = 3.3
    PERIPHERALS = [(0x40000000, 0x80000), (0x50000000, 0x40000)]

    def __init__(self, image, crystal_hz=25_000_000):
        self.words = {}
        self.lines = {base: Line() for base in LINES}
        self.just_enabled = None
        self.watchdog_until = None
        self.timer2 = (0.0, 1, 0)  # since when, prescaler in force, count then
        self.edges = (0.0, 0)  # of timer 11: since when, how many are read
        self.targets = set()  # whom the I2C master has spoken to; nobody answers
        super().__init__(image)
        self.clocks = ClockTree(crystal_hz, self.faults)
        self.clocks.flash_waits = lambda: self.words.get(FLASH, 0) & 7

    def core_hz(self):
        return self.clocks.core_hz()

    # Peripherals.
    def gate_of(self, address):
        return GATES.get(address & ~0x3FF)

    def runs(self, address):
        gate = self.gate_of(address)
        return gate is None or self.clocks.words.get(gate[0], 0) >> gate[1] & 1

    def watch_access(self, address, what):
        if self.just_enabled is not None and not (what == "read" and address == self.just_enabled):
            self.fault(f"{what} of {address:08x} within two cycles of a clock enable at {self.just_enabled:08x}")
        self.just_enabled = None
        if not self.runs(address):
            self.fault(f"{what} of {address:08x}, whose clock is off")
            return False
        return True

    def read(self, _uc, offset, _size, region):
        address = region + offset
        if not self.watch_access(address, "read"):
            return 0
        base, register = address & ~0x3FF, address & 0x3FF
        if base == RCC:
            return self.clocks.read(register, self.seconds) & 0xFFFFFFFF
        if base in LINES and register == 0:
            return 0xC0
        if base == PWR and register == 4:  # below 2.7 V, if it is watched for that
            return 4 if self.words.get(PWR, 0) & 0xF0 == 5 << 5 | 1 << 4 and self.volts < 2.7 else 0
        if base == TIMER2 and register == 0x24:
            return self.timer2_count()
        if base == TIMER11 and register in (0x10, 0x34):
            return self.read_captured(register)
        return self.words.get(address, 0)

    def write(self, _uc, offset, _size, value, region):
        address = region + offset
        if not self.watch_access(address, "write"):
            return
        base, register = address & ~0x3FF, address & 0x3FF
        before = self.words.get(address, 0)
        if base == RCC:
            self.write_clocks(register, value)
            return
        self.words[address] = value
        if base in LINES:
            self.write_line(base, register, value)
        elif base == IWDG and register == 0:
            self.write_watchdog(value)
        elif base == TIMER2:
            self.write_timer2(register, value)
        elif base == TIMER11 and register == 0 and value & 1 and not before & 1:
            self.edges = (self.seconds, 0)
        elif base in PORTS and register == 0x18:
            self.drive(base, value)
        elif base == I2C1:
            self.write_bus(register, value, before)

    def write_clocks(self, register, value):
        if register in ENABLES and value & ~self.clocks.words.get(register, 0):
            self.just_enabled = RCC + register
        self.clocks.write(register, value, self.seconds)
        if register in RESETS:
            for base, (enable, bit) in GATES.items():
                if enable == register + 0x20 and value >> bit & 1:
                    self.forget(base)

    def forget(self, base):
        for address in [address for address in self.words if address & ~0x3FF == base]:
            del self.words[address]
        if base in LINES:
            self.lines[base].wants_to_send = False

    def drive(self, base, value):
        levels = self.words.get(base + 0x14, 0)
        self.words[base + 0x14] = (levels | value & 0xFFFF) & ~(value >> 16)

    def write_line(self, base, register, value):
        line, (_, number, bus) = self.lines[base], LINES[base]
        if register == 0x04:
            line.sent.append(value & 0xFF)
            line.bauds.add(round(self.clocks.bus_hz(bus) / self.words[base + 0x08]))
        if register == 0x0C:
            line.wants_to_send = bool(value & 1 << 7)
        if line.wants_to_send:
            self.pending.add(number)

    def timer2_count(self):
        since, prescaler, count = self.timer2
        return int(count + (self.seconds - since) * self.clocks.timer_hz("apb1") / prescaler) & 0xFFFFFFFF

    def write_timer2(self, register, value):
        if register == 0x14 and value & 1:  # takes the prescaler over, and begins anew
            self.timer2 = (self.seconds, self.words.get(TIMER2 + 0x28, 0) + 1, 0)

    def read_captured(self, register):
        hz = self.clocks.crystal_for_clock_hz() / 8
        looks = self.words.get(TIMER11 + 0x50, 0) & 3 == 2 and self.words.get(TIMER11 + 0x20, 0) & 1
        looks = looks and self.words.get(TIMER11, 0) & 1 and self.words.get(TIMER11 + 0x18, 0) == 0xD
        since, seen = self.edges
        count = int((self.seconds - since) * hz) if looks else 0
        if register == 0x10:
            return 2 if count > seen else 0
        self.edges = (since, count)
        return int(count / hz * self.clocks.timer_hz("apb2")) & 0xFFFF if looks and hz else 0

    def write_watchdog(self, value):
        if value == 0xCCCC or (value == 0xAAAA and self.watchdog_until is not None):
            divider = 4 << (self.words.get(IWDG + 4, 0) & 7)
            self.watchdog_until = self.seconds + divider * self.words.get(IWDG + 8, 0xFFF) / LSI_HZ

    # The bus: a start, and the address behind it, which nobody acknowledges (27.3.3). Bits of the status are cleared by
    # writing zero, start and stop clear themselves.
    def write_bus(self, register, value, before):
        if register == 0x14:
            self.words[I2C1 + 0x14] = before & value
        status = self.words.get(I2C1 + 0x14, 0)
        if register == 0x00:
            self.words[I2C1] = value & ~(3 << 8)
            if value & 1 << 8:
                self.words[I2C1 + 0x14] = status | 1
        if register == 0x10 and status & 1:
            self.words[I2C1 + 0x14] = status & ~1 | 1 << 10
            self.address(value >> 1)

    def address(self, target):
        self.targets.add(target)
        if target in RESERVED_TARGETS:
            self.fault(f"the I2C master speaks to the reserved address {target}")

    def raise_interrupts(self):
        for base, (_, number, _) in LINES.items():
            if self.lines[base].wants_to_send:
                self.pending.add(number)
        status, control = self.words.get(I2C1 + 0x14, 0), self.words.get(I2C1 + 0x04, 0)
        if status & 1 and control & 1 << 9:
            self.pending.add(I2C1_EVENT)
        if status & 1 << 10 and control & 1 << 8:
            self.pending.add(I2C1_ERROR)

    def look_at_part(self):
        if self.watchdog_until is not None and self.seconds > self.watchdog_until:
            self.stop("the watchdog has reset the part")
