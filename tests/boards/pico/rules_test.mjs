// usage: node rules_test.mjs
//
// Each rule finds its fault.
import assert from 'node:assert';
import { RP2040 } from 'rp2040js';
import { Rules } from './rules.mjs';

const kResets = 0x4000c000;
const kClear = 0x3000;
const kSet = 0x2000;
const kSysControl = 0x4000803c;
const kUsbControl = 0x40008054;
const kI2cTarget = 0x40044004;
const kPause = 0x4005402c;
const kOutputEnable = 0xd0000024;
const kPads = 0x4001c000;
const kCrystal = 0x40024000;

// All peripherals out of reset.
function part() {
  const mcu = new RP2040();
  mcu.rules = new Rules(mcu);
  mcu.writeUint32(kResets + kClear, 0x1ffffff);
  return mcu;
}
// The bytes from 0x20000100 on.
function guard(mcu) {
  mcu.writeUint32(0xe000ed9c, 0x20000110);
  mcu.writeUint32(0xe000eda0, 0xfe0f);
  mcu.writeUint32(0xe000ed94, 5);
}
const faults = {
  'the crystal is given 47 counts to start': (mcu) => {
    mcu.writeUint32(kCrystal + 0xc, 47);
    mcu.writeUint32(kCrystal, 0xfabaa0);
  },
  'the crystal is given 196 counts to start': (mcu) => mcu.writeUint32(kCrystal, 0xfabaa0),
  'PLL_SYS is reset while the core runs on it': (mcu) => {
    mcu.writeUint32(kSysControl, 1);
    mcu.writeUint32(kResets + kSet, 1 << 12);
  },
  'PLL_USB is reset while USB runs on it': (mcu) => {
    mcu.writeUint32(kUsbControl, 1 << 11);
    mcu.writeUint32(kResets, 1 << 13);
  },
  'the I2C master cannot speak to the reserved address 1': (mcu) => mcu.writeUint32(kI2cTarget, 1),
  'written to 0x40044000 in reset': (mcu) => {
    mcu.writeUint32(kResets + kSet, 1 << 3);
    mcu.writeUint32(kI2cTarget, 0x54);
  },
  'exception 16 by a vector table at 0x0': (mcu) => mcu.core.exceptionEntry(16),
  'the stack has no guard': (mcu) => {
    mcu.writeUint32(kPause, 0);
    mcu.core.VTOR = 0x20000000;
    mcu.core.exceptionEntry(16);
  },
  'the stack has grown into its guard': (mcu) => {
    guard(mcu);
    mcu.core.registers[13] = 0x20000120;
    mcu.rules.see(mcu.core);
    mcu.core.registers[13] -= 4;
    mcu.rules.see(mcu.core);
  },
  'the timer stops while a debugger holds a core': (mcu) => {
    guard(mcu);
    mcu.core.VTOR = 0x20000000;
    mcu.core.exceptionEntry(16);
  },
  'GP15 is driven and pulled up': (mcu) => {
    mcu.writeUint32(kOutputEnable, 1 << 15);
    mcu.writeUint32(kPads + 4 + 4 * 15, 0x5a);
  },
  'the flash is read at 0x10000200 while it takes commands': (mcu) => {
    mcu.rules.flashAway(true);
    mcu.core.PC = 0x10000200;
    mcu.core.executeInstruction();
  },
  'the flash is read at 0x13000203 while it takes commands': (mcu) => {
    mcu.rules.flashAway(true);
    mcu.readUint8(0x13000203);
  },
  'interrupt 5 runs at 0x10014cec': (mcu) => {
    mcu.core.IPSR = 21;
    mcu.core.PC = 0x10014cec;
    mcu.rules.see(mcu.core);
  },
};
for (const [what, fault] of Object.entries(faults)) {
  assert.throws(() => fault(part()), { message: `RP2040: ${what}` });
}

const mcu = part();
mcu.writeUint32(kCrystal + 0xc, 282);
mcu.writeUint32(kCrystal, 0xfabaa0);
mcu.writeUint32(kResets + kSet, 1 << 12);
mcu.writeUint32(kResets + kClear, 1 << 12);
mcu.writeUint32(kSysControl, 1);
mcu.writeUint32(kI2cTarget, 0x54);
mcu.writeUint32(kPause, 0);
mcu.core.VTOR = 0x20000000;
guard(mcu);
mcu.writeUint32(kPads + 4, 0x5a);
mcu.writeUint32(kOutputEnable, 1 << 15);
mcu.writeUint32(kPads + 4 + 4 * 15, 0x56);
mcu.core.exceptionEntry(16);
mcu.rules.flashAway(true);
mcu.readUint32(0x20000100);
mcu.readUint32(0x18000028);
mcu.rules.flashAway(false);
mcu.readUint32(0x10000000);
// The interrupt that came just before its part's reset is taken once.
const pending = () => (mcu.core.pendingInterrupts >>> 23) & 1;
mcu.writeUint32(kResets + kSet, 1 << 3);
assert.equal(pending(), 1);
mcu.core.exceptionEntry(16 + 23);
assert.equal(pending(), 0);
console.log(`${Object.keys(faults).length} faults found`);
