// usage: node usbip.mjs IMAGE.uf2 SOCKET
//
// A Raspberry Pi Pico in rp2040js as a USB device for a Linux kernel. It is the server side of USB/IP and listens on a
// Unix socket, for one client. Source: Documentation/usb/usbip_protocol.rst of the Linux kernel. Its time is that of
// the clock on the wall, or slower. Between the protocol's messages go words of ours, a header of the same size and a
// text. They are `plug`, `unplug`, `power`, `fault`, `halt in|out`; each is answered by itself when it is done. `gone`
// comes when the part was reset, `loader` when the program has started the ROM's drive.
import { readFileSync } from 'node:fs';
import { createServer } from 'node:net';
import { Pico } from './pico.mjs';
import { loadUf2 } from './uf2.mjs';
import { UsbPort } from './usb_port.mjs';

const kHeader = 48;
const kSubmit = 1;
const kTakeBack = 2;
const kSubmitted = 3;
const kTakenBack = 4;
const kWord = 0x46454e43;
const kIn = 1;
const kReset = -104; // -ECONNRESET: taken back in time
const kSlice = 1e6; // ns
const kMaxBehind = 50e6; // ns that are caught up on; what is more is lost

const [image, path] = process.argv.slice(2);
if (!path) {
  console.error('usage: node usbip.mjs IMAGE.uf2 SOCKET');
  process.exit(2);
}

let socket = null;
let port = null; // of the part as it is since its last reset
let plugged = false;

function send(words, bytes = []) {
  const header = Buffer.alloc(kHeader);
  words.forEach((word, i) => header.writeInt32BE(word | 0, 4 * i));
  socket?.write(Buffer.concat([header, Buffer.from(bytes)]));
}

const say = (text) => send([kWord, text.length], Buffer.from(text));

const pico = new Pico({ console: () => {}, camera: () => {} }, null, class extends UsbPort {
  constructor(mcu) {
    super(mcu, ({ number, in: way, length }, status, bytes) =>
      send([kSubmitted, number, 0, way ? kIn : 0, 0, status, way || status ? bytes.length : length], way ? bytes : []));
    port = this;
    if (plugged) say('gone');
    plugged = false;
  }
});
pico.onLoader = () => {
  plugged = false;
  say('loader');
};
loadUf2(readFileSync(image), pico.flash);
pico.start('power');

const words = {
  plug: (done) => {
    plugged = true;
    port.plug(done);
  },
  unplug: (done) => {
    plugged = false;
    port.unplug();
    done();
  },
  power: (done) => {
    pico.start('power');
    done();
  },
  fault: (done) => {
    pico.rom.fault();
    done();
  },
  halt: (done, way) => {
    port.halt(way);
    done();
  },
};

/** One message that begins `bytes`; how long it was, or 0 if it is not all there. */
function take(bytes) {
  if (bytes.length < kHeader) return 0;
  const word = (i) => bytes.readUInt32BE(4 * i);
  const out = (word(0) === kSubmit && word(3) !== kIn) ? word(6) : word(0) === kWord ? word(1) : 0;
  if (bytes.length < kHeader + out) return 0;
  const data = [...bytes.subarray(kHeader, kHeader + out)];
  if (word(0) === kWord) {
    const text = String.fromCharCode(...data);
    const [name, ...rest] = text.split(' ');
    if (!(name in words)) throw Error(`no word: ${text}`);
    words[name](() => say(text), ...rest);
  } else if (word(0) === kSubmit) {
    port.submit({ number: word(1), in: word(3) === kIn, endpoint: word(4), length: word(6), setup: [...bytes.subarray(40, kHeader)], data });
  } else if (word(0) === kTakeBack) {
    send([kTakenBack, word(1), 0, 0, 0, port.takeBack(word(5)) ? kReset : 0]);
  } else {
    throw Error(`not USB/IP: ${word(0)}`);
  }
  return kHeader + out;
}

let rest = Buffer.alloc(0);
createServer((client) => {
  socket = client;
  client.on('data', (bytes) => {
    rest = Buffer.concat([rest, bytes]);
    for (let size = take(rest); size > 0; size = take(rest)) rest = rest.subarray(size);
  });
  client.on('close', () => process.exit(0));
  client.on('error', () => process.exit(0));
}).listen(path, () => console.log('listening'));

// As far as the wall's clock is.
let ahead = 0;
let looked = process.hrtime.bigint();
function pass() {
  const now = process.hrtime.bigint();
  ahead -= Number(now - looked);
  looked = now;
  if (ahead < -kMaxBehind) ahead = -kMaxBehind;
  if (ahead < 0) {
    pico.run(kSlice);
    ahead += kSlice;
  }
  if (ahead < 0) setImmediate(pass);
  else setTimeout(pass, 1);
}
pass();
