// The port of a computer that the part's USB cable is in, transfer by transfer, as USB/IP hands them on (usbip.mjs).
import { UsbWire } from './usb_wire.mjs';

const kControlIn = 0x80; // buffer control of endpoint 0, in
const kDataIn = 0x90; // of endpoint 2
const kDataOut = 0x94;
const kAvailable = 1 << 10;
const kStall = 1 << 11;
const kData1 = 1 << 13;
const kPullUp = 1 << 16;
const kPacket = 64;
const kDataEndpoint = 2;
const kBrokenPipe = -32; // -EPIPE: a stall, as Linux has it
const kAddress = 5;
// Requests (USB 2.0, 9.4).

const kClearFeature = 1;
const kSetAddress = 5;
const kSetConfiguration = 9;
const kSetInterface = 11;

/** A transfer: { number, in, endpoint, length, setup, data }; `setup` and `data` are arrays of bytes. */
export class UsbPort extends UsbWire {
  /** `answer(transfer, status, bytes)`: it has ended. */
  constructor(mcu, answer) {
    super(mcu);
    this.answer = answer;
    this.plugged = null; // called when the device is there
    this.leave();
    this.usb.onEndpointWrite = (endpoint, bytes) => (endpoint === 0 ? this.controlCame(bytes) : this.dataCame(bytes));
    this.usb.onEndpointRead = (endpoint, size) => (endpoint === 0 ? this.controlAsked() : (this.asked = Math.min(size, kPacket)));
  }

  leave() {
    this.control = null;
    this.waiting = { control: [], in: [], out: [], notices: [] };
    this.sequence = { in: 0, out: 0 };
    this.halted = { in: false, out: false };
    this.held = 0; // the control word of a packet that nobody has fetched
    this.fetching = false;
    this.asked = 0; // bytes that the part has room for
    this.armed = false; // endpoint 0 awaits something
  }

  // --- the cable

  /** `done` when it has its address. */
  plug(done) {
    this.leave();
    this.plugged = done;
    this.tryToPlug();
  }

  // A port sees a device by its pull-up.
  tryToPlug() {
    if (!(this.usb.sieCtrl & kPullUp)) {
      this.again ??= this.usb.rp2040.clock.createAlarm(() => this.tryToPlug());
      return this.again.schedule(1e6);
    }
    this.usb.onResetReceived = () => {
      this.usb.onResetReceived = undefined;
      this.submit({ in: false, endpoint: 0, length: 0, setup: [0, kSetAddress, kAddress, 0, 0, 0, 0, 0], data: [], done: () => this.addressed() });
    };
    return this.usb.resetDevice();
  }

  addressed() {
    this.check ??= this.usb.rp2040.clock.createAlarm(() => {
      if ((this.usb.addrEndp & 0x7f) !== kAddress) throw Error(`USB: the part took the address ${this.usb.addrEndp & 0x7f}`);
      this.plugged();
    });
    this.check.schedule(1e6); // 9.4.6: two milliseconds at most after the status
  }

  unplug() {
    this.leave();
    this.suspend();
  }

  // --- transfers

  submit(transfer) {
    if (transfer.endpoint === 0) {
      this.waiting.control.push(transfer);
      return this.beginControl();
    }
    const way = transfer.in ? 'in' : 'out';
    if (transfer.endpoint !== kDataEndpoint) return this.waiting.notices.push(transfer); // none ever comes
    if (this.halted[way]) return this.answer(transfer, kBrokenPipe, []);
    transfer.bytes = [];
    this.waiting[way].push(transfer);
    return transfer.in ? this.fetch() : this.give();
  }

  /** Whether it was still there to be taken back. */
  takeBack(number) {
    if (this.control?.transfer.number === number) {
      this.control.transfer.done = () => {};
      return true;
    }
    return Object.values(this.waiting).some((list) => {
      const at = list.findIndex((one) => one.number === number);
      if (at >= 0) list.splice(at, 1);
      return at >= 0;
    });
  }

  /** All transfers of an end point fail until its halt is cleared. */
  halt(way) {
    this.halted[way] = true;
    this.waiting[way].splice(0).forEach((one) => this.answer(one, kBrokenPipe, []));
  }

  end(transfer, status, bytes) {
    if (transfer.done) transfer.done(status);
    else this.answer(transfer, status, bytes);
  }

  // --- control

  beginControl() {
    if (this.control || !this.waiting.control.length) return;
    const transfer = this.waiting.control.shift();
    const { setup, length } = transfer;
    const phase = length === 0 ? 'status' : transfer.in ? 'in' : 'out';
    this.control = { transfer, phase, bytes: [], second: true };
    this.armed = false;
    this.restart(setup);
    this.usb.sendSetupPacket(Uint8Array.from(setup));
  }

  // Requests after which sequences begin anew (9.1.1.5, 9.4.5).
  restart([type, request, , , index]) {
    if (type === 0x02 && request === kClearFeature) {
      const way = index & 0x80 ? 'in' : 'out';
      this.sequence[way] = 0;
      this.halted[way] = false;
    }
    if ((type === 0 && request === kSetConfiguration) || (type === 1 && request === kSetInterface)) this.sequence = { in: 0, out: 0 };
  }

  endControl(status) {
    const { transfer, bytes } = this.control;
    this.control = null;
    this.end(transfer, status, bytes);
    this.beginControl();
  }

  // The device has sent a packet on endpoint 0.
  controlCame(bytes) {
    if (!this.control) return;
    const { transfer, phase } = this.control;
    if (phase === 'status') {
      if (bytes.length) throw Error(`USB: ${bytes.length} bytes where an acknowledgement is due`);
      this.endControl(0);
    } else if (phase === 'in') {
      this.control.bytes.push(...bytes);
      if (this.control.bytes.length > transfer.length) throw Error('USB: more bytes than were asked for');
      if (bytes.length === kPacket && this.control.bytes.length < transfer.length) return;
      if (!this.armed) throw Error('USB: the answer cannot be acknowledged');
      this.usb.endpointReadDone(0, new Uint8Array(0));
      this.endControl(0);
    }
  }

  // The device awaits a packet on endpoint 0.
  controlAsked() {
    this.armed = true;
    if (this.control?.phase !== 'out') return;
    this.usb.endpointReadDone(0, Uint8Array.from(this.control.transfer.data.splice(0, kPacket)));
    if (!this.control.transfer.data.length) this.control.phase = 'status';
  }

  expectSecond(value) {
    if (!(value & kAvailable) || !this.control) return;
    if (!!(value & kData1) !== this.control.second) throw Error('USB: a packet of endpoint 0 is out of sequence');
    this.control.second = !this.control.second;
  }

  // --- buffers that the part has handed over

  bufferGiven(offset, value) {
    if (offset === kControlIn && value & kStall && this.control) return this.endControl(kBrokenPipe);
    if (offset === kControlIn) {
      this.expectFree(0, value);
      this.expectSecond(value);
    }
    if (offset === kDataIn) {
      this.expectFree(kDataEndpoint, value);
      this.held = value;
      return this.fetch();
    }
    if (offset === kDataOut) this.asked = 0;
    this.update(offset, value);
    if (offset !== kDataOut) return undefined;
    this.usb.rp2040.usbDPRAMView.setUint32(offset, value, true); // the controller has it until something has come
    return this.give();
  }

  // One packet at a time. One with the number of the packet before is taken for that one again (8.6).
  fetch() {
    if (this.fetching || !(this.held & kAvailable) || !this.waiting.in.length) return;
    this.fetching = true;
    this.next = !!(this.held & kData1) === !!this.sequence.in;
    if (this.next) this.sequence.in ^= 1;
    const value = this.held;
    this.held = 0;
    this.update(kDataIn, value);
  }

  dataCame(bytes) {
    this.fetching = false;
    const [transfer] = this.waiting.in;
    if (transfer && this.next) {
      transfer.bytes.push(...bytes);
      if (bytes.length < kPacket || transfer.bytes.length >= transfer.length) this.answer(this.waiting.in.shift(), 0, transfer.bytes);
    }
    this.fetch();
  }

  give() {
    const [transfer] = this.waiting.out;
    if (!this.asked || !transfer) return;
    const memory = this.usb.rp2040.usbDPRAMView;
    const control = memory.getUint32(kDataOut, true);
    memory.setUint32(kDataOut, control & ~kAvailable, true);
    if (!!(control & kData1) !== !!this.sequence.out) throw Error(`USB: DATA${this.sequence.out} is sent, another one awaited`);
    this.sequence.out ^= 1;
    const bytes = Uint8Array.from(transfer.data.splice(0, this.asked));
    this.asked = 0;
    this.usb.endpointReadDone(kDataEndpoint, bytes);
    if (!transfer.data.length) this.answer(this.waiting.out.shift(), 0, []);
  }
}
