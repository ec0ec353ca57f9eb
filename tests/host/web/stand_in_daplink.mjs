// Runs in the page, behind standInUsb: a micro:bit's debug chip with DAPLink's vendor commands. `bulk`: CMSIS-DAP 2, else reports of version 1.
// window.usbFault: "sum" (a line of the file came wrong), "gone" (unplugged while it is written), "mute" (likewise, it answers nothing).
export function standInDaplink({ bulk }) {
  const chip = { flash: new Map(), started: 0, closed: false, opened: false, packets: 0 };
  window.microbit = chip;
  let line = "";
  let high = 0;   // of the address
  let ended = false;
  let answer = null;
  const SUM_WRONG = 12;
  // A line of Intel's HEX.
  function take(text) {
    const bytes = text.slice(1).match(/../g)?.map((pair) => Number.parseInt(pair, 16)) ?? [];
    if (text[0] !== ":" || bytes.reduce((sum, byte) => (sum + byte) & 255, 0) !== 0 || bytes.length !== bytes[0] + 5) return SUM_WRONG;
    const [count, a, b, kind] = bytes;
    if (kind === 4) high = bytes[4] << 8 | bytes[5];
    if (kind === 0) for (let i = 0; i < count; ++i) chip.flash.set(high * 65536 + a * 256 + b + i, bytes[4 + i]);
    if (kind === 1) ended = true;
    return 0;
  }
  function write(bytes) {
    for (const c of new TextDecoder().decode(bytes)) {
      if (c !== "\n" && c !== "\r") { line += c; continue; }
      const code = line ? take(window.usbFault === "sum" && chip.packets > 9 ? `${line.slice(0, -1)}Z` : line) : 0;
      line = "";
      if (code) return code;
    }
    return ended ? 1 : 0;
  }
  function obey(packet) {
    if (packet.length !== 64) return null;
    if (window.usbFault === "gone" && ++chip.packets > 9) throw new DOMException("The device was disconnected.", "NetworkError");
    ++chip.packets;
    const [command, first] = packet;
    const commands = {
      0x8a: () => { [chip.opened, line, ended] = [true, "", false]; chip.flash.clear(); return first === 1 ? 0 : 4; },
      0x8c: () => chip.opened ? write(packet.subarray(2, 2 + first)) : 3,
      0x8b: () => { chip.opened = false; return ended ? 0 : 5; },
      0x89: () => { chip.started += 1; return 1; },
    };
    return Uint8Array.of(command, commands[command] ? commands[command]() : 0xff);
  }
  const endpoints = bulk ? [{ direction: "out", endpointNumber: 4, type: "bulk" }, { direction: "in", endpointNumber: 5, type: "bulk" }] : [];
  const listen = (buffer) => {
    if (window.usbFault === "mute" && ++chip.packets > 9) return new Promise(() => {});
    answer = obey(new Uint8Array(buffer.buffer ?? buffer, buffer.byteOffset ?? 0, buffer.byteLength));
    return { status: answer ? "ok" : "stall" };
  };
  const speak = () => {
    if (!answer) return { status: "stall" };
    const bytes = new Uint8Array(64);
    bytes.set(answer);
    answer = null;
    return { status: "ok", data: new DataView(bytes.buffer) };
  };
  const device = {
    vendorId: 0x0d28, productId: 0x0204, configuration: null,
    async open() { chip.closed = false; },
    async close() { chip.closed = true; },
    async selectConfiguration() {
      device.configuration = { interfaces: [{ interfaceNumber: 0, alternate: { interfaceClass: 8, endpoints: [] } }, { interfaceNumber: 4, alternate: { interfaceClass: 0xff, endpoints } }] };
    },
    async claimInterface(number) { if (number !== 4) throw new DOMException("in use by the system", "NetworkError"); },
    async controlTransferOut({ requestType, request, value, index }, data) {
      return !bulk && requestType === "class" && request === 9 && value === 0x200 && index === 4 ? listen(data) : { status: "stall" };
    },
    async controlTransferIn({ requestType, request, value, index }) {
      return !bulk && requestType === "class" && request === 1 && value === 0x100 && index === 4 ? speak() : { status: "stall" };
    },
    async transferOut(endpoint, data) { return bulk && endpoint === 4 ? listen(data) : { status: "stall" }; },
    async transferIn(endpoint) { return bulk && endpoint === 5 ? speak() : { status: "stall" }; },
  };
  window.usbDevices.push(device);
}
