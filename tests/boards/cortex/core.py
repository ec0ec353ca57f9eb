"""A Cortex-M with a program in its flash, by Unicorn: memories, interrupts, sleep and time. What lies behind the
peripherals' addresses is a part's own: a class that derives from Core.

A broken rule becomes a sentence in `faults`. Time is that of the instructions, two cycles each.
"""

import struct

from unicorn import UC_ARCH_ARM, UC_HOOK_BLOCK, UC_HOOK_CODE, UC_MODE_MCLASS, UC_MODE_THUMB, Uc, UcError
from unicorn import arm_const as arm

import elf

SYSTICK, SYSTICK_RELOAD, NVIC, ICSR, VTOR, AIRCR = 0xE010, 0xE014, 0xE100, 0xED04, 0xED08, 0xED0C
MPU_TYPE, MPU_CONTROL, MPU_BASE, MPU_KIND = 0xED90, 0xED94, 0xED9C, 0xEDA0
RETURN = 0x70000000  # where an interrupt's handler returns to
NOTHING = b"\x00\xbf"  # stands where the program sleeps: NOP
STAY = b"\xfe\xe7"  # a branch to itself
RAM = 0x20000000
CYCLES_A_BYTE = 1
LOOK = 20e-6  # seconds between two looks at what is due
IF_THEN = 0x0600FC00  # of XPSR: what is left of an IT block
PUSHED = [*range(arm.UC_ARM_REG_R0, arm.UC_ARM_REG_R12 + 1), arm.UC_ARM_REG_SP, arm.UC_ARM_REG_LR, arm.UC_ARM_REG_XPSR]
PUSHED_FLOATS = [*range(arm.UC_ARM_REG_D0, arm.UC_ARM_REG_D15 + 1), arm.UC_ARM_REG_FPSCR]


class Core:
    MODEL = arm.UC_CPU_ARM_CORTEX_M4
    HAS_FLOATS = True
    HAS_VTOR = True
    FIRST = 0  # where its vector table is when nobody has set one
    RAM_SIZE = 0
    MEMORIES = []  # (address, size), beside the memory
    PERIPHERALS = []  # likewise

    def __init__(self, image):
        self.faults = []
        self.system = {SYSTICK: 0, VTOR: 0, MPU_TYPE: 8 << 8 if self.HAS_FLOATS else 0}  # regions
        self.enabled, self.pending = set(), set()
        self.seconds = 0.0
        self.until = self.next_look = 0.0
        self.ticked = 0.0  # when SysTick last wrapped
        self.interrupts = 0
        self.returned = False
        self.started_by_rom = False
        self.stop_reason = None
        self.uc = Uc(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS)
        self.uc.ctl_set_cpu_model(self.MODEL)
        self.load(image)

    # A part's own.
    def core_hz(self):
        raise NotImplementedError

    def read(self, _uc, offset, size, region):
        raise NotImplementedError

    def write(self, _uc, offset, size, value, region):
        raise NotImplementedError

    def raise_interrupts(self):
        """Adds what peripherals ask for to `pending`."""

    def look_at_part(self):
        """From time to time: what has happened meanwhile."""

    def next_event(self):
        """When a sleeping core may be woken next; None if the part knows of nothing."""
        return None

    # Memories.
    def load(self, image):
        uc = self.uc
        self.symbols = elf.symbols(image)
        for address, size in [*self.MEMORIES, (RAM, self.RAM_SIZE), (RETURN, 0x1000)]:
            uc.mem_map(address, size)
        uc.mem_write(RAM, bytes((n * 2654435761 >> 24) & 0xFF for n in range(self.RAM_SIZE)))
        self.prepare_memories()
        self.loaded = elf.segments(image)
        for address, data in self.loaded:
            uc.mem_write(address, data)
        for address in elf.sleeps(image):
            uc.mem_write(address, NOTHING)
            uc.hook_add(UC_HOOK_CODE, self.on_sleep, None, address, address)
        uc.mem_write(RETURN, STAY)
        uc.hook_add(UC_HOOK_CODE, self.on_return, None, RETURN, RETURN)
        uc.hook_add(UC_HOOK_BLOCK, self.on_block)
        for address, size in self.PERIPHERALS:
            uc.mmio_map(address, size, self.read, address, self.write, address)
        uc.mmio_map(0xE0000000, 0x100000, self.read_system, None, self.write_system, None)
        if self.HAS_FLOATS:
            uc.reg_write(arm.UC_ARM_REG_FPEXC, 1 << 30)
        self.table = self.symbols.get("image_vectors", self.FIRST)
        self.begin()

    def prepare_memories(self):
        """Before the program is there."""

    def begin(self):
        """At the program's first instruction."""
        stack, self.pc = struct.unpack("<II", self.uc.mem_read(self.table, 8))
        self.uc.reg_write(arm.UC_ARM_REG_SP, stack)

    def fault(self, text):
        if text not in self.faults:
            self.faults.append(text)

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

    def guard(self):
        """Where the memory protection's only region begins, which nobody may use; None if there is none."""
        control, base, kind = (self.system.get(offset, 0) for offset in (MPU_CONTROL, MPU_BASE, MPU_KIND))
        used = [n for n in range(8) if not kind >> (8 + n) & 1]
        if control & 7 != 5 or kind & ~0xFF00 != 7 << 1 | 1 or len(used) != 1:
            return None
        return (base & ~0xFF) + 32 * used[0]

    # Running.
    def stop(self, why):
        self.stop_reason = self.stop_reason or why
        self.uc.emu_stop()

    def tick_period(self):
        return (self.system.get(SYSTICK_RELOAD, 0) + 1) / self.core_hz()

    def next_tick(self):
        return self.ticked + self.tick_period() if self.system[SYSTICK] & 1 else None

    def on_sleep(self, uc, address, _size, _data):
        self.block = address + len(NOTHING)
        if self.due() is None:
            times = [time for time in (self.next_event(), self.next_tick()) if time is not None]
            if not times:
                self.stop("the program sleeps, and nothing will wake it")
            self.seconds = max(self.seconds, min([*times, self.until + LOOK]))
            self.look()
        uc.emu_stop()

    def on_return(self, uc, _address, _size, _data):
        self.returned = True
        uc.emu_stop()

    def on_block(self, _uc, address, size, _data):
        self.block = address  # the program counter is not kept up from block to block
        self.seconds += size * CYCLES_A_BYTE / self.core_hz()
        if self.seconds >= self.next_look:
            self.next_look = self.seconds + LOOK
            self.look()

    def look(self):
        self.look_at_part()
        if self.system[SYSTICK] & 1 and self.seconds - self.ticked >= self.tick_period():
            period = self.tick_period()
            self.ticked += period * int((self.seconds - self.ticked) / period)
            if self.system[SYSTICK] & 2:
                self.pending.add("tick")
        if self.due() is not None or self.seconds > self.until:
            self.uc.emu_stop()

    def due(self):
        self.raise_interrupts()
        ready = [one for one in self.pending if one == "tick" or one in self.enabled] if self.pending else None
        return sorted(ready, key=str)[0] if ready else None

    def masked(self):
        return bool(self.uc.reg_read(arm.UC_ARM_REG_PRIMASK) & 1)

    def run(self, seconds):
        """Until so much later, or until it stops; false if it does."""
        self.until = self.seconds + seconds
        self.next_look = self.seconds + 1e-6  # looks at what becomes pending from now on
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

    def check_table(self, one):
        """False where the core would take another's handler."""
        if not self.HAS_VTOR or self.system[VTOR] == self.table:
            return True
        if self.system[VTOR] == 0 and not self.started_by_rom:  # the flash is there, too
            self.fault("an interrupt comes before the vector table is set")
            return True
        self.stop(f"interrupt {one} by a vector table at {self.system[VTOR]:08x}")
        return False

    def interrupt(self, one):
        """The handler, to its end. What the core would push is kept here."""
        self.pending.discard(one)
        exception = 15 if one == "tick" else 16 + one
        if not self.check_table(one):
            return
        self.interrupts += 1
        handler, = struct.unpack("<I", self.uc.mem_read(self.table + 4 * exception, 4))
        if handler & ~1 == self.symbols["unexpected_exception"] & ~1:
            self.stop(f"interrupt {one}, which nobody expects")
            return
        pushed = PUSHED + PUSHED_FLOATS if self.HAS_FLOATS else PUSHED
        kept, back = [(register, self.uc.reg_read(register)) for register in pushed], self.pc
        self.uc.reg_write(arm.UC_ARM_REG_LR, RETURN | 1)
        self.uc.reg_write(arm.UC_ARM_REG_XPSR, self.uc.reg_read(arm.UC_ARM_REG_XPSR) & ~IF_THEN)
        self.returned = False
        while not self.returned and self.stop_reason is None:
            self.go(handler)
            handler = self.pc
        for register, value in kept:
            self.uc.reg_write(register, value)
        self.pc = back

    # States that a start may find.
    def mask_interrupts(self):
        self.uc.reg_write(arm.UC_ARM_REG_PRIMASK, 1)

    def use_other_stack(self):
        """The process stack, somewhere in memory that the program is going to use."""
        self.uc.reg_write(arm.UC_ARM_REG_CONTROL, 2)
        self.uc.reg_write(arm.UC_ARM_REG_SP, RAM + 0x1000)
