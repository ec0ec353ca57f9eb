// The USB cable's end at the part: rp2040js' controller, where it differs from the part's.
const kSieStatus = 0x50;
const kSuspended = 1 << 4;
const kAvailable = 1 << 10;
const kSendNanos = 10e3;

export class UsbWire {
  constructor(mcu) {
    this.usb = mcu.usbCtrl;
    this.sending = []; // endpoints whose packets are on the wire
    this.usb.onUSBEnabled = () => {}; // nobody is there
    this.mendEmulator();
  }

  /** A buffer's control word was written: by default the controller goes on with it at once. */
  bufferGiven(offset, value) {
    this.update(offset, value);
  }

  // It does not know the status bit of a host that is asleep, it takes what the device sends at once, wanted or not, and
  // says that it is sent before it is.
  mendEmulator() {
    const { usb } = this;
    const write = usb.writeUint32.bind(usb);
    usb.writeUint32 = (offset, value) => {
      if (offset === kSieStatus && usb.rawWriteValue & kSuspended) usb.sieStatus &= ~kSuspended;
      write(offset, value);
    };
    this.update = usb.DPRAMUpdated.bind(usb);
    usb.DPRAMUpdated = (offset, value) => this.bufferGiven(offset, value);
    const ready = usb.indicateBufferReady.bind(usb);
    const sent = usb.rp2040.clock.createAlarm(() => this.sending.splice(0).forEach((endpoint) => ready(endpoint, false)));
    usb.indicateBufferReady = (endpoint, out) => {
      if (out) return ready(endpoint, out);
      this.sending.push(endpoint);
      return sent.schedule(kSendNanos);
    };
  }

  expectFree(endpoint, value) {
    if (value & kAvailable && this.sending.includes(endpoint)) {
      throw Error(`USB: a packet of endpoint ${endpoint} is written over before it is sent`);
    }
  }

  /** The computer falls asleep, or the cable is out: the part cannot tell one from the other. */
  suspend() {
    this.usb.sieStatus |= kSuspended;
    this.usb.sieStatusUpdated();
  }
}
