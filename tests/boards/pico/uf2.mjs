// A UF2 file, as the boot ROM's disk takes it, into the flash; and the check the ROM makes before it starts it.

const kFirst = 0x0a324655;
const kSecond = 0x9e5d5157;
const kLast = 0x0ab16f30;
const kFamily = 0xe48bff56;
const kFlash = 0x10000000;

const kSector = 4096;

/** It erases as the ROM does: the first block of each sixteen erases the sector that it lies in (erratum RP2040-E14). */
export function loadUf2(file, flash) {
  if (file.length === 0 || file.length % 512 !== 0) throw Error('a UF2 file has blocks of 512 bytes');
  for (let at = 0; at < file.length; at += 512) {
    const word = (offset) => file.readUInt32LE(at + offset);
    if (word(0) !== kFirst || word(4) !== kSecond || word(508) !== kLast) throw Error(`no UF2 block at ${at}`);
    if (word(28) !== kFamily) throw Error('this UF2 is not for the RP2040');
    const target = word(12) - kFlash;
    if (word(20) % 16 === 0) flash.fill(0xff, target - (target % kSector), target - (target % kSector) + kSector);
    file.subarray(at + 32, at + 32 + word(16)).forEach((byte, i) => (flash[target + i] &= byte));
  }
}

/** CRC-32/MPEG-2 of the 252 bytes before it (RP2040 datasheet 2.8.1.3.1). */
export function checkBoot2(flash) {
  let crc = 0xffffffff;
  for (let i = 0; i < 252; i++) {
    crc ^= flash[i] << 24;
    for (let k = 0; k < 8; k++) crc = crc & 0x80000000 ? (crc << 1) ^ 0x04c11db7 : crc << 1;
  }
  const stored = new DataView(flash.buffer).getUint32(252, true);
  if (crc >>> 0 !== stored) throw Error(`boot2: CRC ${(crc >>> 0).toString(16)}, not ${stored.toString(16)}`);
}
