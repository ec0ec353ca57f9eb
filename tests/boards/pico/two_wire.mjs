// A camera on the two-wire bus that takes and gives a stream of bytes. Bytes from the board go to the socket, the
// answers come from there. A device without an answer sends zeros.
const kInterruptMask = 0x30;
const kMaskAfterReset = 0x8ff; // RP2040 datasheet 4.3.17
const kByteNanos = 90e3; // nine bits at 100 kHz

export class TwoWire {
  constructor(mcu, addresses, send) {
    const bus = mcu.i2c[0];
    this.bus = bus;
    this.coming = [];
    this.there = true;
    const write = bus.writeUint32.bind(bus); // rp2040js has the mask, but does not let it be written
    bus.writeUint32 = (offset, value) => {
      if (offset !== kInterruptMask) return write(offset, value);
      bus.intEnable = value;
      return bus.checkInterrupts();
    };
    const later = (this.later = mcu.clock.createAlarm(() => this.next()));
    const after = (next) => {
      this.next = next;
      later.schedule(kByteNanos);
    };
    bus.onStart = () => after(() => bus.completeStart());
    bus.onConnect = (target) => after(() => bus.completeConnect(this.there && addresses.includes(target)));
    bus.onWriteByte = (byte) => {
      send(byte);
      after(() => bus.completeWrite(true));
    };
    bus.onReadByte = () => after(() => bus.completeRead(this.coming.shift() ?? 0));
    bus.onStop = () => after(() => bus.completeStop());
  }

  /** The part's master is reset: nothing is left of a transfer, and its interrupt falls. rp2040js leaves this out. */
  reset() {
    const { bus } = this;
    this.later.cancel();
    bus.txFIFO.reset();
    bus.rxFIFO.reset();
    Object.assign(bus, { state: 0, busy: false, stop: false, pendingRestart: false, enable: 0, intRaw: 0 });
    bus.intEnable = kMaskAfterReset;
    bus.checkInterrupts();
  }

  come(bytes) {
    for (const byte of bytes) this.coming.push(byte);
  }
}
