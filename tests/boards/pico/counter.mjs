// Instructions between a function's entry and its return, and how deep the stack went: what tests/boards/count_plugin.cpp
// does for QEMU, with the same arguments.
import { writeFileSync } from 'node:fs';

const kRam = 0x20000000;
const kRamSize = 264 * 1024;

export class Counter {
  /** `text`: PLUGIN,out=FILE,low=HEX,high=HEX,stage=NAME;ENTRY;BEHIND A CALL;...,stage=... */
  constructor(text) {
    this.marks = new Uint8Array(kRamSize / 2); // of instructions at which something begins or ends
    this.entries = new Map();
    this.returns = new Map();
    this.stages = [];
    for (const part of text.split(',').slice(1)) {
      const [key, value] = [part.slice(0, part.indexOf('=')), part.slice(part.indexOf('=') + 1)];
      if (key === 'out') this.out = value;
      if (key === 'low') this.low = parseInt(value, 16);
      if (key === 'high') this.high = parseInt(value, 16);
      if (key === 'stage') this.addStage(value.split(';'));
    }
    this.deepest = this.high;
    this.instructions = 0;
  }

  addStage([name, entry, ...behind]) {
    const stage = { name, inside: false, since: 0, calls: 0, sum: 0, worst: 0 };
    this.stages.push(stage);
    this.mark(this.entries, entry, stage);
    behind.forEach((address) => this.mark(this.returns, address, stage));
  }

  mark(table, hex, stage) {
    const address = parseInt(hex, 16);
    this.marks[(address - kRam) >>> 1] = 1;
    table.set(address, [...(table.get(address) ?? []), stage]);
  }

  /** Before each instruction. */
  see(core) {
    const pc = core.registers[15];
    if (this.marks[(pc - kRam) >>> 1]) this.act(pc);
    const sp = core.registers[13];
    if (sp < this.deepest && sp >= this.low) this.deepest = sp;
    this.instructions++;
  }

  act(pc) {
    for (const stage of this.returns.get(pc) ?? []) {
      if (!stage.inside) continue;
      const took = this.instructions - stage.since;
      stage.inside = false;
      stage.calls++;
      stage.sum += took;
      stage.worst = Math.max(stage.worst, took);
    }
    for (const stage of this.entries.get(pc) ?? []) {
      stage.inside = true;
      stage.since = this.instructions;
    }
  }

  write() {
    const lines = [`all 1 ${this.instructions} 0`, `stack 1 ${this.high - this.deepest} 0`];
    for (const stage of this.stages) lines.push(`${stage.name} ${stage.calls} ${stage.sum} ${stage.worst}`);
    writeFileSync(this.out, lines.join('\n') + '\n');
  }
}
