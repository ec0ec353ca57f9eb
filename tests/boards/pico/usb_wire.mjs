// The USB cable's end at the part: rp2040js' controller, where it differs from the part's, and what the part forbids.

const kFrame = 0x48; // the frame's number
const kSieStatus = 0x50; // of the serial engine
const kAbort = 0x60; // asks for buffers back
const kSuspended = 1 << 4; // of the status
const kTellFrame = 1 << 17; // of the interrupts
const kAvailable = 1 << 10; // of a buffer's control: the controller has it
const kSendNanos = 10e3; // a packet
const kFrameNanos = 1e6; // USB 2.0 7.1.12
const kFrameEndNanos = 800e3; // erratum RP2040-E15
const kBufferControl = 0x80; // eight bytes an endpoint
const kBufferControls = 0x80;
const kDataIn = 0x90; // of endpoint 2
const kControls = [0x80, 0x84];

export class UsbWire {
  constructor(mcu) {
    this.usb = mcu.usbCtrl;
    this.clock = mcu.clock;
    this.revision = mcu.readUint32(0x40000000) >>> 28;
    this.sending = []; // endpoints whose packets are on the wire
    this.owned = new Set(); // buffer controls of which the controller has the buffer
    this.before = new Set(); // those of endpoint 0, of requests before this one
    this.frames = mcu.clock.createAlarm(() => this.beginFrame());
    this.usb.onUSBEnabled = () => {}; // nobody is there
    this.mendEmulator();
  }

  /** A buffer's control word was written: by default the controller goes on with it at once. */
  bufferGiven(offset, value) {
    this.update(offset, value);
  }

  // It knows neither frames nor the status bit of a host that is asleep. It takes what the device sends at once, wanted or
  // not, and says that it is sent before it is.
  mendEmulator() {
    const { usb } = this;
    const write = usb.writeUint32.bind(usb);
    usb.writeUint32 = (offset, value) => {
      if (offset === kSieStatus && usb.rawWriteValue & kSuspended) usb.sieStatus &= ~kSuspended;
      if (offset === kAbort && this.revision < 2) throw Error('USB: an abort, which this revision does not do (RP2040-E2)');
      write(offset, value);
    };
    const read = usb.readUint32.bind(usb);
    usb.readUint32 = (offset) => {
      if (offset === kFrame) {
        usb.intRaw &= ~kTellFrame;
        usb.checkInterrupts();
      }
      return read(offset);
    };
    const reset = usb.resetDevice.bind(usb);
    usb.resetDevice = () => {
      reset();
      this.beginFrame();
    };
    const setUp = usb.sendSetupPacket.bind(usb);
    usb.sendSetupPacket = (packet) => {
      this.before = new Set(kControls.filter((offset) => this.owned.has(offset)));
      setUp(packet);
    };
    this.update = usb.DPRAMUpdated.bind(usb);
    usb.DPRAMUpdated = (offset, value) => {
      this.see(offset, value);
      this.bufferGiven(offset, value);
    };
    const ready = usb.indicateBufferReady.bind(usb);
    const sent = usb.rp2040.clock.createAlarm(() => this.sending.splice(0).forEach((endpoint) => ready(endpoint, false)));
    usb.indicateBufferReady = (endpoint, out) => {
      if (out) return ready(endpoint, out);
      this.sending.push(endpoint);
      return sent.schedule(kSendNanos);
    };
  }

  // A millisecond each, while the host is awake.
  beginFrame() {
    this.frameBegan = this.clock.nanos;
    this.frames.schedule(kFrameNanos);
    this.usb.intRaw |= kTellFrame;
    this.usb.checkInterrupts();
  }

  see(offset, value) {
    if (offset < kBufferControl || offset >= kBufferControl + kBufferControls) return;
    if (this.owned.delete(offset)) {
      const bit = 1 << ((offset - kBufferControl) / 4);
      if (this.revision >= 2 && !(this.usb.epAbort & bit)) throw Error('USB: a buffer is taken back without an abort');
      this.before.delete(offset);
    }
    if (!(value & kAvailable)) return;
    if (kControls.includes(offset) && this.before.size) throw Error('USB: an answer, while a buffer of the request before waits');
    const late = this.clock.nanos - this.frameBegan;
    if (offset === kDataIn && late > kFrameEndNanos) {
      throw Error(`USB: a bulk IN buffer is handed over ${Math.round(late / 1000)} us after the frame began (RP2040-E15)`);
    }
  }

  expectFree(endpoint, value) {
    if (value & kAvailable && this.sending.includes(endpoint)) {
      throw Error(`USB: a packet of endpoint ${endpoint} is written over before it is sent`);
    }
  }

  /** The computer falls asleep, or the cable is out: the part cannot tell one from the other. */
  suspend() {
    this.frames.cancel();
    this.usb.sieStatus |= kSuspended;
    this.usb.sieStatusUpdated();
  }
}
