"""The parts of both micro:bits with a program in their flash: small models of what the program uses of them. An nRF51822
by its reference manual, v3.0; an nRF52833 by its product specification, v1.5, where the same peripherals differ.
"""

import collections
import pathlib
import struct
import sys

from unicorn import UC_HOOK_MEM_WRITE
from unicorn import arm_const as arm

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cortex"))
from core import Core  # noqa: E402
from uarte import LINE, DmaLine  # noqa: E402
import uarte  # noqa: E402

POWER, UART, TWI, TIMER, WATCHDOG, FLASH = 0x40000000, 0x40002000, 0x40003000, 0x40008000, 0x40010000, 0x4001E000
EDGES, EDGE_CHANNELS, EDGE_CHANNEL = 0x40006000, 8, 0x510  # GPIOTE
PINS, PORT_STRIDE = 0x50000000, 0x300
OUT, OUT_SET, OUT_CLEAR, IN, PIN_CONFIG = 0x504, 0x508, 0x50C, 0x510, 0x700
INTERRUPTS_ON, INTERRUPTS_OFF, SHORTS = 0x304, 0x308, 0x200
ENABLE = 0x500
RECEIVED, SENT, ERROR, STOPPED = 0x108, 0x11C, 0x124, 0x104  # events of UART and TWI
RESET_PINS = (0x10001200, 0x10001204)
CRYSTAL_SECONDS = 0.0008
CONSOLE_BAUD = 115_200  # of who sends to it
BYTE_OF_BUS = 9 / 100e3
FIFO = 6  # bytes of the serial line (29.5)
RESERVED_TARGETS = [*range(0x08), *range(0x78, 0x80)]  # of the I2C bus (UM10204, 3.1.12)
WATCHDOG_HZ = 32_768
FOOD = 0x6E524635
WORD = 1 << 32
# Events that the program is interrupted by: bit n of a peripheral's interrupts is its event 0x100 + 4 n.
ASKING = {base: [(event - 0x100 >> 2, base + event) for event in events]
          for base, events in ((UART, (RECEIVED, SENT, ERROR)), (TWI, (STOPPED, RECEIVED, SENT, ERROR)), (TIMER, (0x140,)),
                               (LINE, (uarte.RECEIVED, uarte.SENT, uarte.ERROR)),
                               (EDGES, range(0x100, 0x100 + 4 * EDGE_CHANNELS, 4)))}


def number_of(peripheral):
    """Of its interrupt."""
    return peripheral >> 12 & 0x3F


class Line:
    """The serial line, seen from outside."""

    def __init__(self):
        self.sent = bytearray()
        self.bauds = set()
        self.coming = collections.deque()
        self.next_byte = None  # when the next one is here
        self.fifo = collections.deque()
        self.sent_at = None  # when the byte that is being sent has gone

    def feed(self, data, now):
        if not self.coming:
            self.next_byte = now
        self.coming.extend(data)


class Nrf5(Core):
    PERIPHERALS = [(0x40000000, 0x30000), (0x50000000, 0x1000)]
    HZ = FLASH_SIZE = PAGE = 0
    ERASE_SECONDS = WRITE_SECONDS = 0.0

    def __init__(self, image, has_crystal=True, device=None, line_device=None):
        """`device`: on the bus; `address`, `write(byte, seconds)`, `read(seconds)`. `line_device`: on the second line."""
        self.words = {}
        self.line = Line()
        self.device = device
        self.second = DmaLine(self, line_device)
        self.low = set()  # pins that somebody else holds low
        self.crystal_since = None
        self.has_crystal = has_crystal
        self.timer = None  # since when, count then
        self.alarm = None
        self.watchdog_until = None
        self.flash_until = 0.0  # it is busy
        self.fed = 0
        self.bus = None  # "write" or "read" while a transfer is under way
        self.next_of_bus = None  # (when, what)
        self.targets = set()
        self.unread = False  # the last byte of the bus
        self.stop_levels = []  # (seconds, level), each change
        super().__init__(image)

    def core_hz(self):
        return self.HZ

    def prepare_memories(self):
        self.uc.mem_write(0, b"\xff" * self.FLASH_SIZE)

    def begin(self):
        super().begin()
        self.program_end = max(address + len(data) for address, data in self.loaded if address < self.FLASH_SIZE)
        self.uc.hook_add(UC_HOOK_MEM_WRITE, self.on_flash, None, 0, self.FLASH_SIZE - 1)

    # Memory that only the flash controller may change (chapter 6, NVMC).
    def on_flash(self, uc, _access, address, size, value, _data):
        if self.words.get(FLASH + 0x504, 0) != 1 or self.seconds < self.flash_until:
            self.fault(f"write of {address:08x} in flash that is not open for it, or busy")
        if size != 4 or address % 4:
            self.fault(f"write of {size} bytes at {address:08x} in flash")
        before = int.from_bytes(uc.mem_read(address, size), "little")
        if value & WORD - 1 & ~before:
            self.fault(f"bits set at {address:08x} in flash that was not erased")
        self.be_busy(self.WRITE_SECONDS)

    # The core stands still, unless a cache holds what it runs: then it runs on, as long as the flash at most.
    def be_busy(self, seconds):
        if self.words.get(FLASH + 0x540, 0) & 1:
            self.flash_until = self.seconds + seconds
        else:
            self.seconds += seconds

    def erase(self, address):
        if self.words.get(FLASH + 0x504, 0) != 2:
            self.fault(f"a page is erased at {address:08x} in flash that is not open for it")
        if address % self.PAGE or not self.program_end <= address < self.FLASH_SIZE:
            self.fault(f"erased at {address:08x}: not a page, or the program's own")
            return
        self.uc.mem_write(address, b"\xff" * self.PAGE)
        self.be_busy(self.ERASE_SECONDS)

    # Peripherals.
    def read(self, _uc, offset, _size, region):
        address = region + offset
        base, register = address & ~0xFFF, address & 0xFFF
        if address == POWER + 0x100:
            return int(self.crystal_runs())
        if address == FLASH + 0x400:
            return int(self.seconds >= self.flash_until)
        if base == PINS:
            return self.read_pins(register)
        if address == UART + 0x518:
            return self.take_received()
        if base == TWI and register == 0x518:
            self.unread = False
        return self.words.get(address, 0)

    def write(self, _uc, offset, _size, value, region):
        address = region + offset
        base, register = address & ~0xFFF, address & 0xFFF
        if register == INTERRUPTS_ON and base in ASKING:
            value |= self.words.get(address, 0)
        if register == INTERRUPTS_OFF and base in ASKING:
            address = base + INTERRUPTS_ON
            value = self.words.get(address, 0) & ~value
        if base in (UART, TWI, LINE) and 0x508 <= register < 0x518 and self.words.get(base + ENABLE, 0):
            self.fault(f"pins chosen at {address:08x} while the peripheral is on")
        writes = self.writes()
        if base not in writes:
            self.fault(f"write of {address:08x}, where nothing is known")
        elif writes[base](register, value) is None:
            self.words[address] = value

    def writes(self):
        """{peripheral: what a write of one of its registers does}"""
        return {POWER: self.write_power, UART: self.write_uart, TWI: self.write_bus, TIMER: self.write_timer,
                WATCHDOG: self.write_watchdog, FLASH: self.write_flash, PINS: self.write_pins}

    def crystal_runs(self):
        return self.has_crystal and self.crystal_since is not None and self.seconds - self.crystal_since >= CRYSTAL_SECONDS

    def write_power(self, register, value):
        if register == 0x000 and value:
            self.crystal_since = self.seconds
        if register == 0x400:  # cleared by writing one
            self.words[POWER + 0x400] = self.words.get(POWER + 0x400, 0) & ~value
            return True
        return None

    def write_flash(self, register, value):
        if register in (0x504, 0x508) and self.seconds < self.flash_until:
            self.fault("the flash controller is written to while it is busy")
        if register == 0x508:
            self.erase(value)

    # Pins (chapter 14, GPIO).
    def write_pins(self, register, value):
        port = PINS + PORT_STRIDE * (register >= 0x800)
        if register - (port - PINS) in (OUT_SET, OUT_CLEAR):
            levels = self.words.get(port + OUT, 0)
            sets = register - (port - PINS) == OUT_SET
            self.words[port + OUT] = levels | value if sets else levels & ~value
            self.note_stop()
            return True
        return None

    def read_pins(self, register):
        port = PINS + PORT_STRIDE * (register >= 0x800)
        if register - (port - PINS) != IN:
            return self.words.get(PINS + register, 0)
        first = 32 * (port != PINS)
        low = sum(1 << n for n in range(32)
                  if (not self.words.get(port + OUT, 0) >> n & 1 if self.is_output(n, port) else first + n in self.low))
        return WORD - 1 & ~low

    def is_output(self, n, port):
        return bool(self.words.get(port + PIN_CONFIG + 4 * n, 2) & 1)

    def pin(self, number):
        """(is it an output, its level); 32 is the second port's first."""
        port = PINS + PORT_STRIDE * (number // 32)
        return self.is_output(number % 32, port), self.words.get(port + OUT, 0) >> number % 32 & 1

    def note_stop(self):
        level = self.pin(self.STOP)[1]
        if not self.stop_levels or self.stop_levels[-1][1] != level:
            self.stop_levels.append((self.seconds, level))

    # Serial line (chapter 29, UART).
    def baud(self):
        return self.words.get(UART + 0x524, 0) * 16e6 / WORD or 1

    def write_uart(self, register, value):
        if register == ENABLE and value:
            if value != 4:
                self.fault(f"the serial line is enabled by {value}")
            if self.pin(self.words.get(UART + 0x50C, 0)) != (True, 1):
                self.fault("the serial line is enabled before its pin is high")
        if register == 0x51C:
            self.send(value)
        if register == 0x480:
            self.words[UART + 0x480] = self.words.get(UART + 0x480, 0) & ~value
            return True
        return None

    def send(self, byte):
        if self.words.get(UART + ENABLE, 0) != 4 or not self.words.get(UART + 0x008, 0):
            self.fault("a byte is sent on a serial line that is off")
        if self.has_crystal and not self.crystal_runs():
            self.fault("a byte is sent before the crystal runs")
        if self.line.sent_at is not None:
            self.fault("a byte is sent before the last one has gone")
        self.line.sent.append(byte & 0xFF)
        self.line.bauds.add(round(self.baud()))
        self.line.sent_at = self.seconds + 10 / self.baud()

    def receive(self):
        line = self.line
        while line.coming and line.next_byte <= self.seconds:
            byte = line.coming.popleft()
            line.next_byte += 10 / CONSOLE_BAUD
            if not self.words.get(UART + 0x000, 0):
                continue
            if len(line.fifo) == FIFO:
                self.words[UART + ERROR], self.words[UART + 0x480] = 1, 1
                continue
            line.fifo.append(byte)
            if len(line.fifo) == 1:
                self.words[UART + RECEIVED] = 1

    def take_received(self):
        fifo = self.line.fifo
        byte = fifo.popleft() if fifo else 0
        if fifo:
            self.words[UART + RECEIVED] = 1
        return byte

    # I2C master (chapter 28, TWI).
    def write_bus(self, register, value):
        if register == ENABLE and value:
            for name, choice in (("clock", 0x508), ("data", 0x50C)):
                number = self.words.get(TWI + choice, 0)
                config = self.words.get(PINS + PORT_STRIDE * (number // 32) + PIN_CONFIG + 4 * (number % 32), 2)
                if config & 3 or config >> 8 & 7 != 6:
                    self.fault(f"the bus's {name} is not set up to be pulled down only")
        if register in (0x000, 0x008) and value:
            self.start_transfer("read" if register == 0x000 else "write")
        if register == 0x51C:
            self.next_of_bus = (self.seconds + BYTE_OF_BUS, "sent")
        if register == 0x014 and value:
            self.next_of_bus = (self.seconds + BYTE_OF_BUS / 9, "stopped")
        if register == 0x020 and value and self.bus == "read":
            self.next_of_bus = (self.seconds + BYTE_OF_BUS, "received")
        if register == 0x4C4:
            self.words[TWI + 0x4C4] = self.words.get(TWI + 0x4C4, 0) & ~value
            return True
        return None

    def start_transfer(self, what):
        target = self.words.get(TWI + 0x588, 0)
        if self.words.get(TWI + ENABLE, 0) != 5:
            self.fault("a transfer begins on a bus that is off")
        self.targets.add(target)
        if target in RESERVED_TARGETS:
            self.fault(f"the I2C master speaks to the reserved address {target}")
        self.bus = what
        self.unread = False
        if what == "read":
            self.next_of_bus = (self.seconds + 2 * BYTE_OF_BUS, "received")

    def move_bus(self):
        _, what = self.next_of_bus
        self.next_of_bus = None
        answers = self.device is not None and self.device.address == self.words.get(TWI + 0x588, 0)
        if what == "stopped":
            self.bus = None
            self.words[TWI + STOPPED] = 1
        elif not answers:
            self.words[TWI + 0x4C4], self.words[TWI + ERROR] = 2, 1
        elif what == "sent":
            self.device.write(self.words[TWI + 0x51C] & 0xFF, self.seconds)
            self.words[TWI + SENT] = 1
        else:
            self.receive_of_bus()

    def receive_of_bus(self):
        if self.unread:
            self.fault("a byte comes from the bus while the last one is unread")
        self.unread = True
        self.words[TWI + 0x518] = self.device.read(self.seconds)
        self.words[TWI + RECEIVED] = 1
        shorts = self.words.get(TWI + SHORTS, 0)
        if shorts & 2:
            self.next_of_bus = (self.seconds + BYTE_OF_BUS / 9, "stopped")
        elif not shorts & 1:
            self.next_of_bus = (self.seconds + BYTE_OF_BUS, "received")

    # Timer (chapter 18, TIMER).
    def timer_hz(self):
        return 16e6 / (1 << self.words.get(TIMER + 0x510, 4))

    def timer_count(self):
        if self.timer is None:
            return self.words.get("count", 0)
        since, count = self.timer
        return int(count + (self.seconds - since) * self.timer_hz()) % WORD

    def write_timer(self, register, value):
        if register in (0x508, 0x510) and self.timer is not None:
            self.fault("the timer is set up while it runs")
        if register == 0x000 and value and self.timer is None:
            self.timer = (self.seconds, self.words.get("count", 0))
        if register == 0x004 and value:
            self.words["count"], self.timer = self.timer_count(), None
        if register == 0x00C and value:
            self.words["count"] = 0
            self.timer = self.timer and (self.seconds, 0)
        if 0x040 <= register < 0x050 and value:
            self.words[TIMER + 0x540 + register - 0x040] = self.timer_count()
        if register in (0x000, 0x00C, 0x540):
            self.set_alarm(value if register == 0x540 else self.words.get(TIMER + 0x540, 0))
        return None

    def set_alarm(self, at):
        ahead = (at - self.timer_count() - 1) % WORD + 1
        self.alarm = self.seconds + ahead / self.timer_hz() if self.timer else None

    # Watchdog (chapter 20, WDT).
    def write_watchdog(self, register, value):
        running = self.watchdog_until is not None
        if register == 0x000 and value and not running:
            if not self.words.get(WATCHDOG + 0x50C, 1) & 1:
                self.fault("the watchdog sleeps with the core")
            self.feed()
        if register == 0x600 and value == FOOD and running:
            self.fed += 1
            self.feed()
        return True if running and register in (0x504, 0x508, 0x50C) else None

    def hold(self, seconds):
        """A debugger holds the core: the watchdog goes on if it is configured to."""
        if not self.words.get(WATCHDOG + 0x50C, 1) & 8:
            self.watchdog_until += seconds
        self.seconds += seconds
        self.look_at_part()

    def feed(self):
        self.watchdog_until = self.seconds + (self.words.get(WATCHDOG + 0x504, WORD - 1) + 1) / WATCHDOG_HZ

    # Time.
    def look_at_part(self):
        self.receive()
        self.second.move()
        if self.line.sent_at is not None and self.line.sent_at <= self.seconds:
            self.line.sent_at = None
            self.words[UART + SENT] = 1
        if self.alarm is not None and self.alarm <= self.seconds:
            self.words[TIMER + 0x140] = 1
            self.alarm += WORD / self.timer_hz()
        while self.next_of_bus is not None and self.next_of_bus[0] <= self.seconds:
            self.move_bus()
        if self.watchdog_until is not None and self.seconds > self.watchdog_until:
            self.stop("the watchdog has reset the part")

    def next_event(self):
        bus = self.next_of_bus and self.next_of_bus[0]
        times = [self.line.sent_at, self.line.next_byte if self.line.coming else None, self.alarm, bus, *self.second.next_times()]
        return min((time for time in times if time is not None), default=None)

    def raise_interrupts(self):
        words = self.words
        for base, events in ASKING.items():
            on = words.get(base + INTERRUPTS_ON, 0)
            if on and any(words.get(event) and on >> n & 1 for n, event in events):
                self.pending.add(number_of(base))


class Nrf51(Nrf5):
    MODEL = arm.UC_CPU_ARM_CORTEX_M0
    HAS_FLOATS = HAS_VTOR = False
    HZ, FLASH_SIZE, PAGE, RAM_SIZE = 16e6, 256 << 10, 1 << 10, 16 << 10
    MEMORIES = [(0, 256 << 10)]
    ERASE_SECONDS, WRITE_SECONDS = 0.0223, 46e-6
    STOP = 2  # the board's: ring 1


class Nrf52(Nrf5):
    HZ, FLASH_SIZE, PAGE, RAM_SIZE = 64e6, 512 << 10, 4 << 10, 128 << 10
    MEMORIES = [(0, 512 << 10), (0x10000000, 0x2000)]
    ERASE_SECONDS, WRITE_SECONDS = 0.085, 41e-6
    STOP = 3
    FALLS_BELOW_2V1 = 8
    reset_pin = 18  # contents of the configuration; None: empty, since all was erased

    def prepare_memories(self):
        super().prepare_memories()
        self.uc.mem_write(0x10000000, b"\xff" * 0x2000)
        if self.reset_pin is not None:
            self.uc.mem_write(RESET_PINS[0], struct.pack("<II", self.reset_pin, self.reset_pin))
        self.uc.hook_add(UC_HOOK_MEM_WRITE, self.on_flash, None, 0x10000000, 0x10001FFF)

    def writes(self):
        return super().writes() | {LINE: self.second.write, EDGES: lambda *_: None}

    def reset_pins(self):
        return struct.unpack("<II", self.uc.mem_read(RESET_PINS[0], 8))

    def sag(self):
        """The supply falls below 2.1 V for a moment."""
        if self.words.get(POWER + 0x510, 0) == 1 | self.FALLS_BELOW_2V1 << 1:
            self.words[POWER + 0x108] = 1

    def turn_pin(self, number, level):
        """Somebody outside does; a channel that watches the pin sees an edge."""
        if (number not in self.low) == level:
            return
        self.low ^= {number}
        for n in range(EDGE_CHANNELS):
            config = self.words.get(EDGES + EDGE_CHANNEL + 4 * n, 0)
            watches = config & 3 == 1 and config >> 8 & 0x3F == number
            if watches and (config >> 16 & 3) & (1 if level else 2):
                self.words[EDGES + 0x100 + 4 * n] = 1
