// usage: node serial_number_test.mjs IMAGE.uf2
//
// The serial number by which a computer knows a board again: the flash chip's id, whatever the socket and the reset.
import assert from 'node:assert';
import { readFileSync } from 'node:fs';
import { Pico } from './pico.mjs';
import { loadUf2 } from './uf2.mjs';
import { UsbPort } from './usb_port.mjs';

const kDevice = 0x100; // descriptors (USB 2.0 9.4.3)
const kString = 0x300;
const kSerialIndex = 16; // in the device's
const kStalled = -32;
const kMillisecond = 1e6;
const kPatience = 500;
const kFirst = [0xe6, 0x60, 0x58, 0x38, 0x83, 0x0a, 0xbc, 0x2f];
const kSecond = [0xe6, 0x60, 0x58, 0x38, 0x83, 0x0a, 0xbc, 0x30];

class Board {
  constructor(id) {
    const board = this;
    this.said = '';
    this.answers = [];
    const hear = { console: (byte) => (this.said += String.fromCharCode(byte)), camera: () => {} };
    this.pico = new Pico(hear, null, class extends UsbPort {
      constructor(mcu) {
        super(mcu, (_, status, bytes) => board.answers.push({ status, bytes }));
        board.port = this;
      }
    });
    this.pico.flashId = id;
    loadUf2(readFileSync(process.argv[2]), this.pico.flash);
    this.start('power');
  }

  start(how) {
    this.said = '';
    this.pico.start(how);
    this.until(() => this.said.includes('READY\r\n'), `ready after ${how}`);
    this.plug();
  }

  until(condition, what) {
    for (let n = 0; n < kPatience && !condition(); n++) this.pico.run(kMillisecond);
    assert(condition(), `not ${what}`);
  }

  plug() {
    let there = false;
    this.port.plug(() => (there = true));
    this.until(() => there, 'there');
  }

  describe(value) {
    this.port.submit({ number: 1, in: true, endpoint: 0, length: 255, setup: [0x80, 6, value & 0xff, value >> 8, 9, 4, 255, 0], data: [] });
    this.until(() => this.answers.length > 0, 'answered');
    return this.answers.shift();
  }

  serialNumber() {
    const index = this.describe(kDevice).bytes[kSerialIndex];
    if (index === 0) return null;
    const { status, bytes } = this.describe(kString | index);
    assert.deepEqual([status, bytes.length, ...bytes.slice(0, 2)], [0, 34, 34, 3]);
    return Buffer.from(bytes.slice(2)).toString('utf16le');
  }
}

const first = new Board(kFirst);
assert.equal(first.serialNumber(), 'E6605838830ABC2F');
assert.equal(new Board(kSecond).serialNumber(), 'E6605838830ABC30');

first.port.unplug();
first.pico.run(10 * kMillisecond);
first.plug();
assert.equal(first.serialNumber(), 'E6605838830ABC2F', 'in another socket');
for (const how of ['run', 'watchdog', 'power']) {
  first.start(how);
  assert.equal(first.serialNumber(), 'E6605838830ABC2F', how);
}
for (const index of [4, 0xee]) assert.equal(first.describe(kString | index).status, kStalled, `string ${index}`);

for (const id of [Array(8).fill(0), Array(8).fill(0xff), null]) {
  const board = new Board(id);
  assert.equal(board.serialNumber(), null, `a chip whose id is ${id}`);
  assert.equal(board.describe(kString | 3).status, kStalled);
}
