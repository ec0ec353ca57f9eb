// The computer at the other end of the USB cable: it finds the serial line, opens it, and may stop reading or go away.
import { USBCDC } from 'rp2040js';

const kSieStatus = 0x50;
const kSuspended = 1 << 4;
const kDataIn = 0x90; // buffer control of endpoint 2, in
const kPacket = 64;

export class UsbHost {
  constructor(mcu, send) {
    this.usb = mcu.usbCtrl;
    this.send = send;
    this.coming = [];
    this.asked = null;
    this.blocked = false;
    this.held = [];
    this.usb.onUSBEnabled = () => {}; // nobody is there
    this.mendEmulator();
  }

  // Where rp2040js differs from the part: it does not know the status bit of a host that is asleep, and it takes what the
  // device sends at once, wanted or not.
  mendEmulator() {
    const { usb } = this;
    const write = usb.writeUint32.bind(usb);
    usb.writeUint32 = (offset, value) => {
      if (offset === kSieStatus && usb.rawWriteValue & kSuspended) usb.sieStatus &= ~kSuspended;
      write(offset, value);
    };
    const update = usb.DPRAMUpdated.bind(usb);
    usb.DPRAMUpdated = (offset, value) => {
      if (offset === kDataIn && this.blocked) this.held.push(value);
      else update(offset, value);
    };
    this.update = update;
  }

  plug() {
    this.cdc = new USBCDC(this.usb);
    this.cdc.onSerialData = (bytes) => this.send(bytes);
    this.usb.onEndpointRead = (endpoint, size) => {
      if (endpoint !== this.cdc.outEndpoint) return;
      this.asked = Math.min(size, kPacket);
      this.giveWhatCame();
    };
    this.usb.resetDevice();
  }

  unplug() {
    this.coming = [];
    this.asked = null;
    this.usb.sieStatus |= kSuspended;
    this.usb.sieStatusUpdated();
  }

  open(ready) {
    this.cdc.cdcSetControlLineState(ready ? 3 : 0);
  }

  block(blocked) {
    this.blocked = blocked;
    if (!blocked) this.held.splice(0).forEach((value) => this.update(kDataIn, value));
  }

  come(bytes) {
    for (const byte of bytes) this.coming.push(byte);
    this.giveWhatCame();
  }

  giveWhatCame() {
    if (this.asked === null || !this.coming.length) return;
    const bytes = Uint8Array.from(this.coming.splice(0, this.asked));
    this.asked = null;
    this.usb.endpointReadDone(this.cdc.outEndpoint, bytes);
  }
}
