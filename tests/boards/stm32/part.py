"""An STM32F405 with a program in its flash: the core by Unicorn, and small models of what the program's start touches.

QEMU's machine has no clock control, so it cannot say what a boot loader's leftovers do to a program; this can. Registers
by RM0090. What a rule forbids is a sentence in `faults`. Time is that of the instructions, two cycles each.
"""

import struct

from unicorn import UC_ARCH_ARM, UC_HOOK_BLOCK, UC_HOOK_CODE, UC_MODE_MCLASS, UC_MODE_THUMB, Uc, UcError
from unicorn import arm_const as arm

import elf
from clock_tree import ENABLES, RESETS, ClockTree

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
SYSTICK, SYSTICK_RELOAD, NVIC, ICSR, VTOR, AIRCR = 0xE010, 0xE014, 0xE100, 0xED04, 0xED08, 0xED0C
RETURN = 0x70000000  # where an interrupt's handler returns to
SLEEP = b"\x30\xbf"  # WFI
LSI_HZ = 47_000  # the fastest that it may be (datasheet)
CYCLES_A_BYTE = 1
PUSHED = [*range(arm.UC_ARM_REG_R0, arm.UC_ARM_REG_R12 + 1), arm.UC_ARM_REG_SP, arm.UC_ARM_REG_LR, arm.UC_ARM_REG_XPSR,
          *range(arm.UC_ARM_REG_D0, arm.UC_ARM_REG_D15 + 1), arm.UC_ARM_REG_FPSCR]


class Line:
    """A serial line: what it sent, how fast."""

    def __init__(self):
        self.sent = bytearray()
        self.bauds = set()
        self.wants_to_send = False


class Part:
    def __init__(self, image, crystal_hz=25_000_000):
        self.faults = []
        self.clocks = ClockTree(crystal_hz, self.faults)
        self.clocks.flash_waits = lambda: self.words.get(FLASH, 0) & 7
        self.words = {}
        self.system = {SYSTICK: 0, VTOR: 0}
        self.enabled, self.pending = set(), set()
        self.seconds = 0.0
        self.ticked = 0.0  # when SysTick last wrapped
        self.lines = {base: Line() for base in LINES}
        self.just_enabled = None
        self.watchdog_until = None
        self.timer2 = (0.0, 1, 0)  # since when, prescaler in force, count then
        self.edges = (0.0, 0)  # of timer 11: since when, how many are read
        self.interrupts = 0
        self.returned = False
        self.started_by_rom = False
        self.stop_reason = None
        self.uc = Uc(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS)
        self.uc.ctl_set_cpu_model(arm.UC_CPU_ARM_CORTEX_M4)
        self.load(image)

    def load(self, image):
        uc = self.uc
        self.symbols = elf.symbols(image)
        for address, size in ((0x08000000, 1 << 20), (0x1FFF0000, 1 << 16), (0x20000000, 128 << 10), (RETURN, 0x1000)):
            uc.mem_map(address, size)
        uc.mem_write(0x20000000, bytes((n * 2654435761 >> 24) & 0xFF for n in range(128 << 10)))
        for address, data in elf.segments(image):
            uc.mem_write(address, data)
            for at in range(0, len(data) - 1, 2):
                if data[at:at + 2] == SLEEP and self.is_code(address + at):
                    uc.mem_write(address + at, b"\x00\xbf")
                    uc.hook_add(UC_HOOK_CODE, self.on_sleep, None, address + at, address + at)
        uc.hook_add(UC_HOOK_CODE, self.on_return, None, RETURN, RETURN)
        uc.hook_add(UC_HOOK_BLOCK, self.on_block)
        uc.mmio_map(0x40000000, 0x80000, self.read, 0x40000000, self.write, 0x40000000)
        uc.mmio_map(0x50000000, 0x40000, self.read, 0x50000000, self.write, 0x50000000)
        uc.mmio_map(0xE0000000, 0x100000, self.read_system, None, self.write_system, None)
        uc.reg_write(arm.UC_ARM_REG_FPEXC, 1 << 30)
        self.table = self.symbols.get("image_vectors", 0x08000000)
        stack, start = struct.unpack("<II", uc.mem_read(self.table, 8))
        uc.reg_write(arm.UC_ARM_REG_SP, stack)
        self.pc = start

    def is_code(self, address):
        begin = self.symbols.get("image_text_begin", 0)
        return address >= max(begin, 0x0800C000)

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

    def fault(self, text):
        if text not in self.faults:
            self.faults.append(text)

    def read(self, _uc, offset, _size, region):
        address = region + offset
        if not self.watch_access(address, "read"):
            return 0
        base, register = address & ~0x3FF, address & 0x3FF
        if base == RCC:
            return self.clocks.read(register, self.seconds) & 0xFFFFFFFF
        if base in LINES and register == 0:
            return 0xC0
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

    # The core's own registers.
    def read_system(self, _uc, offset, _size, _data):
        if NVIC <= offset < NVIC + 0x200:
            word, some = (offset & 0x7F) // 4, self.pending if offset & 0x100 else self.enabled
            return sum(1 << n for n in range(32) if 32 * word + n in some)
        return self.system.get(offset, 0)

    def write_system(self, _uc, offset, _size, value, _data):
        if NVIC <= offset < NVIC + 0x200:
            bits = {32 * ((offset & 0x7F) // 4) + n for n in range(32) if value >> n & 1}
            some = self.pending if (offset - NVIC) & 0x100 else self.enabled
            some.difference_update(bits) if offset & 0x80 else some.update(bits)
            return
        self.system[offset] = value
        if offset == SYSTICK:
            self.ticked = self.seconds
        if offset == ICSR and value & 1 << 25:
            self.pending.discard("tick")
        if offset == AIRCR and value & 4:
            self.stop("the program has reset the part")

    # Running.
    def stop(self, why):
        self.stop_reason = self.stop_reason or why
        self.uc.emu_stop()

    def on_sleep(self, uc, address, _size, _data):
        self.block = address + len(SLEEP)
        period = (self.system.get(SYSTICK_RELOAD, 0) + 1) / self.clocks.core_hz()
        if self.system[SYSTICK] & 1 and not self.due():
            self.seconds = max(self.seconds, self.ticked + period)
        uc.emu_stop()

    def on_return(self, uc, _address, _size, _data):
        self.returned = True
        uc.emu_stop()

    def on_block(self, _uc, address, size, _data):
        self.block = address  # the program counter is not kept up from block to block
        self.seconds += size * CYCLES_A_BYTE / self.clocks.core_hz()
        if self.seconds >= self.next_look:
            self.next_look = self.seconds + 20e-6
            self.look()

    def look(self):
        if self.watchdog_until is not None and self.seconds > self.watchdog_until:
            self.stop("the watchdog has reset the part")
        period = (self.system.get(SYSTICK_RELOAD, 0) + 1) / self.clocks.core_hz()
        if self.system[SYSTICK] & 1 and self.seconds - self.ticked >= period:
            self.ticked += period * int((self.seconds - self.ticked) / period)
            if self.system[SYSTICK] & 2:
                self.pending.add("tick")
        if self.due() or self.seconds > self.until:
            self.uc.emu_stop()

    def due(self):
        for base, (_, number, _) in LINES.items():
            if self.lines[base].wants_to_send:
                self.pending.add(number)
        ready = [one for one in self.pending if one == "tick" or one in self.enabled]
        return sorted(ready, key=str)[0] if ready else None

    def masked(self):
        return bool(self.uc.reg_read(arm.UC_ARM_REG_PRIMASK) & 1)

    def run(self, seconds):
        """Until so much later, or until it stops; false if it does."""
        self.until = self.seconds + seconds
        self.next_look = self.seconds + 1e-6  # what was pending before this is none of its business
        while self.seconds < self.until and self.stop_reason is None:
            self.go(self.pc)
            one = self.due()
            if one is not None and self.stop_reason is None and not self.masked():
                self.interrupt(one)
        return self.stop_reason is None

    def go(self, pc):
        try:
            self.uc.emu_start(pc | 1, 0xFFFFFFFE)
        except UcError as error:
            self.stop_reason = f"{error} at {self.uc.reg_read(arm.UC_ARM_REG_PC):08x}"
        self.pc = self.block

    def interrupt(self, one):
        """The handler, to its end. What the core would push is kept here."""
        self.pending.discard(one)
        exception = 15 if one == "tick" else 16 + one
        if self.system[VTOR] == 0 and not self.started_by_rom:  # the flash is there, too (2.4)
            self.fault("an interrupt comes before the vector table is set")
        elif self.system[VTOR] != self.table:
            self.stop(f"interrupt {one} by a vector table at {self.system[VTOR]:08x}")
            return
        self.interrupts += 1
        handler, = struct.unpack("<I", self.uc.mem_read(self.table + 4 * exception, 4))
        if handler & ~1 == self.symbols["unexpected_exception"] & ~1:
            self.stop(f"interrupt {one}, which nobody expects")
            return
        kept, back = [(register, self.uc.reg_read(register)) for register in PUSHED], self.pc
        self.uc.reg_write(arm.UC_ARM_REG_LR, RETURN | 1)
        self.returned = False
        while not self.returned and self.stop_reason is None:
            self.go(handler)
            handler = self.pc
        for register, value in kept:
            self.uc.reg_write(register, value)
        self.pc = back

    # What a start may find.
    def mask_interrupts(self):
        self.uc.reg_write(arm.UC_ARM_REG_PRIMASK, 1)

    def use_other_stack(self):
        """The process stack, somewhere in memory that the program is going to use."""
        self.uc.reg_write(arm.UC_ARM_REG_CONTROL, 2)
        self.uc.reg_write(arm.UC_ARM_REG_SP, 0x20001000)
