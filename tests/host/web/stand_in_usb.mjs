// Runs in the page: a navigator.usb with an RP2040 that waits with BOOTSEL, after the RP2040's datasheet, 2.8.5 (PICOBOOT).
// `rp2350`: its successor instead (RP2350 datasheet, 5.6). Further devices: window.usbDevices.
// window.usbFault: "none" (nothing is chosen), "old" (a bit of the flash stays), "bits" (a bit is read wrong).
// Or, while it is written: "gone" (unplugged), "mute" (it answers nothing).
export function standInUsb({ rp2350 = false } = {}) {
  const FLASH = 0x10000000;
  const SIZE = 2 << 20;
  const chip = { flash: new Uint8Array(SIZE).fill(0x5a), exclusive: false, mapped: true, started: null, erased: 0, commands: [] };
  window.chip = chip;
  window.usbFault = null;
  window.usbDevices = [];
  let phase = null;    // the next transfer: { to } | { from } | { answer } | { answered }
  let status = [0, 0]; // token, code
  let halted = false;
  const ok = { status: "ok" };
  const stall = (code) => {
    status[1] = code;
    halted = true;
    phase = null;
    return { status: "stall" };
  };
  const within = (address, size, unit) => {
    if (address % unit || size % unit) return 5;
    return address >= FLASH && address + size <= FLASH + SIZE ? 0 : 4;
  };
  const COMMANDS = {
    0x01: { size: 1, run: ([what]) => { chip.exclusive = (what & 0xff) > 0; return 0; } },
    ...rp2350 ? { 0x0a: { size: 16, run: (words) => { chip.started = words; return 0; } } } : { 0x02: { size: 12, run: (words) => { chip.started = words; return 0; } } },
    0x03: { size: 8, run: ([address, size]) => {
      const wrong = within(address, size, 4096) || (chip.mapped ? 8 : 0);
      if (!wrong) chip.flash.fill(0xff, address - FLASH, address - FLASH + size);
      chip.erased += size;
      return wrong;
    } },
    0x05: { size: 8, to: true, run: ([address, size]) => within(address, size, 256) || (chip.mapped ? 8 : 0) },
    0x84: { size: 8, from: true, run: ([address, size]) => within(address, size, 1) || (chip.mapped ? 8 : 0) },
    0x06: { size: 0, run: () => { chip.mapped = false; return 0; } },
  };
  const take = (bytes) => {
    const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    if (bytes.length !== 32 || view.getUint32(0, true) !== 0x431fd10b) return stall(1);
    const [token, id, size, length] = [view.getUint32(4, true), view.getUint8(8), view.getUint8(9), view.getUint32(12, true)];
    status = [token, 0];
    const command = COMMANDS[id];
    chip.commands.push(id);
    if (!command) return stall(1);
    if (size !== command.size) return stall(2);
    const words = [0, 1, 2, 3].slice(0, Math.max(3, size / 4)).map((i) => view.getUint32(16 + 4 * i, true));
    if ((command.to || command.from) ? length !== words[1] : length !== 0) return stall(3);
    const wrong = command.run(words);
    if (wrong) return stall(wrong);
    const at = words[0] - FLASH;
    if (command.from) {
      const found = chip.flash.slice(at, at + length);
      if (window.usbFault === "bits" && at === 4096) found[7] ^= 1;
      phase = { from: found };
    } else {
      phase = command.to ? { to: length, at } : { answer: true };
    }
    return ok;
  };
  const device = {
    vendorId: 0x2e8a, productId: rp2350 ? 0x000f : 0x0003, configuration: null,
    async open() {},
    async close() { chip.closed = true; },
    async selectConfiguration() {
      const endpoint = (direction, endpointNumber) => ({ direction, endpointNumber, type: "bulk" });
      device.configuration = { interfaces: [
        { interfaceNumber: 0, alternate: { interfaceClass: 8, endpoints: [endpoint("in", 1), endpoint("out", 2)] } },
        { interfaceNumber: 1, alternate: { interfaceClass: 0xff, endpoints: [endpoint("out", 3), endpoint("in", 4)] } }] };
    },
    async claimInterface(number) { if (number !== 1) throw new DOMException("in use by the system", "NetworkError"); },
    async controlTransferOut({ request, index }) {
      if (request !== 0x41 || index !== 1) return { status: "stall" };
      chip.exclusive = halted = false;
      phase = null;
      return ok;
    },
    async controlTransferIn({ request }, length) {
      if (request !== 0x42 || halted) return { status: "stall" };
      const view = new DataView(new ArrayBuffer(length));
      status.forEach((word, i) => view.setUint32(4 * i, word, true));
      return { status: "ok", data: view };
    },
    async clearHalt() { halted = false; },
    async transferOut(endpoint, buffer) {
      const bytes = ArrayBuffer.isView(buffer) ? new Uint8Array(buffer.buffer, buffer.byteOffset, buffer.byteLength) : new Uint8Array(buffer);
      if (endpoint !== 3 || halted) return { status: "stall" };
      if (window.usbFault === "mute" && chip.commands.length > 5) return new Promise(() => {});
      if (window.usbFault === "gone" && chip.commands.length > 20) throw new DOMException("The device was disconnected.", "NetworkError");
      if (phase?.answered && bytes.length === 0) { phase = null; return ok; }
      if (phase?.to !== undefined) {
        if (bytes.length !== phase.to) return stall(3);
        // Flash only loses bits until it is erased.
        bytes.forEach((byte, i) => { chip.flash[phase.at + i] &= window.usbFault === "old" && phase.at === 0 && i === 9 ? byte & 0xfe : byte; });
        phase = { answer: true };
        return ok;
      }
      return phase ? stall(6) : take(bytes);
    },
    async transferIn(endpoint, length) {
      if (endpoint !== 4 || halted || !phase) return { status: "stall" };
      if (phase.answer) {
        phase = null;
        return { status: "ok", data: new DataView(new ArrayBuffer(0)) };
      }
      const part = phase.from.slice(0, Math.min(length, 1024));
      phase = phase.from.length > part.length ? { from: phase.from.slice(part.length) } : { answered: true };
      return { status: "ok", data: new DataView(part.buffer) };
    },
  };
  const usb = { async requestDevice({ filters }) {
    const fitting = window.usbDevices.find((one) => filters.some(({ vendorId, productId }) => vendorId === one.vendorId && productId === one.productId));
    if (!fitting || window.usbFault === "none") throw new DOMException("No device selected.", "NotFoundError");
    return fitting;
  } };
  window.usbDevices.push(device);
  Object.defineProperty(navigator, "usb", { value: usb, configurable: true });
}
