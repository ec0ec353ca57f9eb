"""Reset and clock control of the STM32F405 (RM0090 chapter 7): what runs, how fast, and what must not be done to it."""

CR, PLLCFGR, CFGR = 0x00, 0x04, 0x08
RESETS = {0x10: "AHB1", 0x14: "AHB2", 0x20: "APB1", 0x24: "APB2"}
ENABLES = {0x30: "AHB1", 0x34: "AHB2", 0x40: "APB1", 0x44: "APB2"}
HSI, HSE, PLL = 0, 1, 2
HSI_HZ = 16_000_000
SHIFTS = [0, 0, 0, 0, 1, 2, 3, 4]  # of an APB's divider: 7.3.3
START_SECONDS = {"hse": 0.002, "pll": 0.0002}  # datasheet: crystal, PLL characteristics
# 168 MHz of core, 42 and 84 of the buses (datasheet 5.3.1); a wait state for each 30 MHz (3.5.1, 2.7 to 3.6 V).
MAX_HZ = {"core": 168e6, "apb1": 42e6, "apb2": 84e6}
WAIT_STATE_HZ = 30e6


class ClockTree:
    def __init__(self, crystal_hz, faults):
        self.crystal_hz = crystal_hz  # None: there is none
        self.faults = faults
        self.words = {CR: 0x83, PLLCFGR: 0x24003010, CFGR: 0, 0x30: 0x00100000}
        self.switched = HSI
        self.since = {"hse": None, "pll": None}
        self.flash_waits = lambda: 0

    def ready(self, which, seconds):
        began = self.since[which]
        return began is not None and seconds - began >= START_SECONDS[which]

    def start(self, which, seconds):
        """It has run for long."""
        self.since[which] = seconds - 1

    def pll_hz(self):
        word = self.words[PLLCFGR]
        source = self.crystal_hz if word & 1 << 22 else HSI_HZ
        divider, factor = word & 0x3F, word >> 6 & 0x1FF
        if not source or not divider:
            return 0
        return source / divider * factor / (2 * ((word >> 16 & 3) + 1))

    def core_hz(self):
        return {HSI: HSI_HZ, HSE: self.crystal_hz, PLL: self.pll_hz()}[self.switched] or 1

    def bus_hz(self, bus):
        shift = 10 if bus == "apb1" else 13
        return self.core_hz() / (1 << SHIFTS[self.words[CFGR] >> shift & 7]) if self.words[CFGR] >> shift & 4 else self.core_hz()

    def timer_hz(self, bus):
        """Timers run at twice their bus's clock where that is divided (7.2)."""
        return self.bus_hz(bus) * (2 if self.bus_hz(bus) != self.core_hz() else 1)

    def crystal_for_clock_hz(self):
        """The clock that timer 11 may measure: the crystal divided by 2 to 31."""
        divider = self.words[CFGR] >> 16 & 0x1F
        return self.crystal_hz / divider if self.crystal_hz and divider > 1 else 0

    def read(self, offset, seconds):
        if offset == CR:
            word = self.words[CR] & ~(1 << 1 | 1 << 17 | 1 << 25)
            word |= 1 << 1 if word & 1 else 0
            word |= 1 << 17 if self.crystal_hz and self.ready("hse", seconds) else 0
            return word | (1 << 25 if self.ready("pll", seconds) else 0)
        if offset == CFGR:
            self.switch(seconds)
            return self.words[CFGR] & ~0xC | self.switched << 2
        return self.words.get(offset, 0)

    def write(self, offset, value, seconds):
        before = self.words.get(offset, 0)
        if offset == PLLCFGR and self.words[CR] & 1 << 24:
            self.faults.append("the PLL is set up while it runs")
            return
        self.words[offset] = value
        if offset == CR:
            self.write_control(before, value, seconds)
        if offset == CFGR:
            self.check()  # the dividers change at once, the switch takes some cycles
        if offset in (CFGR, CR):
            self.switch(seconds)

    def write_control(self, before, value, seconds):
        for which, bit, source in (("hse", 16, HSE), ("pll", 24, PLL)):
            if value & 1 << bit and not before & 1 << bit:
                self.since[which] = seconds
            if before & 1 << bit and not value & 1 << bit:
                if self.switched == source:
                    self.faults.append(f"the {which} is stopped while the core runs on it")
                    self.words[CR] |= 1 << bit  # the part does not (7.3.1)
                else:
                    self.since[which] = None

    def switch(self, seconds):
        wanted = self.words[CFGR] & 3
        there = {HSI: self.words[CR] & 1, HSE: self.crystal_hz and self.ready("hse", seconds), PLL: self.ready("pll", seconds)}
        if wanted in there and there[wanted]:
            self.switched = wanted
        self.check()

    def check(self):
        for name, hz in (("core", self.core_hz()), ("apb1", self.bus_hz("apb1")), ("apb2", self.bus_hz("apb2"))):
            if hz > MAX_HZ[name] * 1.001:
                self.fault_once(f"{name} runs at {hz / 1e6:.0f} MHz")
        if self.core_hz() > (self.flash_waits() + 1) * WAIT_STATE_HZ * 1.001:
            self.fault_once(f"the core runs at {self.core_hz() / 1e6:.0f} MHz with {self.flash_waits()} wait states")

    def fault_once(self, text):
        if text not in self.faults:
            self.faults.append(text)
