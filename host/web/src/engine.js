// The loop as WebAssembly: one log, drive or camera at a time, and copies of its memory to come back to.

const BLOCK = 1024;  // words of memory that are compared and kept together
const RESULT = 0;
const STATE = 1;
const STATE_WITH_ALERTS = 2;
const PAGE = 3;
const DRIVEN = 4;
const TRUTH = 5;
const SCORE = 6;
export const PROFILES = ["the log's", "full", "small", "micro"];

// The library asks for a system that is not there; nothing of the loop does.
function absentSystem() {
  const refuse = () => 52;
  return new Proxy({}, {
    get: (_, name) => name === "proc_exit" ? () => { throw new Error("the loop stopped by itself"); } : refuse,
  });
}

function importsOf(module) {
  const system = absentSystem();
  const imports = {};
  for (const { module: from, name } of WebAssembly.Module.imports(module)) (imports[from] ??= {})[name] = system[name];
  return imports;
}

export class Engine {
  #module;
  #code;
  #utf8 = new TextDecoder();

  static async create(bytes) {
    return new Engine(await WebAssembly.compile(bytes));
  }

  constructor(module) {
    this.#module = module;
    this.#start();
  }

  get module() { return this.#module; }

  #start() {
    this.#code = new WebAssembly.Instance(this.#module, importsOf(this.#module)).exports;
  }

  #begin() {
    this.#start();
    this.#code._initialize();
    this.inputSize = this.#code.input_size();
  }

  /** Begins a log. `profile`: an index of PROFILES. */
  open(profile = 0) {
    this.#begin();
    this.#code.open(profile);
  }

  /** Uses bytes of `log` from `offset` on, up to the first input at or after `until` (s) or a new run; how many. */
  feed(log, offset, until = Infinity) {
    const part = log.subarray(offset, offset + this.inputSize);
    new Uint8Array(this.#code.memory.buffer, this.#code.input(), part.length).set(part);
    return this.#code.feed(part.length, until);
  }

  finish() { this.#code.finish(); }
  get ended() { return Boolean(this.#code.ended()); }
  get time() { return this.#code.time(); }
  get runs() { return this.#code.runs(); }

  /** The poses so far, four numbers each: t, x, y, heading. */
  path() {
    return new Float64Array(this.#code.memory.buffer, this.#code.path(), 4 * this.#code.path_size()).slice();
  }

  #text(what) { return this.#read(this.#code.write(what)); }
  #read(size) { return this.#utf8.decode(new Uint8Array(this.#code.memory.buffer, this.#code.text(), size)); }

  /** As `fencepost replay --json` writes it. */
  resultText() { return this.#text(RESULT); }
  result(withAlerts) { return JSON.parse(this.#text(withAlerts ? STATE_WITH_ALERTS : STATE)); }
  page() { return JSON.parse(this.#text(PAGE)); }

  /** Begins a drive through `scene`, a scene file's text; throws what is wrong with it. */
  drive(scene) {
    this.#begin();
    this.#give(scene, () => this.#code.drive());
  }
  /** The world becomes `scene`. One with a fault ends the drive: try it in another engine first. */
  change(scene) { this.#give(scene, () => this.#code.change()); }
  #give(scene, use) {
    this.#put(new TextEncoder().encode(scene), "scene");
    this.#try(use);
  }
  #put(bytes, as) {
    for (let at = 0; at < bytes.length; at += this.inputSize) {
      const part = bytes.subarray(at, at + this.inputSize);
      new Uint8Array(this.#code.memory.buffer, this.#code.input(), part.length).set(part);
      this.#code[as](part.length);
    }
  }
  #try(use) {
    try {
      return use();
    } catch (error) {
      throw new Error(this.#read(this.#code.text_size()) || error.message);
    }
  }

  /** { recklessness, paranoia } of the log's map of now, by a scene file's text. Throws what is wrong with it. */
  scoreBy(scene) {
    let size = 0;
    this.#give(scene, () => { size = this.#code.score(); });
    return JSON.parse(this.#read(size));
  }

  /** The choices of a board's image: { board, version, formats, cameras, initial }. Throws what is wrong with the file. */
  board(image) {
    this.#begin();
    this.#put(image, "image");
    return JSON.parse(this.#read(this.#try(() => this.#code.board())));
  }

  /** The file that `fencepost configure` writes, and what it says. `robot`: a robot file's text, `settings`: [key, value] in order. */
  configure(image, { format, robot, settings }) {
    this.#begin();
    this.#put(image, "image");
    for (const word of [format, robot, ...settings.flat()]) {
      const bytes = new TextEncoder().encode(word);
      new Uint8Array(this.#code.memory.buffer, this.#code.input(), bytes.length).set(bytes);
      this.#code.word(bytes.length);
    }
    const said = JSON.parse(this.#read(this.#try(() => this.#code.configure())));
    const file = new Uint8Array(this.#code.memory.buffer, this.#code.image_file(), this.#code.image_file_size()).slice();
    return { file, said };
  }

  steer({ forward, turn }) { this.#code.steer(forward, turn); }
  obey(stops) { this.#code.obey(stops); }
  advance(seconds) { return Boolean(this.#code.advance(seconds)); }
  endDrive() { this.#code.end(); }
  /** Result without path, with the alerts since the last call. */
  driven() { return JSON.parse(this.#text(DRIVEN)); }
  /** { pose, speed, held, bumps } */
  truth() { return JSON.parse(this.#text(TRUTH)); }
  /** { recklessness, paranoia } */
  score() { return JSON.parse(this.#text(SCORE)); }

  /** Begins to look through a camera whose pictures have that size, px. */
  watch(width, height) {
    this.#begin();
    this.#code.watch(width, height);
  }
  /** A picture came, as ImageData has it, at `t`, s. False: the run has ended. */
  look(rgba, t) {
    new Uint8Array(this.#code.memory.buffer, this.#code.pixels(), rgba.length).set(rgba);
    return Boolean(this.#code.look(t));
  }
  /** Trains the colour at that place, px: { signature, name, rgb, patchy, elsewhere }, or { refused }. */
  train(u, v) { return JSON.parse(this.#read(this.#code.train(u, v))); }
  /** The file of the colours, for `fencepost run --colours`. */
  colours() { return this.#read(this.#code.colours()); }

  /** The log of the drive or of the camera so far. */
  log() { return new Uint8Array(this.#code.memory.buffer, this.#code.log(), this.#code.log_size()).slice(); }

  /** All memory: a copy of all that was there first, and the blocks that have changed; those as in `previous` are shared. */
  snapshot(previous) {
    const words = new Int32Array(this.#code.memory.buffer);
    const first = previous?.first ?? words.slice();
    const changed = new Map();
    for (let at = 0; previous && at < words.length; at += BLOCK) {
      const known = previous.changed.get(at);
      if (!sameWords(words, at, known ?? first, known ? 0 : at)) changed.set(at, words.slice(at, at + BLOCK));
      else if (known) changed.set(at, known);
    }
    return { first, changed, size: words.byteLength, time: this.time };
  }

  /** Another instance, for memory never shrinks. */
  restore({ first, changed, size }) {
    this.#start();
    const { memory } = this.#code;
    const missing = size - memory.buffer.byteLength;
    if (missing > 0) memory.grow(Math.ceil(missing / 65536));
    const words = new Int32Array(memory.buffer);
    words.set(first);
    for (const [at, block] of changed) words.set(block, at);
  }
}

function sameWords(words, at, others, from) {
  for (let i = 0; i < BLOCK; ++i) if (words[at + i] !== others[from + i]) return false;
  return true;
}
