// Rules that the RP2040 has and an emulator does not enforce: a program that breaks one ends the run. Sections are those
// of the RP2040 datasheet.

const kReset = 0x0;
const kNormal = 0;
const kClear = 3;
const kTarget = 0x04; // of the I2C master
const kDebugPause = 0x2c; // of the timer
const kCrystalEnable = 0xfab << 12; // of its control register
const kCrystalStartup = 0x0c;
const kCrystalStarts = 6 * 47; // times 256 / 12 MHz: 6 ms
const kProtection = 0xd94; // of the core (Armv6-M B3.5)
const kProtectionBase = 0xd9c;
const kProtectionKind = 0xda0;
const kFlashEnd = 0x20000000; // memory begins
const kFlash = 0x10000000 >>> 26; // of its addresses, with those past the cache, the first six bits
const kReads = ['readUint8', 'readUint16', 'readUint32'];
const kPullUp = 1 << 3; // of a pad
const kTimerInterrupt = 16; // its exception: it is interrupt 0
const kI2cInterrupt = 23;

// Bits of RESETS (2.14.3), and the peripherals' addresses / 4096.

const kGated = {
  0x40044: 3, 0x40014: 5, 0x4001c: 8, 0x40028: 12, 0x4002c: 13, 0x40050: 14, 0x40054: 21, 0x40034: 22, 0x40038: 23, 0x50110: 24,
};
const kPllSys = 12;
const kPllUsb = 13;

export class Rules {
  constructor(mcu) {
    this.mcu = mcu;
    this.held = 0x1ffffff; // in reset, all of them after power-on
    this.paused = 3; // the timer, while a debugger holds a core: so after its reset (4.6.5)
    this.watch(0x4000c, (offset, value, how) => this.reset(offset, value, how));
    this.startup = 0xc4; // of the crystal, after a reset
    this.watch(0x40024, (offset, value) => this.crystal(offset, value));
    this.watch(0x40044, (offset, value) => offset === kTarget && this.target(value & 0x3ff));
    this.watch(0x4001c, (offset, value) => this.pad(offset / 4 - 1, value));
    this.watch(0x40054, (offset, value) => offset === kDebugPause && (this.paused = value));
    for (const [place, bit] of Object.entries(kGated)) {
      this.watch(place, () => this.expect(!((this.held >>> bit) & 1), `written to 0x${Number(place).toString(16)}000 in reset`));
    }
    this.watchProtection();
    this.watchCore();
  }

  // Of the core's memory protection, which rp2040js leaves out: an eighth of a region of 256 bytes is nobody's.
  watchProtection() {
    const { ppb } = this.mcu;
    const write = ppb.writeUint32.bind(ppb);
    const words = { [kProtection]: 0, [kProtectionBase]: 0, [kProtectionKind]: 0 };
    this.guard = undefined;
    ppb.writeUint32 = (offset, value) => {
      if (!(offset in words)) return write(offset, value);
      words[offset] = value;
      const kind = words[kProtectionKind];
      const eighth = Math.log2(~(kind >>> 8) & 0xff);
      const right = words[kProtection] === 5 && (kind & 0xff) === 0xf && kind >>> 16 === 0 && Number.isInteger(eighth);
      this.guard = right ? (words[kProtectionBase] & ~0xff) + 32 * eighth : undefined;
      return undefined;
    };
  }

  expect(right, what) {
    if (!right) throw Error(`RP2040: ${what}`);
  }

  /** `see` each write before it is done. */
  watch(place, see) {
    const peripheral = this.mcu.peripherals[place];
    const write = peripheral.writeUint32Atomic.bind(peripheral);
    peripheral.writeUint32Atomic = (offset, value, how) => {
      see(offset, value, how);
      write(offset, value, how);
    };
  }

  // The core may be exchanged.
  watchCore() {
    const { core } = this.mcu;
    const enter = core.exceptionEntry.bind(core);
    core.exceptionEntry = (number) => {
      this.expect(core.VTOR >= kFlashEnd, `exception ${number} by a vector table at 0x${core.VTOR.toString(16)}`);
      this.expect(number !== kTimerInterrupt || this.paused === 0, 'the timer stops while a debugger holds a core');
      this.expect(number !== kTimerInterrupt || this.guard !== undefined, 'the stack has no guard');
      // Its line counts again, once the last one before a reset is taken (Armv6-M B3.4.1).
      if (number === kTimerInterrupt + kI2cInterrupt) this.mcu.i2c[0].checkInterrupts();
      enter(number);
    };
  }

  /**
   * After each instruction: the stack is above its guard, and no interrupt runs from the flash, which cannot be read while
   * it is written.
   */
  see(core) {
    if (core.registers[13] < this.guard + 32 && core.registers[13] >= kFlashEnd) throw Error('RP2040: the stack has grown into its guard');
    if (core.IPSR >= kTimerInterrupt && core.registers[15] < kFlashEnd) {
      throw Error(`RP2040: interrupt ${core.IPSR - kTimerInterrupt} runs at 0x${core.registers[15].toString(16)}`);
    }
  }

  /** While the flash takes commands nothing in it can be read by address (2.6.3): no data, no instruction. */
  flashAway(away) {
    const { mcu } = this;
    for (const name of kReads) {
      delete mcu[name];
      if (!away) continue;
      const read = mcu[name].bind(mcu);
      mcu[name] = (address) => {
        this.expect(address >>> 26 !== kFlash, `the flash is read at 0x${(address >>> 0).toString(16)} while it takes commands`);
        return read(address);
      };
    }
  }

  // An output that is pulled up is high wherever nothing drives it: STOP must not be.
  pad(pin, value) {
    const driven = (this.mcu.sio.gpioOutputEnable >>> pin) & 1;
    this.expect(pin < 0 || !driven || !(value & kPullUp), `GP${pin} is driven and pulled up`);
  }

  // 2.14.2, 2.18: what a clock comes from must not be reset.
  reset(offset, value, how) {
    if (offset !== kReset) return;
    const after = how === kNormal ? value : how === kClear ? this.held & ~value : this.held | value;
    const begun = after & ~this.held;
    const begins = (bit) => (begun >>> bit) & 1;
    const { clocks } = this.mcu;
    this.expect(!begins(kPllSys) || !(clocks.sysCtrl & 1), 'PLL_SYS is reset while the core runs on it');
    this.expect(!begins(kPllUsb) || !(clocks.usbCtrl & (1 << 11)), 'PLL_USB is reset while USB runs on it');
    this.held = after;
    if (begins(21)) this.paused = 3;
    if (begins(3)) {
      this.onI2cReset?.();
      this.mcu.setInterrupt(kI2cInterrupt, true); // the last one before the reset, just now
    }
  }

  // 2.16.3, STARTUP: the vendor gives a Pico's crystal 6 ms; with less some boards do not start cold.
  crystal(offset, value) {
    if (offset === kCrystalStartup) this.startup = value & 0x3fff;
    const enables = offset === 0 && (value & (0xfff << 12)) === kCrystalEnable;
    this.expect(!enables || this.startup >= kCrystalStarts, `the crystal is given ${this.startup} counts to start`);
  }

  // 4.3.17, IC_TAR: reserved addresses are not sent to.
  target(address) {
    this.expect(address > 0x07 && address < 0x78, `the I2C master cannot speak to the reserved address ${address}`);
  }
}
