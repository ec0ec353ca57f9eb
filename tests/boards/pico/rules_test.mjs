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
const kCrystal = 0x40024000;

// All peripherals out of reset.
function part() {
  const mcu = new RP2040();
  mcu.rules = new Rules(mcu);
  mcu.writeUint32(kResets + kClear, 0x1ffffff);
  return mcu;
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
  'the timer stops while a debugger holds a core': (mcu) => {
    mcu.core.VTOR = 0x10000100;
    mcu.core.exceptionEntry(16);
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
mcu.core.VTOR = 0x10000100;
mcu.core.exceptionEntry(16);
console.log(`${Object.keys(faults).length} faults found`);
