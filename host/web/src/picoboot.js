// Flashes an RP2040 or RP2350 that waits with BOOTSEL, by the browser's WebUSB: PICOBOOT of its boot ROM (RP2040 datasheet, 2.8.5; RP2350
// datasheet, 5.6).
import { Differs, Refused, choose } from "./usb.js";

const VENDOR = 0x2e8a;
export const RP2040 = 0x0003;  // products
export const RP2350 = 0x000f;
const MAGIC = 0x431fd10b;
export const SECTOR = 4096;
const RESTART = 500;  // ms until it starts, so that the answer still gets here
const COMMANDS = { exclusive: 0x01, reboot: 0x02, erase: 0x03, read: 0x84, write: 0x05, leave: 0x06, restart: 0x0a };
const INTERFACE_RESET = 0x41;
const COMMAND_STATUS = 0x42;
const REASONS = ["ok", "unknown command", "invalid length of the command", "invalid length of the transfer", "invalid address", "bad alignment",
  "interleaved write", "rebooting", "unknown error", "invalid state", "not permitted", "invalid argument", "buffer too small", "precondition not met",
  "modified data", "invalid data", "not found", "unsupported modification"];
const UNKNOWN = 8;

/** The sectors of a UF2 file: [{ address, bytes }]. Unknown bytes are erased ones. */
export function sectorsOf(uf2) {
  const view = new DataView(uf2.buffer, uf2.byteOffset, uf2.byteLength);
  const sectors = new Map();
  for (let at = 0; at + 512 <= uf2.length; at += 512) {
    const address = view.getUint32(at + 12, true);
    const start = address - address % SECTOR;
    if (!sectors.has(start)) sectors.set(start, new Uint8Array(SECTOR).fill(0xff));
    sectors.get(start).set(uf2.subarray(at + 32, at + 32 + view.getUint32(at + 16, true)), address - start);
  }
  return [...sectors].map(([address, bytes]) => ({ address, bytes })).sort((a, b) => a.address - b.address);
}

export class Picoboot {
  #device;
  #interface;
  #in;
  #out;
  #token = 0;

  /** The one that the user chooses. */
  static async choose(usb, product) { return new Picoboot(await choose(usb, [{ vendorId: VENDOR, productId: product }])); }
  constructor(device) { this.#device = device; }

  async #open() {
    const device = this.#device;
    await device.open();
    if (!device.configuration) await device.selectConfiguration(1);
    const own = device.configuration.interfaces.find(({ alternate }) => alternate.interfaceClass === 0xff);
    if (!own) throw new Refused("PICOBOOT", "it has no such interface");
    this.#interface = own.interfaceNumber;
    const endpoint = (direction) => own.alternate.endpoints.find((one) => one.direction === direction).endpointNumber;
    [this.#in, this.#out] = [endpoint("in"), endpoint("out")];
    await device.claimInterface(this.#interface);
    await device.controlTransferOut({ requestType: "vendor", recipient: "interface", request: INTERFACE_RESET, value: 0, index: this.#interface });
  }

  async #refusal(name) {
    for (const [direction, endpoint] of [["in", this.#in], ["out", this.#out]]) await this.#device.clearHalt(direction, endpoint);
    const { data } = await this.#device.controlTransferIn({ requestType: "vendor", recipient: "interface", request: COMMAND_STATUS, value: 0, index: this.#interface }, 16);
    return new Refused(name, REASONS[data.getUint32(4, true)] ?? REASONS[UNKNOWN]);
  }

  /** `words`: its arguments; `bytes` go to the board, or as many come back as `wanted`. The answer to either is an empty packet. */
  async #command(name, { words = [], size = 4 * words.length, bytes = null, wanted = 0 } = {}) {
    const head = new DataView(new ArrayBuffer(32));
    head.setUint32(0, MAGIC, true);
    head.setUint32(4, ++this.#token, true);
    head.setUint8(8, COMMANDS[name]);
    head.setUint8(9, size);
    head.setUint32(12, bytes?.length ?? wanted, true);
    words.forEach((word, i) => head.setUint32(16 + 4 * i, word, true));
    const expectOk = async ({ status }) => { if (status !== "ok") throw await this.#refusal(name); };
    await expectOk(await this.#device.transferOut(this.#out, head.buffer));
    if (!wanted) {
      if (bytes) await expectOk(await this.#device.transferOut(this.#out, bytes));
      await expectOk(await this.#device.transferIn(this.#in, 1));
      return null;
    }
    const got = new Uint8Array(wanted);
    for (let at = 0; at < wanted;) {
      const part = await this.#device.transferIn(this.#in, wanted - at);
      await expectOk(part);
      if (part.data.byteLength === 0) throw await this.#refusal(name);
      got.set(new Uint8Array(part.data.buffer, part.data.byteOffset, part.data.byteLength), at);
      at += part.data.byteLength;
    }
    await expectOk(await this.#device.transferOut(this.#out, new Uint8Array(0)));
    return got;
  }

  /** Erases, writes and compares sector by sector, then starts it. `progress(step, share)`; how many bytes. */
  async flash(uf2, progress) {
    const sectors = sectorsOf(uf2);
    try {
      await this.#open();
      await this.#command("exclusive", { words: [1], size: 1 });
      await this.#command("leave");
      progress("usbErasing", 0);
      for (const [i, { address, bytes }] of sectors.entries()) {
        await this.#command("erase", { words: [address, SECTOR] });
        await this.#command("write", { words: [address, SECTOR], bytes });
        progress("usbWriting", (i + 1) / sectors.length);
      }
      for (const [i, { address, bytes }] of sectors.entries()) {
        const found = await this.#command("read", { words: [address, SECTOR], wanted: SECTOR });
        const wrong = found.findIndex((byte, k) => byte !== bytes[k]);
        if (wrong >= 0) throw new Differs(address + wrong);
        progress("usbVerifying", (i + 1) / sectors.length);
      }
      // An RP2350 has a command of its own: an ordinary start, then the wait, then two words that it does not use.
      if (this.#device.productId === RP2350) await this.#command("restart", { words: [0, RESTART, 0, 0] });
      else await this.#command("reboot", { words: [0, 0, RESTART] });
    } finally {
      await this.#device.close().catch(() => { /* it is gone */ });
    }
    return sectors.length * SECTOR;
  }
}
