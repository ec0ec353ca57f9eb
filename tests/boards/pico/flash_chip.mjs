// The Pico's flash chip, when the program sends it commands. The SSI exchanges bytes (RP2040 datasheet 4.10.13), and the
// pin's override selects the chip (2.19.6.2). It knows one command: read unique id (W25Q16JV 8.2).
const kSsi = 0x18000;
const kPins = 0x40018; // IO_QSPI
const kSelect = 0x0c; // GPIO_QSPI_SS_CTRL
const kOverride = 3 << 8;
const kLow = 2 << 8;
const kStatus = 0x28;
const kData = 0x60;
const kEmpty = 1 << 2;
const kNotFull = 1 << 1;
const kReceived = 1 << 3;
const kByteNanos = 8 * 6 * 8; // at the divider that the ROM sets, 6
const kReadUniqueId = 0x4b;
const kBeforeId = 5; // the command, and four bytes that mean nothing

export class FlashChip {
  /** `id`: its bytes; null if the SSI never receives anything. `commands()`: whether reading by address is left. */
  constructor(mcu, id, commands) {
    this.clock = mcu.clock;
    this.id = id;
    this.select = 0;
    this.sent = 0; // bytes since the chip was selected
    this.coming = []; // [when, byte]
    const pins = mcu.peripherals[kPins];
    pins.readUint32 = (offset) => (offset === kSelect ? this.select : 0);
    pins.writeUint32 = (offset, value) => offset === kSelect && this.drive(value);
    const ssi = mcu.peripherals[kSsi];
    const read = ssi.readUint32.bind(ssi);
    const write = ssi.writeUint32.bind(ssi);
    ssi.readUint32 = (offset) => (offset === kStatus ? this.status() : offset === kData ? this.receive() : read(offset));
    ssi.writeUint32 = (offset, value) => {
      if (offset !== kData) return write(offset, value);
      if (!commands()) throw Error('SSI: a command to the flash while it is read by address');
      if (this.id) this.coming.push([this.clock.nanos + kByteNanos, this.answer(value & 0xff)]);
      return undefined;
    };
  }

  get selected() {
    return (this.select & kOverride) === kLow;
  }

  drive(value) {
    const before = this.selected;
    this.select = value;
    if (!before) this.sent = 0;
  }

  /** Of a chip that is not selected the line stays high. */
  answer(byte) {
    if (!this.selected) return 0xff;
    if (this.sent === 0) this.command = byte;
    const place = this.sent++ - kBeforeId;
    return this.command === kReadUniqueId && place >= 0 ? this.id[place % this.id.length] : 0xff;
  }

  status() {
    const received = this.coming.length > 0 && this.coming[0][0] <= this.clock.nanos;
    return kEmpty | kNotFull | (received ? kReceived : 0);
  }

  receive() {
    if (!(this.status() & kReceived)) throw Error('SSI: a byte is taken that has not come');
    return this.coming.shift()[1];
  }
}
