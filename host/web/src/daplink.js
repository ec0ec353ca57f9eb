// Flashes a micro:bit by the browser's WebUSB: the debug chip takes a .hex file through CMSIS-DAP as its drive does (DAPLink's vendor commands).
import { Refused, choose } from "./usb.js";

const VENDOR = 0x0d28;
const PRODUCT = 0x0204;
const COMMANDS = { reset: 0x89, open: 0x8a, close: 0x8b, write: 0x8c };
const HEX = 1;        // kind of file
const PACKET = 64;
const PORTION = 62;   // bytes of a file in a packet
const DONE = 2;       // and below it: all is well, there may be more
const SET_REPORT = { requestType: "class", recipient: "interface", request: 0x09, value: 0x200 };
const GET_REPORT = { requestType: "class", recipient: "interface", request: 0x01, value: 0x100 };

export class Daplink {
  #device;
  #interface;
  #in = null;   // endpoints of version 2; version 1 has reports
  #out = null;

  /** The one that the user chooses. */
  static async choose(usb) { return new Daplink(await choose(usb, [{ vendorId: VENDOR, productId: PRODUCT }])); }
  constructor(device) { this.#device = device; }

  async #open() {
    const device = this.#device;
    await device.open();
    if (!device.configuration) await device.selectConfiguration(1);
    const own = device.configuration.interfaces.filter(({ alternate }) => alternate.interfaceClass === 0xff);
    const [{ interfaceNumber, alternate } = {}] = own.filter((one) => one.alternate.endpoints.length > 1).concat(own);
    if (!alternate) throw new Refused("CMSIS-DAP", "it has no such interface");
    this.#interface = interfaceNumber;
    const endpoint = (direction) => alternate.endpoints.find((one) => one.direction === direction)?.endpointNumber ?? null;
    [this.#in, this.#out] = [endpoint("in"), endpoint("out")];
    await device.claimInterface(interfaceNumber);
  }

  // Its answer's first byte behind the command.
  async #command(name, ...bytes) {
    const packet = new Uint8Array(PACKET);
    packet.set([COMMANDS[name], ...bytes]);
    const index = this.#interface;
    const sent = this.#out === null ? await this.#device.controlTransferOut({ ...SET_REPORT, index }, packet) : await this.#device.transferOut(this.#out, packet);
    if (sent.status !== "ok") throw new Refused(name, sent.status);
    const { status, data } = this.#in === null ? await this.#device.controlTransferIn({ ...GET_REPORT, index }, PACKET) : await this.#device.transferIn(this.#in, PACKET);
    if (status !== "ok" || data.byteLength < 2 || data.getUint8(0) !== COMMANDS[name]) throw new Refused(name, "no answer");
    return data.getUint8(1);
  }

  async #expect(name, most, ...bytes) {
    const code = await this.#command(name, ...bytes);
    if (code > most) throw new Refused(name, `DAPLink ${code}`);
  }

  /** Hands the file over, then starts it. `progress(step, share)`; how many bytes of the file. */
  async flash(file, progress) {
    try {
      await this.#open();
      await this.#expect("open", 0, HEX);
      for (let at = 0; at < file.length; at += PORTION) {
        const portion = file.subarray(at, at + PORTION);
        await this.#expect("write", DONE, portion.length, ...portion);
        progress("usbWriting", Math.min(1, (at + PORTION) / file.length));
      }
      await this.#expect("close", 0);
      await this.#command("reset");
    } finally {
      await this.#device.close().catch(() => { /* it is gone */ });
    }
    return file.length;
  }
}
