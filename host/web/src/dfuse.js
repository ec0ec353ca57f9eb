// Flashes an STM32 in its boot loader by the browser's WebUSB: USB's DFU 1.1 with ST's commands (ST's AN3156, UM0391).
import { Differs, PATIENCE, Refused, choose } from "./usb.js";

const VENDOR = 0x0483;
const PRODUCT = 0xdf11;
const DFU = { interfaceClass: 0xfe, interfaceSubclass: 1, interfaceProtocol: 2 };
const DOWNLOAD = 1;
const UPLOAD = 2;
const STATUS = 3;
const CLEAR = 4;
const ABORT = 6;
const SET_ADDRESS = 0x21;
const ERASE = 0x41;
const FIRST_BLOCK = 2;   // of data: those before it are commands
const IDLE = 2;          // states
const DOWNLOADING = 5;
const ERROR = 10;
const USUAL_SIZE = 2048; // bytes of a transfer, where the board does not say
const FUNCTIONAL = 0x21; // descriptor
const REASONS = ["ok", "the file is for another part", "the file fails a check of the maker", "it could not write", "it could not erase", "the flash is not erased",
  "it could not program", "what was programmed is not right", "no such address, or one that is protected", "too little data", "its program is damaged",
  "it is read-protected", "unexpected USB reset", "unexpected power on", "unknown error", "unexpected request"];
const UNKNOWN = 14;
const UNITS = { " ": 1, B: 1, K: 1024, M: 1 << 20 };

/** The one element of a .dfu file: { address, bytes }. */
export function elementOf(file) {
  const view = new DataView(file.buffer, file.byteOffset, file.byteLength);
  const at = 11 + 274;  // behind the file's head and its target's
  const size = view.getUint32(at + 4, true);
  return { address: view.getUint32(at, true), bytes: file.subarray(at + 8, at + 8 + size) };
}

/** Sectors by the name of an alternate setting, "@Internal Flash  /0x08000000/04*016Kg,01*064Kg": [{ address, size }]. */
export function sectorsBy(name) {
  const [, ...parts] = name.split("/");
  const sectors = [];
  for (let i = 0; i + 1 < parts.length; i += 2) {
    let address = Number.parseInt(parts[i], 16);
    for (const [, count, size, unit] of parts[i + 1].matchAll(/(\d+)\*(\d+)([ BKM])[a-g]/g)) {
      for (let n = 0; n < Number(count); ++n) {
        sectors.push({ address, size: Number(size) * UNITS[unit] });
        address += Number(size) * UNITS[unit];
      }
    }
  }
  return sectors;
}

export class Dfuse {
  #device;
  #interface;
  #size = USUAL_SIZE;

  /** The one that the user chooses. */
  static async choose(usb) { return new Dfuse(await choose(usb, [{ vendorId: VENDOR, productId: PRODUCT }])); }
  constructor(device) { this.#device = device; }

  // Claims its flash; the sectors of it.
  async #open() {
    const device = this.#device;
    await device.open();
    if (!device.configuration) await device.selectConfiguration(1);
    const flashes = device.configuration.interfaces.flatMap(({ interfaceNumber, alternates }) => alternates
      .filter((one) => Object.entries(DFU).every(([key, value]) => one[key] === value) && one.interfaceName?.startsWith("@Internal Flash"))
      .map((alternate) => ({ interfaceNumber, alternate })));
    if (!flashes.length) throw new Refused("DFU", "it has no interface for its flash");
    const [{ interfaceNumber, alternate }] = flashes;
    this.#interface = interfaceNumber;
    await device.claimInterface(interfaceNumber);
    await device.selectAlternateInterface(interfaceNumber, alternate.alternateSetting);
    this.#size = await this.#transferSize() || USUAL_SIZE;
    const { state } = await this.#status();
    if (state === ERROR) await this.#out(CLEAR); else if (state !== IDLE) await this.#out(ABORT);
    return sectorsBy(alternate.interfaceName);
  }

  async #transferSize() {
    const all = { requestType: "standard", recipient: "device", request: 6, value: 0x200, index: 0 };
    const head = await this.#device.controlTransferIn(all, 9);
    if (head.status !== "ok") return 0;
    const { data } = await this.#device.controlTransferIn(all, head.data.getUint16(2, true));
    for (let at = 0; at + 1 < data.byteLength && data.getUint8(at); at += data.getUint8(at)) {
      if (data.getUint8(at + 1) === FUNCTIONAL) return data.getUint16(at + 5, true);
    }
    return 0;
  }

  #setup(request, value) { return { requestType: "class", recipient: "interface", request, value, index: this.#interface }; }

  async #out(request, { value = 0, bytes = new Uint8Array(0), what = "DFU" } = {}) {
    const { status } = await this.#device.controlTransferOut(this.#setup(request, value), bytes);
    if (status !== "ok") throw await this.#refusal(what);
  }

  async #status() {
    const { status, data } = await this.#device.controlTransferIn(this.#setup(STATUS, 0), 6);
    if (status !== "ok") return { code: UNKNOWN, wait: 0, state: ERROR };
    return { code: data.getUint8(0), wait: data.getUint32(0, true) >>> 8, state: data.getUint8(4) };
  }

  async #refusal(what) {
    const { code } = await this.#status();
    return new Refused(what, REASONS[code] || REASONS[UNKNOWN]);
  }

  // It begins to work when its status is asked for, and says how long that takes.
  async #download(block, bytes, what) {
    await this.#out(DOWNLOAD, { value: block, bytes, what });
    for (const end = Date.now() + PATIENCE; Date.now() < end;) {
      const { code, wait, state } = await this.#status();
      if (code) throw new Refused(what, REASONS[code] ?? REASONS[UNKNOWN]);
      if (state === DOWNLOADING) return;
      await new Promise((resolve) => setTimeout(resolve, Math.min(wait, PATIENCE)));
    }
    throw new Refused(what, "it is busy without an end");
  }

  #command(code, address, what) {
    const bytes = new Uint8Array(5);
    bytes[0] = code;
    new DataView(bytes.buffer).setUint32(1, address, true);
    return this.#download(0, bytes, what);
  }

  /** Erases the file's sectors, writes, compares and starts it. `progress(step, share)`; how many bytes. */
  async flash(file, progress) {
    const { address, bytes } = elementOf(file);
    try {
      const sectors = (await this.#open()).filter((one) => one.address < address + bytes.length && one.address + one.size > address);
      const room = sectors.reduce((sum, { size }) => sum + size, 0);
      if (!sectors.length || sectors[0].address > address || sectors[0].address + room < address + bytes.length) throw new Refused("erase", "the file does not fit into its flash");
      for (const one of sectors) {
        progress("usbErasing", 0);
        await this.#command(ERASE, one.address, "erase");
      }
      for (let at = 0; at < bytes.length; at += this.#size) {
        // Some boot loaders count a short block wrong: each has its address.
        await this.#command(SET_ADDRESS, address + at, "address");
        await this.#download(FIRST_BLOCK, bytes.subarray(at, at + this.#size), "write");
        progress("usbWriting", Math.min(1, (at + this.#size) / bytes.length));
      }
      await this.#command(SET_ADDRESS, address, "address");
      await this.#out(ABORT);
      for (let at = 0, block = FIRST_BLOCK; at < bytes.length; at += this.#size, ++block) {
        const { status, data } = await this.#device.controlTransferIn(this.#setup(UPLOAD, block), this.#size);
        if (status !== "ok") throw await this.#refusal("read");
        const wanted = bytes.subarray(at, at + this.#size);
        const wrong = wanted.findIndex((byte, k) => k >= data.byteLength || byte !== data.getUint8(k));
        if (wrong >= 0) throw new Differs(address + at + wrong);
        progress("usbVerifying", Math.min(1, (at + this.#size) / bytes.length));
      }
      await this.#out(ABORT);
      await this.#command(SET_ADDRESS, address, "address");
      await this.#out(DOWNLOAD);
      await this.#status().catch(() => { /* it has started, and is gone */ });
    } finally {
      await this.#device.close().catch(() => { /* it is gone */ });
    }
    return bytes.length;
  }
}
