"""An RP2350 with a program in its flash: small models of what the program's start and its console touch. Registers by the
RP2350 datasheet (Raspberry Pi Ltd). A broken rule is a sentence in `faults`.
"""

import collections
import pathlib
import struct
import sys

from unicorn import UC_HOOK_CODE, UC_HOOK_MEM_READ
from unicorn import arm_const as arm

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "cortex"))
from core import Core  # noqa: E402

FLASH, FLASH_SIZE, SECTOR, PAGE = 0x10000000, 4 << 20, 4096, 256
CLOCKS, PSM, RESETS, IO, PADS, XOSC = 0x40010000, 0x40018000, 0x40020000, 0x40028000, 0x40038000, 0x40048000
PLL_SYS, PLL_USB, UART0, UART1, I2C0, I2C1 = 0x40050000, 0x40058000, 0x40070000, 0x40078000, 0x40090000, 0x40098000
PWM, TIMER, WATCHDOG, POWMAN, TICKS = 0x400A8000, 0x400B0000, 0x400D8000, 0x40100000, 0x40108000
USB_MEMORY, USB, SIO = 0x50100000, 0x50110000, 0xD0000000
TIMER_TICK, WATCHDOG_TICK = TICKS + 0x18, TICKS + 0x30
# Bits of RESETS (7.5.3), by what they hold.
HELD = {I2C0: 4, I2C1: 5, IO: 6, PADS: 9, PLL_SYS: 14, PLL_USB: 15, PWM: 16, TIMER: 23, UART0: 26, UART1: 27, USB: 28}
INTERRUPTS = {"timer": 0, "usb": 14, "pins": 21, UART0: 33, UART1: 34, I2C0: 36, I2C1: 37}
IMAGE_DEF = struct.pack("<5I", 0xFFFFDED3, 0x10210142, 0x000001FF, 0, 0xAB123579)  # 5.9.5.1
CRYSTAL_HZ, PLL_SECONDS = 12e6, 100e-6
CRYSTAL_STARTS = 6 * 47  # times 256 / 12 MHz: 6 ms, as the vendor gives it
PLAIN_READ_HZ = 50e6  # the maximum of a flash chip's plain read (W25Q16JV)
FLASH_DIVIDER = 3  # by which the boot ROM reads it (5.2.7)
ERASE_SECONDS, PROGRAM_SECONDS = 0.4, 0.003  # W25Q16JV, 9.6, at most
FIFO = 32  # bytes of a serial line
ISOLATED, INPUT, PULL_UP, PULL_DOWN = 1 << 8, 1 << 6, 1 << 3, 1 << 2
SOFTWARE = 5
# The boot ROM: its words, what finds its functions, and these.
MAGIC, LOOK_UP_POINTER, LOOK_UP, FUNCTIONS = 0x10, 0x16, 0x180, 0x200
CODES = ["IF", "EX", "RE", "RP", "FC", "CX", "RB", "GS"]
AFTER = {"IF": ("reading", "connected"), "EX": ("connected", "commands"), "RE": ("commands", "commands"),
         "RP": ("commands", "commands"), "FC": ("commands", "flushed"), "CX": ("flushed", "reading")}
SECURE = 4
CHIP_INFO, PACKAGE = 1, 1  # 5.4.8.17; the smaller package
RETURN = b"\x70\x47"  # bx lr


class Line:
    """A serial line, seen from outside."""

    def __init__(self):
        self.sent = bytearray()
        self.bauds = set()
        self.leaves = collections.deque()  # when each byte that waits has gone
        self.here = collections.deque()  # bytes that came


class Part(Core):
    MODEL = arm.UC_CPU_ARM_CORTEX_M33
    RAM_SIZE = 520 << 10
    MEMORIES = [(0, 32 << 10), (FLASH, FLASH_SIZE)]
    PERIPHERALS = [(0x40000000, 0x170000), (USB_MEMORY, 0x20000), (SIO, 0x1000)]
    ring_hz, ring_divider = 11e6, 1  # of the reference clock; chips since A3: 44 MHz, by 4 (8.3.1)
    HAS_GUARD_IN_CORE = True

    def __init__(self, image, has_crystal=True, chip_id=0xE6C1D8FA03B5720F):
        self.words = {CLOCKS + 0x34: self.ring_divider << 16, CLOCKS + 0x40: 1 << 16, CLOCKS + 0x3C: 0x41, CLOCKS + 0x64: 1 << 16,
                      XOSC + 0x0C: 0xC4, TIMER + 0x2C: 7, USB + 0x40: 4,
                      **{PADS + 4 + 4 * n: 0x116 for n in range(48)}, **{IO + 4 + 8 * n: 31 for n in range(48)}}
        self.after_reset = dict(self.words)
        self.held = 0x1FFFFFFF
        self.lines = {UART0: Line(), UART1: Line()}
        self.has_crystal = has_crystal
        self.chip_id = chip_id  # None: of a ROM that fails
        self.crystal_since = None
        self.pll_since = {}
        self.timer = (0.0, 0)  # since when, count then
        self.alarm = None
        self.watchdog_until = None
        self.fed = 0
        self.targets = set()
        self.stop_levels = []
        self.state = "reading"  # of the flash
        self.erased, self.programmed = [], []
        super().__init__(image)

    # The boot ROM.
    def prepare_memories(self):
        self.uc.mem_write(FLASH, b"\xff" * FLASH_SIZE)
        self.uc.mem_write(MAGIC, b"Mu\x02\x02" + struct.pack("<HH", 0, LOOK_UP | 1))
        for place in (LOOK_UP, *(FUNCTIONS + 16 * n for n in range(len(CODES)))):
            self.uc.mem_write(place, RETURN)
            self.uc.hook_add(UC_HOOK_CODE, self.on_rom, None, place, place)

    def begin(self):
        """As the boot ROM begins an image of its flash: by the block that says so, and the vectors before it."""
        first = bytes(self.uc.mem_read(FLASH, SECTOR))
        if IMAGE_DEF not in first:
            self.fault("the boot ROM finds no image in the first 4 KB of the flash")
        stack, self.pc = struct.unpack_from("<II", first)
        self.uc.reg_write(arm.UC_ARM_REG_SP, stack)
        self.table = self.symbols["image_program_begin"]
        self.program_end = max(address + len(data) for address, data in self.loaded if address < FLASH + FLASH_SIZE)
        self.uc.hook_add(UC_HOOK_MEM_READ, self.on_flash, None, FLASH, FLASH + FLASH_SIZE - 1)

    def on_flash(self, _uc, _access, address, _size, _value, _data):
        if self.state != "reading":
            self.fault(f"the flash is read at {address:08x} while it is {self.state}")
        if self.core_hz() / FLASH_DIVIDER > PLAIN_READ_HZ:
            self.fault(f"the flash is read at {self.core_hz() / FLASH_DIVIDER / 1e6:.0f} MHz")

    def on_rom(self, uc, address, _size, _data):
        registers = [uc.reg_read(register) for register in (arm.UC_ARM_REG_R0, arm.UC_ARM_REG_R1, arm.UC_ARM_REG_R2, arm.UC_ARM_REG_R3)]
        if address == LOOK_UP:
            code = chr(registers[0] & 0xFF) + chr(registers[0] >> 8 & 0xFF)
            known = registers[1] == SECURE and code in CODES
            uc.reg_write(arm.UC_ARM_REG_R0, FUNCTIONS + 16 * CODES.index(code) | 1 if known else 0)
            return
        self.run_rom(CODES[(address - FUNCTIONS) // 16], registers)

    def run_rom(self, code, registers):
        if code == "RB":
            self.stop(f"the boot ROM resets the part, {registers[0]:#x}")
            return
        if code == "GS":
            self.uc.reg_write(arm.UC_ARM_REG_R0, self.give_info(*registers[:3]) & 0xFFFFFFFF)
            return
        if not self.masked():
            self.fault(f"ROM {code}: an interrupt could come, and read the flash")
        if self.uc.reg_read(arm.UC_ARM_REG_LR) >> 28 != 2:
            self.fault(f"ROM {code}: its caller lies in the flash")
        if self.state != AFTER[code][0]:
            self.fault(f"ROM {code}: called while the flash is {self.state}")
        self.state = AFTER[code][1]
        if code in ("RE", "RP"):
            self.change_flash(code, registers)

    def give_info(self, place, words, flags):
        """How many words, or an error."""
        if flags != CHIP_INFO or words < 4 or self.chip_id is None:
            return -1
        self.uc.mem_write(place, struct.pack("<IIQ", CHIP_INFO, PACKAGE, self.chip_id))
        return 4

    def change_flash(self, code, registers):
        unit = SECTOR if code == "RE" else PAGE
        offset, count = (registers[0], registers[1]) if code == "RE" else (registers[0], registers[2])
        if offset % unit or count % unit or not self.program_end - FLASH <= offset <= FLASH_SIZE - count:
            self.fault(f"ROM {code}: offset {offset:#x}, count {count}")
            return
        if code == "RE":
            if registers[2:] != [SECTOR, 0x20]:
                self.fault(f"ROM RE: blocks of {registers[2]}, command {registers[3]:#x}")
            self.uc.mem_write(FLASH + offset, b"\xff" * count)
            self.erased.append(offset)
            self.seconds += ERASE_SECONDS * count / SECTOR
            return
        before, data = self.uc.mem_read(FLASH + offset, count), self.uc.mem_read(registers[1], count)
        self.uc.mem_write(FLASH + offset, bytes(a & b for a, b in zip(before, data)))
        self.programmed.append(offset)
        self.seconds += PROGRAM_SECONDS * count / PAGE

    # Clocks (chapter 8).
    def crystal_runs(self):
        wait = self.words.get(XOSC + 0x0C, 0) * 256 / CRYSTAL_HZ
        return self.has_crystal and self.crystal_since is not None and self.seconds - self.crystal_since >= wait

    def pll_hz(self, base):
        since = self.pll_since.get(base)
        if since is None or self.seconds - since < PLL_SECONDS or not self.crystal_runs():
            return 0
        dividers = self.words.get(base + 0x0C, 0x77000)
        oscillator = CRYSTAL_HZ / (self.words.get(base, 1) & 0x3F or 1) * self.words.get(base + 8, 0)
        if not 750e6 <= oscillator <= 1600e6:
            self.fault(f"a PLL oscillates at {oscillator / 1e6:.0f} MHz")
        off = self.words.get(base + 4, 0x2D) & 8
        return 0 if off else oscillator / (dividers >> 16 & 7) / (dividers >> 12 & 7)

    def reference_hz(self):
        source = self.words.get(CLOCKS + 0x30, 0) & 3
        hz = {0: self.ring_hz * self.ring_divider, 2: CRYSTAL_HZ if self.crystal_runs() else 0}.get(source, 0)
        return hz / (self.words[CLOCKS + 0x34] >> 16 or 1)

    def core_hz(self):
        control = self.words[CLOCKS + 0x3C]
        if not control & 1:
            return self.reference_hz() or 1.0
        return {0: self.pll_hz(PLL_SYS), 2: self.ring_hz * self.ring_divider}.get(control >> 5 & 7, 0) or 1.0

    def usb_hz(self):
        return self.pll_hz(PLL_USB) if self.words.get(CLOCKS + 0x60, 0) & 1 << 11 else 0

    def write_clocks(self, register, value, before):
        if register == 0x3C and before & 1 and value & 1 and (before ^ value) & 0xE0:
            self.fault("the core's clock is changed while it is in use")
        if register == 0x3C and value & 1 and not value & 0xE0 and not self.pll_hz(PLL_SYS):
            self.fault("the core is to run on a PLL that does not")

    def write_pll(self, base, register, value, before):
        if self.uses(base) and (register in (0, 8) or value & ~before & 0x29 and register == 4):
            self.fault("a PLL is changed while it is in use")
        if register == 4:
            on = not value & (1 | 1 << 5)
            self.pll_since[base] = (self.pll_since.get(base) or self.seconds) if on else None

    def uses(self, base):
        core = self.words[CLOCKS + 0x3C]
        return bool(core & 1 and not core >> 5 & 7) if base == PLL_SYS else bool(self.words.get(CLOCKS + 0x60, 0) & 1 << 11)

    # Subsystem resets (7.5).
    def write_resets(self, value):
        begins = value & ~self.held
        for base in (PLL_SYS, PLL_USB):
            if begins >> HELD[base] & 1 and self.uses(base):
                self.fault("a PLL is reset while it is in use")
        for base, bit in HELD.items():
            if begins >> bit & 1:
                self.forget(base)
        if self.held >> HELD[TIMER] & 1 and not value >> HELD[TIMER] & 1:
            self.timer = (self.seconds, 0)
        self.held = value

    def forget(self, base):
        for address in [a for a in self.words if a & ~0x7FFF == base]:
            del self.words[address]
        self.words.update((a, v) for a, v in self.after_reset.items() if a & ~0x7FFF == base)
        self.pll_since.pop(base, None)
        if base == TIMER:
            self.alarm = None

    # Every register.
    def read(self, _uc, offset, _size, region):
        address = region + offset
        if region == SIO:
            return self.read_pins(offset)
        base, register = address & ~0x7FFF, address & 0xFFF
        reads = {CLOCKS: self.read_clocks, UART0: self.read_line, UART1: self.read_line, I2C0: self.read_bus, I2C1: self.read_bus,
                 TIMER: self.read_timer}
        found = reads[base](base, register) if base in reads else None
        if found is not None:
            return found
        if address == RESETS + 8:
            return ~self.held & 0x1FFFFFFF
        if address == XOSC + 4:
            return int(self.crystal_runs()) << 31
        if address in (PLL_SYS, PLL_USB):
            since = self.pll_since.get(address)
            locked = since is not None and self.seconds - since >= PLL_SECONDS and self.crystal_runs()
            return self.words.get(address, 1) | int(locked) << 31
        return self.words.get(address, 0)

    def write(self, _uc, offset, _size, value, region):
        if region == SIO:
            self.write_pins(offset, value)
            return
        address = region + offset
        if region == USB_MEMORY and offset < 0x1000:
            self.words[address] = value
            return
        way, address = address & 0x3000, address & ~0x3000  # 2.1.3
        before = self.words.get(address, 0) if address != RESETS else self.held
        value = {0: value, 0x1000: before ^ value, 0x2000: before | value, 0x3000: before & ~value}[way] & 0xFFFFFFFF
        base, register = address & ~0x7FFF, address & 0xFFF
        if base in HELD and self.held >> HELD[base] & 1:
            self.fault(f"written to {address:08x} in reset")
        if base == PADS:
            self.check_pad((register - 4) // 4, value)
        if address == RESETS:
            self.write_resets(value)
        elif base == CLOCKS:
            self.write_clocks(register, value, before)
        elif base in (PLL_SYS, PLL_USB):
            self.write_pll(base, register, value, self.words.get(address, 0x2D) if register == 4 else before)
        elif base == XOSC and register == 0 and value >> 12 == 0xFAB:
            if self.words.get(XOSC + 0x0C, 0) < CRYSTAL_STARTS:
                self.fault("the crystal is given too little time to start")
            self.crystal_since = self.seconds if self.crystal_since is None else self.crystal_since
        elif base in self.lines:
            self.write_line(base, register, value)
        elif base in (I2C0, I2C1) and register == 0x10:
            self.targets.add(self.words.get(base + 4, 0) & 0x3FF)
        elif base == TIMER:
            self.write_timer(register, value)
        elif base == WATCHDOG and register in (0, 4):
            self.write_watchdog(register, value)
        elif base == USB and register == 0x4C and value & 1 << 16:
            self.check_usb()
        if address != RESETS and address != TIMER + 0x3C:
            self.words[address] = value

    def read_clocks(self, _base, register):
        if register == 0x38:
            return 1 << (self.words.get(CLOCKS + 0x30, 0) & 3) if self.reference_hz() else 0
        return 1 << (self.words[CLOCKS + 0x3C] & 1) if register == 0x44 else None

    def describe(self, value):
        """The first packet of the answer to a request for that descriptor (USB 2.0 9.4.3); None if it is refused."""
        self.words.update({USB_MEMORY: 0x80 | 6 << 8 | value << 16, USB_MEMORY + 4: 255 << 16, USB + 0x98: 1 << 16})
        self.pending.add(INTERRUPTS["usb"])
        self.run(0.001)
        self.words[USB + 0x98] = 0
        control = self.words[USB_MEMORY + 0x80]  # of endpoint 0, in (12.7.3.7.1)
        if control & 1 << 11:
            return None
        return bytes(self.words[USB_MEMORY + 0x100 + n] for n in range(control & 0x3FF))

    def check_usb(self):
        if abs(self.usb_hz() - 48e6) > 1:
            self.fault(f"USB begins with a clock of {self.usb_hz() / 1e6:.0f} MHz")
        if self.core_hz() < 1.1 * 48e6:
            self.fault("USB begins with a core that is no faster (RP2350-E12)")
        if self.words.get(USB + 0x40, 4) & 7 != 1:
            self.fault("USB begins while its wires are isolated, or it is off")

    # Pins (chapter 9; SIO 3.1.11).
    def check_pad(self, pin, value):
        if value & INPUT and value & PULL_DOWN:
            self.fault(f"GP{pin} is an input that is pulled down (RP2350-E9)")
        if value & PULL_UP and self.drives(pin):
            self.fault(f"GP{pin} is driven and pulled up")

    def drives(self, pin):
        return bool(self.words.get(SIO + 0x30 + 4 * (pin // 32), 0) >> pin % 32 & 1)

    def pin(self, pin):
        """(its function, None while it is isolated; is it driven; its level)"""
        function = self.words[IO + 4 + 8 * pin] & 31
        isolated = self.words[PADS + 4 + 4 * pin] & ISOLATED
        return None if isolated else function, self.drives(pin), self.words.get(SIO + 0x10 + 4 * (pin // 32), 0) >> pin % 32 & 1

    def write_pins(self, offset, value):
        for first, place in ((0x10, 0x10), (0x30, 0x30)):  # levels, directions: set at 8 behind, cleared at 16
            for bank in (0, 4):
                before = self.words.get(SIO + place + bank, 0)
                if offset == first + 8 + bank:
                    self.words[SIO + place + bank] = before | value
                if offset == first + 16 + bank:
                    self.words[SIO + place + bank] = before & ~value
        self.note_stop()

    def note_stop(self):
        level = self.pin(self.STOP)[1:] == (True, 1)
        if not self.stop_levels or self.stop_levels[-1][1] != level:
            self.stop_levels.append((self.seconds, level))

    STOP = 15

    def read_pins(self, offset):
        if offset not in (4, 8):
            return self.words.get(SIO + offset, 0)
        levels = 0
        for n in range(32 if offset == 4 else 16):
            pin = n + (0 if offset == 4 else 32)
            pad, (_, driven, level) = self.words[PADS + 4 + 4 * pin], self.pin(pin)
            levels |= (bool(pad & INPUT and not pad & ISOLATED) and (level if driven else bool(pad & PULL_UP))) << n
        return levels

    # Serial lines (12.1, ARM PL011).
    def write_line(self, base, register, value):
        line = self.lines[base]
        if register != 0:
            return
        divisor = self.words.get(base + 0x24, 0) + self.words.get(base + 0x28, 0) / 64
        baud = self.core_hz() / 16 / divisor
        line.sent.append(value & 0xFF)
        line.bauds.add(round(baud))
        line.leaves.append((line.leaves[-1] if line.leaves else self.seconds) + 10 / baud)
        if len(line.leaves) > FIFO:
            self.fault("a serial line is given more than its queue holds")

    def read_line(self, base, register):
        line = self.lines[base]
        while line.leaves and line.leaves[0] <= self.seconds:
            line.leaves.popleft()
        if register == 0x00:
            return line.here.popleft() if line.here else 0
        if register == 0x18:
            return (len(line.leaves) >= FIFO) << 5 | (not line.here) << 4
        return None

    # Bus (12.2): nobody answers.
    def read_bus(self, base, register):
        asked = bool(self.targets) and self.words.get(base + 0x6C, 0) & 1
        return 1 << 6 | 1 << 9 if register == 0x2C and asked else None

    # Time (12.8, 12.9; what they count by: 8.5).
    def tick_hz(self, place):
        cycles = self.words.get(place + 4, 0)
        return self.reference_hz() / cycles if self.words.get(place, 0) & 1 and cycles else 0

    def count(self):
        since, count = self.timer
        return int(count + (self.seconds - since) * self.tick_hz(TIMER_TICK))

    def read_timer(self, _base, register):
        return {0x24: self.count() >> 32, 0x28: self.count() & 0xFFFFFFFF, 0x3C: int(self.alarm_rang())}.get(register)

    def write_timer(self, register, value):
        if register == 0x10:
            self.alarm = value
        if register == 0x3C and value & 1:
            self.alarm = None if self.alarm_rang() else self.alarm

    def alarm_rang(self):
        return self.alarm is not None and (self.count() - self.alarm) & 0xFFFFFFFF < 1 << 31

    def write_watchdog(self, register, value):
        self.fed += 1
        hz = self.tick_hz(WATCHDOG_TICK)
        load = value if register == 4 else self.words.get(WATCHDOG + 4, 0)
        if register == 0 and value & 7 << 24:
            self.fault("the watchdog pauses while a debugger holds the core")
        on = value if register == 0 else self.words.get(WATCHDOG, 0)
        self.watchdog_until = self.seconds + load / hz if on & 1 << 30 and hz else self.watchdog_until

    # Interrupts.
    def raise_interrupts(self):
        if self.alarm_rang() and self.words.get(TIMER + 0x40, 0) & 1:
            if self.words.get(TIMER + 0x2C, 7):
                self.fault("the timer stops while a debugger holds a core")
            self.pending.add(INTERRUPTS["timer"])
        for base, line in self.lines.items():
            mask = self.words.get(base + 0x38, 0)
            self.read_line(base, 0x18)
            if line.here and mask & 0x50 or len(line.leaves) <= FIFO // 2 and mask & 0x20:
                self.pending.add(INTERRUPTS[base])
        for base in (I2C0, I2C1):
            if self.words.get(base + 0x30, 0) & 1 << 6 and self.read_bus(base, 0x2C):
                self.pending.add(INTERRUPTS[base])

    def next_event(self):
        if self.alarm is None or not self.tick_hz(TIMER_TICK):
            return None
        return self.seconds + ((self.alarm - self.count()) & 0xFFFFFFFF) / self.tick_hz(TIMER_TICK) + 1e-6

    def look_at_part(self):
        if self.watchdog_until is not None and self.seconds > self.watchdog_until:
            self.stop("the watchdog has reset the part")
