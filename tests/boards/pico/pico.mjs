// A Raspberry Pi Pico with our program in its flash: rp2040js, and what the part has around it.
import { LogLevel, ConsoleLogger, RP2040 } from 'rp2040js';
import { BootRom } from './boot_rom.mjs';
import { Rules } from './rules.mjs';
import { SerialLine } from './serial_line.mjs';
import { TwoWire } from './two_wire.mjs';
import { checkBoot2 } from './uf2.mjs';
import { UsbHost } from './usb_host.mjs';

const kBoot2 = 0x20041f00; // where the boot ROM copies it (RP2040 datasheet 2.8.1.3)
const kRom = 0x20042000; // its stack
const kCycleNanos = 8; // 125 MHz
// Outputs of which each change is kept: what stops the motors, and the motors'.
export const kTraced = { pico: [15, 16, 17], xrp: [20, 6, 7, 14, 15] };
// Of the console's and the camera's line, which UART.
const kLines = { pico: [0, 1], xrp: [1, 0] };
const kPlugNanos = 5e6; // an XRP's cable, after the part begins to listen
const kButton = 22; // its pin, on both boards
const kHigh = 1; // of rp2040js' states of a pin; all others are low at the end of a wire with a resistor to ground
const kWatchdogPauses = 7 << 24; // of its control register (4.7.6)
const kChipReset = { power: 1 << 8, run: 1 << 16, watchdog: 1 << 8 };

export class Pico {
  /**
   * `out`: where bytes go to: console(byte), camera(byte), usb(bytes). `counter`: sees each instruction, or nothing. `Host`:
   * what is at the other end of the USB cable. `board`: whose pins.
   */
  constructor(out, counter = null, Host = UsbHost, board = 'pico') {
    this.out = out;
    this.board = board;
    this.revision = 2;
    this.counter = counter;
    this.Host = Host;
    this.past = 0;
    this.instructions = 0;
    this.traces = new Map(kTraced[board].map((pin) => [pin, []])); // [microseconds, level] of each change
    this.flash = new Uint8Array(2 * 1024 * 1024).fill(0xff);
    this.flashId = [0xe6, 0x60, 0x58, 0x38, 0x83, 0x0a, 0xbc, 0x2f];
  }

  note(pin, high) {
    const trace = this.traces.get(pin);
    if ((trace.at(-1)?.[1] ?? 0) !== Number(high)) trace.push([Math.round(this.nanos / 1000), Number(high)]);
  }

  get nanos() {
    return this.past + (this.mcu ? this.mcu.clock.nanos : 0);
  }

  /** `how`: 'power', 'run' (the pin) or 'watchdog'. Memory is random after 'power' only. */
  start(how) {
    const before = this.mcu;
    const watchdog = before?.peripherals[0x40058];
    if (before) {
      this.past = this.nanos;
      this.flash.set(before.flash.subarray(0, this.flash.length));
    }
    const mcu = (this.mcu = new RP2040());
    this.held = false;
    mcu.logger = new ConsoleLogger(LogLevel.Error, true);
    mcu.flash.set(this.flash);
    if (how === 'power') mcu.sram.forEach((_, i) => (mcu.sram[i] = (i * 2654435761) >>> 24));
    else mcu.sram.set(before.sram);
    for (const pin of this.traces.keys()) this.note(pin, false); // a part in reset drives nothing
    this.wire(how, watchdog);
    this.rules = new Rules(mcu);
    this.rom.onAway = (away) => this.rules.flashAway(away);
    this.rules.onI2cReset = () => this.bus.reset();
    checkBoot2(mcu.flash);
    this.boot();
  }

  /** Starts as the boot ROM does. */
  boot() {
    const { mcu } = this;
    mcu.sram.set(mcu.flash.subarray(0, 256), kBoot2 - 0x20000000);
    mcu.core.PC = kBoot2;
    mcu.core.SP = kRom;
  }

  /** A debug probe resets the core alone: clocks and peripherals go on as they are. */
  resetCore() {
    const { mcu } = this;
    mcu.core = new mcu.core.constructor(mcu);
    this.rules.watchCore();
    this.usb.owned.clear(); // the program resets the controller
    this.boot();
  }

  /** A debug probe holds the core; pulses, pins and the watchdog go on, unless the program lets the watchdog pause. */
  holdCore() {
    const watchdog = this.mcu.peripherals[0x40058];
    if (watchdog.readUint32(0) & kWatchdogPauses) watchdog.timer.enable = false;
    this.held = true;
  }

  /** The push button connects its pin to ground. */
  press(down) {
    this.mcu.gpio[kButton].setInputValue(!down);
  }

  wire(how, oldWatchdog) {
    const { mcu } = this;
    mcu.peripherals[0x40000].readUint32 = () => ((this.revision << 28) | 0x2927) >>> 0; // only its identity is read
    this.press(false);
    this.rom = new BootRom(mcu, this.flashId);
    this.rom.onLoader = () => this.onLoader?.();
    for (const pin of this.traces.keys()) mcu.gpio[pin].addListener((state) => this.note(pin, state === kHigh));
    this.console = new SerialLine(mcu, kLines[this.board][0], this.out.console);
    // The camera is where it was asked last: the socket's bytes go there.
    const asked = (where) => (byte) => {
      this.asked = this[where];
      this.out.camera(byte);
    };
    this.camera = new SerialLine(mcu, kLines[this.board][1], asked('camera'));
    this.bus = new TwoWire(mcu, [0x54, 0x32], asked('bus')); // Pixy2, HuskyLens
    this.asked = undefined;
    this.usb = new this.Host(mcu, this.out.usb);
    if (this.board === 'xrp') this.usb.stayPlugged(kPlugNanos);
    const watchdog = mcu.peripherals[0x40058];
    if (how !== 'power') watchdog.scratchData.set(oldWatchdog.scratchData);
    if (how === 'watchdog') watchdog.reason = oldWatchdog.reason;
    watchdog.onWatchdogTrigger = () => {
      watchdog.timer.enable = false; // or rp2040js triggers again and again, and no time passes
      this.dead = true;
    };
    this.dead = false;
    mcu.peripherals[0x40064] = { readUint32: () => kChipReset[how], writeUint32Atomic: () => {} };
  }

  /** So many nanoseconds. */
  run(nanos) {
    const until = this.nanos + nanos;
    while (this.nanos < until) {
      if (this.dead) this.start('watchdog');
      this.advance(until - this.past);
    }
  }

  advance(until) {
    const { mcu } = this;
    const { core, clock } = mcu;
    while (clock.nanos < until && !this.dead) {
      if (!core.waiting && !this.held) {
        if (this.counter !== null) this.counter.see(core);
        const cycles = core.executeInstruction(); // it may let time pass itself: the flash does
        this.rules.see(core);
        clock.nanosCounter += cycles * kCycleNanos;
        if (clock.nextAlarm !== null && clock.nextAlarm.nanos <= clock.nanosCounter) clock.tick(0);
        this.instructions++;
      } else if (!this.held && core.checkForInterrupts()) {
        core.waiting = false;
      } else {
        const next = clock.nextAlarm ? Math.max(clock.nanosToNextAlarm, 0) : until;
        clock.tick(Math.min(next, until - clock.nanos));
      }
    }
  }
}
