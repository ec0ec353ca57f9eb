// The boot ROM's functions that our program uses: its table of functions, and those that change the flash (RP2040
// datasheet 2.8.3). The ROM itself is not ours to copy. The functions end the emulation where the part would hang.
import { FlashChip } from './flash_chip.mjs';

const kTable = 0x100;
const kLookUp = 0x180;
const kFunctions = 0x200;
const kSector = 4096;
const kPage = 256;
const kHang = 0x300; // b .
const kHardFault = 3;
const kFlashSize = 2 * 1024 * 1024; // the Pico's chip
const kEraseNanos = 400e6; // W25Q16JV 9.6, at most: longer than the watchdog waits otherwise
const kProgramNanos = 0.4e6;

const kCodes = ['IF', 'EX', 'RE', 'RP', 'FC', 'CX', 'UB'];

// look_up(r0: table, r1: code) -> r0, 0 if there is none.
const kLookUpCode = [
  0x8802, // 1: ldrh r2, [r0]
  0x2a00, //    cmp r2, #0
  0xd005, //    beq 3f
  0x428a, //    cmp r2, r1
  0xd001, //    beq 2f
  0x3004, //    adds r0, #4
  0xe7f8, //    b 1b
  0x8840, // 2: ldrh r0, [r0, #2]
  0x4770, //    bx lr
  0x2000, // 3: movs r0, #0
  0x4770, //    bx lr
];

export class BootRom {
  /** `flashId`: of the chip (flash_chip.mjs). */
  constructor(mcu, flashId) {
    this.mcu = mcu;
    this.state = 'reading';
    this.chip = new FlashChip(mcu, flashId, () => this.state === 'commands');
    this.erased = 0;
    this.programmed = 0;
    const rom = new DataView(mcu.bootrom.buffer);
    rom.setUint32(0x10, 0x0201754d, true); // 'M', 'u', 1; version 2
    rom.setUint16(0x14, kTable, true);
    rom.setUint16(0x18, kLookUp | 1, true);
    kLookUpCode.forEach((word, i) => rom.setUint16(kLookUp + 2 * i, word, true));
    kCodes.forEach((code, i) => {
      rom.setUint16(kTable + 4 * i, code.charCodeAt(0) | (code.charCodeAt(1) << 8), true);
      rom.setUint16(kTable + 4 * i + 2, (kFunctions + 4 * i) | 1, true);
      rom.setUint16(kFunctions + 4 * i, 0xbe00 | i, true); // bkpt #i, and bx lr
      rom.setUint16(kFunctions + 4 * i + 2, 0x4770, true);
    });
    rom.setUint16(kHang, 0xe7fe, true);
    mcu.onBreak = (number) => (mcu.core.PC < 0x4000 ? this.run(kCodes[number]) : this.fault());
  }

  /** rp2040js leaves this out: an instruction that cannot be ends in a hard fault (Armv6-M B1.5). */
  fault() {
    const { core } = this.mcu;
    core.waiting = false;
    core.PC -= 2;
    core.exceptionEntry(kHardFault);
  }

  /** The program is lost in an endless loop; interrupts still come. */
  hang() {
    this.mcu.core.PC = kHang;
    this.mcu.core.waiting = false;
  }

  run(code) {
    if (code === 'UB') return this.startLoader();
    const { core } = this.mcu;
    const [r0, r1, r2, r3] = core.registers;
    if (!core.PM) throw Error(`ROM ${code}: an interrupt could come, and read the flash`);
    if (core.LR >>> 28 !== 2) throw Error(`ROM ${code}: its caller lies in the flash`);
    const expected = { IF: 'reading', EX: 'connected', RE: 'commands', RP: 'commands', FC: 'commands', CX: 'flushed' }[code];
    if (this.state !== expected) throw Error(`ROM ${code}: called while the flash is ${this.state}`);
    this.state = { IF: 'connected', EX: 'commands', RE: 'commands', RP: 'commands', FC: 'flushed', CX: 'reading' }[code];
    if (code === 'FC') this.chip.drive(0);
    this.onAway?.(this.state !== 'reading');
    if (code === 'RE') this.erase(r0, r1, r2, r3);
    if (code === 'RP') this.program(r0, r1, r2);
  }

  /** The ROM's drive appears; the program is over. */
  startLoader() {
    this.mcu.peripherals[0x40058].timer.enable = false;
    this.hang();
    this.onLoader?.();
  }

  erase(offset, count, block, command) {
    if (offset % kSector || count % kSector || offset + count > kFlashSize || block !== kSector || command !== 0x20) {
      throw Error(`ROM RE: offset ${offset}, count ${count}, block ${block}, command ${command}`);
    }
    this.mcu.flash.fill(0xff, offset, offset + count);
    this.mcu.clock.tick((kEraseNanos * count) / kSector);
    this.erased++;
  }

  program(offset, data, count) {
    if (offset % kPage || count % kPage || offset + count > kFlashSize) throw Error(`ROM RP: offset ${offset}, count ${count}`);
    for (let i = 0; i < count; i++) this.mcu.flash[offset + i] &= this.mcu.readUint8(data + i);
    this.mcu.clock.tick((kProgramNanos * count) / kPage);
    this.programmed++;
  }
}
