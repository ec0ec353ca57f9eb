// One of the part's UARTs at its own pace, which rp2040js leaves out. Bytes come and go one at a time. The queue
// for sending has 32 bytes; bytes that come while the other queue is full are lost. An interrupt comes when a queue is
// half full or half empty, or a byte has waited for 32 bits (RP2040 datasheet 4.2.6).

const kQueue = 32;
const kReceiveInterrupt = 1 << 4;
const kReceiveTimeout = 1 << 6;
const kSendFull = 1 << 5;
const kSendInterrupt = 1 << 5;

export class SerialLine {
  constructor(mcu, number, send) {
    this.uart = mcu.uart[number];
    this.mcu = mcu;
    this.send = send;
    this.sending = [];
    this.coming = [];
    this.lost = 0;
    this.sendAlarm = mcu.clock.createAlarm(() => this.sent());
    this.receiveAlarm = mcu.clock.createAlarm(() => this.received());
    const { uart } = this;
    const flags = Object.getOwnPropertyDescriptor(Object.getPrototypeOf(uart), 'flags').get;
    Object.defineProperty(uart, 'flags', { get: () => flags.call(uart) | (this.sending.length >= kQueue ? kSendFull : 0) });
    uart.checkInterrupts = () => mcu.setInterrupt(uart.irq, !!(uart.interruptStatus & uart.interruptMask));
    uart.onByte = (byte) => this.take(byte);
    this.timeoutAlarm = mcu.clock.createAlarm(() => this.raise(kReceiveTimeout));
    const read = uart.readUint32.bind(uart);
    uart.readUint32 = (offset) => {
      const value = read(offset);
      if (offset === 0 && uart.rxFIFO.empty) this.fall(kReceiveInterrupt | kReceiveTimeout);
      return value;
    };
  }

  raise(interrupt) {
    if (!this.uart.rxFIFO.empty) this.uart.interruptStatus |= interrupt;
    this.uart.checkInterrupts();
  }

  fall(interrupts) {
    this.uart.interruptStatus &= ~interrupts;
    this.uart.checkInterrupts();
  }

  get byteNanos() {
    return 1e10 / this.uart.baudRate;
  }

  take(byte) {
    this.sending.push(byte);
    if (this.sending.length === 1) this.sendAlarm.schedule(this.byteNanos);
    this.tellLevel();
  }

  sent() {
    this.send(this.sending.shift());
    if (this.sending.length) this.sendAlarm.schedule(this.byteNanos);
    this.tellLevel();
  }

  // Half empty, as the part's threshold is after a reset.
  tellLevel() {
    if (this.sending.length === kQueue / 2) this.uart.interruptStatus |= kSendInterrupt;
    if (this.sending.length > kQueue / 2) this.uart.interruptStatus &= ~kSendInterrupt;
    this.uart.checkInterrupts();
  }

  come(bytes) {
    if (!this.coming.length) this.receiveAlarm.schedule(this.byteNanos);
    for (const byte of bytes) this.coming.push(byte);
  }

  received() {
    const byte = this.coming.shift();
    if (this.coming.length) this.receiveAlarm.schedule(this.byteNanos);
    if (!this.uart.enabled) return;
    if (this.uart.rxFIFO.full) {
      this.lost++;
      return;
    }
    this.uart.rxFIFO.push(byte);
    if (this.uart.rxFIFO.itemCount >= kQueue / 2) this.raise(kReceiveInterrupt);
    this.timeoutAlarm.schedule(3.2 * this.byteNanos);
  }
}
