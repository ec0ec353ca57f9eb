// usage: node emulate.mjs IMAGE.uf2 CONSOLE CAMERA USB CONTROL [COUNTS]
//
// A Raspberry Pi Pico in rp2040js. The four are Unix sockets that somebody listens at. The part's time passes only as
// CONTROL says. It has a command a line.
//
//   Time: `run MICROSECONDS`, answered by `at MICROSECONDS` when all that was said until then has been sent.
//   The part's revision from the next reset on: `revision NUMBER`, 1 for B0 and B1, 2 for B2.
//   Resets: `power`, `run-pin`. A debugger resets the core alone, or holds it: `probe`, `halt`.
//   Failures: `fault`, `hang` (lost in a loop).
//   The cable: `usb plug|unplug|open|close|block|unblock|late|give-up|clear-in|clear-out`.
//   The push button: `button down|up`.
//   The device on the two-wire bus: `camera gone|back`.
//   Wheels with encoders, counts and time between two: `turn LEFT RIGHT MICROSECONDS`.
//   Questions, answered by a line of JSON: `counts`; `stop` and `pin NUMBER`, the changes of an output as pairs of
//   microseconds and level.
// COUNTS: what to count (counter.mjs); written at SIGTERM.
import { readFileSync } from 'node:fs';
import { connect } from 'node:net';
import { Counter } from './counter.mjs';
import { kTraced, Pico } from './pico.mjs';
import { loadUf2 } from './uf2.mjs';

const [image, ...paths] = process.argv.slice(2);
const counter = paths.length === 5 ? new Counter(paths.pop()) : null;
if (paths.length !== 4) {
  console.error('usage: node emulate.mjs IMAGE.uf2 CONSOLE CAMERA USB CONTROL [COUNTS]');
  process.exit(2);
}

const [consoleSocket, cameraSocket, usbSocket, control] = await Promise.all(
  paths.map((path) => new Promise((resolve, reject) => {
    const socket = connect(path, () => resolve(socket));
    socket.on('error', reject);
    socket.on('close', () => process.exit(0));
  })),
);

// Bytes for a socket, gathered until the end of a run.
function outlet(socket) {
  const bytes = [];
  const take = (byte) => bytes.push(byte);
  take.flush = () => {
    if (bytes.length) socket.write(Buffer.from(bytes.splice(0)));
  };
  return take;
}
const out = { console: outlet(consoleSocket), camera: outlet(cameraSocket), usb: outlet(usbSocket) };
const board = image.includes('xrp') ? 'xrp' : 'pico';
// An XRP's console is on USB alone: its port is plugged in at each start.
const said = board === 'xrp' ? 'usb' : 'console';
const heard = board === 'xrp' ? out.console : out.usb;
const pico = new Pico({ ...out, usb: (bytes) => bytes.forEach(heard) }, counter, undefined, board);
loadUf2(readFileSync(image), pico.flash);
pico.start('power');

consoleSocket.on('data', (bytes) => pico[said].come(bytes));
usbSocket.on('data', (bytes) => pico.usb.come(bytes));
cameraSocket.on('data', (bytes) => (pico.asked ?? (pico.camera.uart.enabled ? pico.camera : pico.bus)).come(bytes));

const commands = {
  run: (microseconds) => {
    pico.run(Number(microseconds) * 1000);
    Object.values(out).forEach((one) => one.flush());
    control.write(`at ${Math.round(pico.nanos / 1000)}\n`);
  },
  power: () => pico.start('power'),
  'run-pin': () => pico.start('run'),
  probe: () => pico.resetCore(),
  halt: () => pico.holdCore(),
  fault: () => pico.rom.fault(),
  hang: () => pico.rom.hang(),
  usb: (what) => ({
    plug: () => pico.usb.plug(),
    unplug: () => pico.usb.unplug(),
    open: () => pico.usb.open(true),
    close: () => pico.usb.open(false),
    block: () => pico.usb.block(true),
    unblock: () => pico.usb.block(false),
    late: () => pico.usb.late(),
    'give-up': () => pico.usb.giveUp(),
    'clear-in': () => pico.usb.clear('in'),
    'clear-out': () => pico.usb.clear('out'),
  })[what](),
  revision: (number) => (pico.revision = Number(number)),
  button: (what) => pico.press(what === 'down'),
  camera: (what) => (pico.bus.there = what === 'back'),
  turn: (left, right, microseconds) => turn([Number(left), Number(right)], Number(microseconds)),
  stop: () => commands.pin(kTraced[board][0]),
  pin: (number) => control.write(JSON.stringify(pico.traces.get(Number(number))) + '\n'),
  counts: () => control.write(JSON.stringify({
    instructions: pico.instructions, erased: pico.rom.erased, programmed: pico.rom.programmed,
    lost: [pico.console.lost, pico.camera.lost],
  }) + '\n'),
};

const kWheels = board === 'xrp' ? [[4, 5], [13, 12]] : [[10, 11], [12, 13]]; // pins of channels A and B
const kLevels = [[0, 0], [1, 0], [1, 1], [0, 1]]; // a quarter of a period each; A leads forwards
const quarters = [0, 0];
function turn(counts, microseconds) {
  while (counts.some((count) => count !== 0)) {
    counts.forEach((count, wheel) => {
      counts[wheel] -= Math.sign(count);
      quarters[wheel] += Math.sign(count);
      kLevels[quarters[wheel] & 3].forEach((level, channel) => {
        const pin = pico.mcu.gpio[kWheels[wheel][channel]];
        if (pin.rawInputValue !== !!level) pin.setInputValue(!!level);
      });
    });
    pico.run(microseconds * 1000);
  }
}

function obey(line) {
  const [word, ...rest] = line.split(' ');
  if (!(word in commands)) throw Error(`no command: ${line}`);
  commands[word](...rest);
}

process.on('SIGTERM', () => {
  counter?.write();
  process.exit(0);
});

// After what came over the other sockets at the same time: it was sent before.
let text = '';
control.on('data', (bytes) => {
  text += bytes;
  setImmediate(() => {
    for (let end = text.indexOf('\n'); end >= 0; end = text.indexOf('\n')) {
      const line = text.slice(0, end);
      text = text.slice(end + 1);
      obey(line);
    }
  });
});
