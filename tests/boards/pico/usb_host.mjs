// The computer at the other end of the USB cable: it finds the serial line, opens it, and may stop reading or go away.
import { USBCDC } from 'rp2040js';
import { UsbWire } from './usb_wire.mjs';

const kControlIn = 0x80; // buffer control of endpoint 0, in
const kControlOut = 0x84;
const kDataIn = 0x90; // buffer control of endpoint 2, in
const kDataOut = 0x94; // out
const kAvailable = 1 << 10;
const kData1 = 1 << 13;
const kPacket = 64;
const kEndpoints = { in: 0x82, out: 0x02 };
const kLateNanos = 50e3;
const kPatienceNanos = 200e3;
const kGetLineCoding = [0xa1, 0x21, 0, 0, 0, 0, 7, 0];

export class UsbHost extends UsbWire {
  constructor(mcu, send) {
    super(mcu);
    this.send = send;
    this.coming = [];
    this.asked = null;
    this.blocked = false;
    this.held = 0;
    this.wanted = []; // of the packets that are on their way: is it the next one of the sequence?
    this.sequence = { in: 0, out: 0 };
  }

  bufferGiven(offset, value) {
    if (offset === kDataIn && this.blocked) this.keep(offset, value);
    else if (offset === kDataIn) this.fetch(value);
    else if (offset === kDataOut) this.beAsked(value);
    else if (offset === kControlOut) {
      this.update(offset, value);
      this.own(offset, value);
    } else if (offset === kControlIn && this.deaf) this.own(offset, value);
    else {
      if (offset === kControlIn) this.expectFree(0, value);
      this.update(offset, value);
    }
  }

  // The controller has it, until something has come or gone, or it is taken back.
  own(offset, value) {
    if (value & kAvailable) this.owned.add(offset);
    this.usb.rp2040.usbDPRAMView.setUint32(offset, value, true);
  }

  keep(offset, value) {
    this.own(offset, value);
    this.held = value;
  }

  beAsked(value) {
    this.asked = null;
    this.update(kDataOut, value);
    if (this.asked !== null || !(value & kAvailable)) this.own(kDataOut, value); // else what waited has filled it
  }

  // A packet with the number of the one before is taken for that one again, and thrown away (USB 2.0 8.6).
  fetch(value) {
    this.owned.delete(kDataIn);
    this.expectFree(2, value);
    if (value & kAvailable) {
      const next = !!(value & kData1) === !!this.sequence.in;
      this.wanted.push(next);
      if (next) this.sequence.in ^= 1;
    }
    this.update(kDataIn, value);
  }

  /** Its interrupts come so late that several things have happened. */
  late() {
    const { usb } = this;
    const check = usb.checkInterrupts.bind(usb);
    const later = usb.rp2040.clock.createAlarm(() => {
      waiting = false;
      check();
    });
    let waiting = false;
    usb.checkInterrupts = () => {
      if (!usb.intStatus) check();
      else if (!waiting) {
        waiting = true;
        later.schedule(kLateNanos);
      }
    };
  }

  /** CLEAR_FEATURE(ENDPOINT_HALT), `which`: in or out. Both sides begin to count anew. */
  clear(which) {
    this.sequence[which] = 0;
    this.usb.sendSetupPacket(Uint8Array.from([0x02, 1, 0, 0, kEndpoints[which], 0, 0, 0]));
  }

  /** It asks for something, and gives up before the answer is fetched, as macOS does; then it asks for something else. */
  giveUp() {
    this.deaf = true;
    this.usb.sendSetupPacket(Uint8Array.from(kGetLineCoding));
    this.patience ??= this.usb.rp2040.clock.createAlarm(() => {
      this.deaf = false;
      this.open(true);
    });
    this.patience.schedule(kPatienceNanos);
  }

  plug() {
    this.cdc = new USBCDC(this.usb);
    this.cdc.onSerialData = (bytes) => this.wanted.shift() && this.send(bytes);
    this.sequence = { in: 0, out: 0 };
    this.wanted = [];
    this.usb.onEndpointRead = (endpoint, size) => {
      if (endpoint !== this.cdc.outEndpoint) return;
      this.asked = Math.min(size, kPacket);
      this.giveWhatCame();
    };
    this.usb.resetDevice();
  }

  /** Plugged in so long after the part begins to listen. */
  stayPlugged(nanos) {
    const later = this.usb.rp2040.clock.createAlarm(() => this.plug());
    this.usb.onUSBEnabled = () => later.schedule(nanos);
  }

  unplug() {
    this.coming = [];
    this.asked = null;
    this.suspend();
  }

  open(ready) {
    this.cdc.cdcSetControlLineState(ready ? 3 : 0);
  }

  block(blocked) {
    this.blocked = blocked;
    if (!blocked) this.fetch(this.held);
    this.held = 0;
  }

  come(bytes) {
    for (const byte of bytes) this.coming.push(byte);
    this.giveWhatCame();
  }

  giveWhatCame() {
    if (this.asked === null || !this.coming.length) return;
    this.owned.delete(kDataOut);
    const control = this.usb.rp2040.usbDPRAMView.getUint32(kDataOut, true);
    this.usb.rp2040.usbDPRAMView.setUint32(kDataOut, control & ~kAvailable, true);
    const expected = control & kData1 ? 1 : 0;
    if (expected !== this.sequence.out) throw Error(`USB: DATA${this.sequence.out} is sent, DATA${expected} awaited`);
    this.sequence.out ^= 1;
    const bytes = Uint8Array.from(this.coming.splice(0, this.asked));
    this.asked = null;
    this.usb.endpointReadDone(this.cdc.outEndpoint, bytes);
  }
}
