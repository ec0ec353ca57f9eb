// Runs in the page, behind standInUsb: an STM32F405 in its boot loader, after ST's AN3156 and USB's DFU 1.1. window.usbFault: "old" (a bit is
// not programmed), "bits" (a bit is read wrong), "gone" (unplugged while it is written), "protected" (against reading).
export function standInDfu() {
  const FLASH = 0x08000000;
  const SIZES = [16, 16, 16, 16, 64, 128, 128, 128, 128, 128, 128, 128].map((k) => k * 1024);
  const TRANSFER = 2048;
  const [IDLE, SYNC, BUSY, DOWNLOADING, MANIFEST, UPLOADING, ERROR] = [2, 3, 4, 5, 7, 9, 10];
  const part = { flash: new Uint8Array(1 << 20).fill(0x5a), erased: [], started: null, closed: false, downloads: 0 };
  window.stm32 = part;
  let state = ERROR;  // as after a host that went away
  let status = 15;
  let pointer = FLASH;
  let work = null;    // begins when the status is asked for
  let alternate = null;
  const ok = { status: "ok" };
  const fail = (code) => {
    [state, status, work] = [ERROR, code, null];
    return { status: "stall" };
  };
  const within = (address) => address >= FLASH && address < FLASH + part.flash.length;
  function erase(address) {
    let begin = FLASH;
    for (const size of SIZES) {
      if (address >= begin && address < begin + size) {
        part.flash.fill(0xff, begin - FLASH, begin - FLASH + size);
        part.erased.push(begin);
        return 0;
      }
      begin += size;
    }
    return 8;
  }
  function program(address, bytes) {
    if (!within(address) || !within(address + bytes.length - 1)) return 8;
    // Flash only loses bits until it is erased.
    bytes.forEach((byte, i) => { part.flash[address - FLASH + i] &= window.usbFault === "old" && address === FLASH && i === 9 ? byte & 0xfe : byte; });
    return 0;
  }
  function command(bytes) {
    const address = new DataView(bytes.buffer, bytes.byteOffset).getUint32(1, true);
    if (bytes[0] === 0x21) return () => { pointer = address; return within(address) ? 0 : 8; };
    return bytes[0] === 0x41 ? () => erase(address) : () => 15;
  }
  function download(block, bytes) {
    if (state !== IDLE && state !== DOWNLOADING) return fail(15);
    if (window.usbFault === "protected") return fail(11);
    if (window.usbFault === "mute" && ++part.downloads > 4) return new Promise(() => {});
    if (window.usbFault === "gone" && ++part.downloads > 4) throw new DOMException("The device was disconnected.", "NetworkError");
    if (bytes.length === 0) {
      [state, work] = [MANIFEST, () => { part.started = pointer; return 0; }];
      return ok;
    }
    if (bytes.length > TRANSFER) return fail(15);
    const data = bytes.slice();
    const at = pointer + (block - 2) * TRANSFER;
    work = block === 0 ? command(data) : block === 1 ? () => 15 : () => program(at, data);
    state = SYNC;
    return ok;
  }
  function tell() {
    if (state === SYNC) {  // now it does it; the next one says how it went
      status = work();
      state = status ? ERROR : BUSY;
    } else if (state === BUSY && window.usbFault !== "stuck") {
      state = DOWNLOADING;
    } else if (state === MANIFEST) {
      work();
      state = IDLE;  // it was put into its boot loader again
    }
    return Uint8Array.of(status, state === BUSY ? 2 : 0, 0, 0, state, 0);
  }
  const CONFIGURATION = Uint8Array.of(9, 2, 27, 0, 1, 1, 0, 0xc0, 50, 9, 4, 0, 0, 0, 0xfe, 1, 2, 4, 9, 0x21, 0x0b, 0xff, 0, TRANSFER & 255, TRANSFER >> 8, 0x1a, 1);
  const setting = (alternateSetting, interfaceName) => ({ alternateSetting, interfaceName, interfaceClass: 0xfe, interfaceSubclass: 1, interfaceProtocol: 2, endpoints: [] });
  const device = {
    vendorId: 0x0483, productId: 0xdf11, configuration: null,
    async open() { part.closed = false; },
    async close() { part.closed = true; },
    async selectConfiguration() {
      const alternates = [setting(0, "@Internal Flash  /0x08000000/04*016Kg,01*064Kg,07*128Kg"), setting(1, "@Option Bytes  /0x1FFFC000/01*016 e"),
        setting(2, "@OTP Memory /0x1FFF7800/01*512 e,01*016 e"), setting(3, "@Device Feature/0xFFFF0000/01*004 e")];
      device.configuration = { interfaces: [{ interfaceNumber: 0, alternate: alternates[0], alternates }] };
    },
    async claimInterface() {},
    async selectAlternateInterface(number, one) { alternate = one; },
    async controlTransferOut({ request, value }, buffer = new Uint8Array(0)) {
      if (alternate !== 0) return { status: "stall" };
      const bytes = new Uint8Array(buffer.buffer ?? buffer, buffer.byteOffset ?? 0, buffer.byteLength);
      if (request === 1) return download(value, bytes);
      if (request === 4) { [state, status] = [IDLE, 0]; return ok; }
      if (request === 6 && state !== ERROR) { state = IDLE; return ok; }
      return fail(15);
    },
    async controlTransferIn({ requestType, request, value }, length) {
      const answer = (bytes) => ({ status: "ok", data: new DataView(bytes.slice(0, length).buffer) });
      if (requestType === "standard") return answer(CONFIGURATION);
      if (request === 3) return answer(tell());
      if (request !== 2 || (state !== IDLE && state !== UPLOADING) || value < 2) return fail(15);
      state = UPLOADING;
      const at = pointer + (value - 2) * TRANSFER;
      if (!within(at)) return fail(8);
      const found = part.flash.slice(at - FLASH, at - FLASH + length);
      if (window.usbFault === "bits" && value === 3) found[7] ^= 1;
      return answer(found);
    },
  };
  window.usbDevices.push(device);
}
