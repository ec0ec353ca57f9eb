// Replays a log once in short turns, keeping copies of memory on the way; then goes to any time in it.

const TURN = 10;          // ms of work before the page gets its turn
const CHUNK = 4096;       // bytes between two looks at the clock
const CHECKPOINTS = 48;   // at most
const SPACING = 20e3;     // minimum bytes of log between two of them
const pause = () => new Promise((resolve) => setTimeout(resolve));

/** The page's data at one time; alerts up to then, or none. */
function look(engine, withAlerts) {
  return { result: engine.result(withAlerts), page: engine.page(), path: engine.path(), time: engine.time };
}

export class Player {
  #engine;
  #log = new Uint8Array();
  #offset = 0;
  #checkpoints = [];
  #job = 0;

  constructor(engine) { this.#engine = engine; }

  get duration() { return this.end - this.begin; }

  /** Replays all of `log`. `progress(share, () => look)` now and then. Returns the last look, or null if another job
   * began meanwhile. */
  async load(log, profile, progress = () => {}) {
    const job = ++this.#job;
    const engine = this.#engine;
    this.#log = log;
    this.#checkpoints = [];
    const started = performance.now();
    let busy = 0;
    engine.open(profile);
    let run = 0;
    let kept = 0;
    let offset = 0;
    const spacing = Math.max(SPACING, log.length / CHECKPOINTS);
    let turn = performance.now();
    while (offset < log.length && !engine.ended) {
      offset += engine.feed(log.subarray(0, Math.min(offset + CHUNK, log.length)), offset);
      if (engine.runs !== run) {
        run = engine.runs;
        this.#checkpoints = [];
      }
      if (run > 0 && (this.#checkpoints.length === 0 || offset - kept >= spacing)) {
        this.#checkpoints.push({ ...engine.snapshot(this.#checkpoints.at(-1)), offset });
        kept = offset;
      }
      if (performance.now() - turn > TURN) {
        busy += performance.now() - turn;
        progress(offset / log.length, () => look(engine, false));
        await pause();
        if (job !== this.#job) return null;
        turn = performance.now();
      }
    }
    engine.finish();
    busy += performance.now() - turn;
    this.#offset = log.length;
    this.#checkpoints.push({ ...engine.snapshot(this.#checkpoints.at(-1)), offset: log.length, last: true });
    this.last = look(engine, true);
    this.begin = this.last.path.length ? this.last.path[0] : 0;
    this.end = engine.time;
    this.took = { busy, whole: performance.now() - started };
    return this.last;
  }

  /** Ends what is under way. */
  stop() { ++this.#job; }

  /** Goes to the first input at or after `t`. Null if another job began meanwhile. */
  async seek(t) {
    const job = ++this.#job;
    const engine = this.#engine;
    if (t >= this.end) {
      this.#restore(this.#checkpoints.at(-1));
      return this.last;
    }
    const from = this.#checkpoints.findLast((c) => c.time <= t && !c.last) ?? this.#checkpoints[0];
    if (!from) return this.last;
    const here = this.#offset < this.#log.length && engine.time <= t && engine.time >= from.time;
    if (!here) this.#restore(from);
    let turn = performance.now();
    while (engine.time < t && this.#offset < this.#log.length) {
      this.#offset += engine.feed(this.#log.subarray(0, Math.min(this.#offset + CHUNK, this.#log.length)), this.#offset, t);
      if (performance.now() - turn > TURN) {
        await pause();
        if (job !== this.#job) return null;
        turn = performance.now();
      }
    }
    return look(engine, false);
  }

  /** The result document of all the log, as the command line writes it. */
  async resultText() {
    await this.seek(Infinity);
    return this.#engine.resultText();
  }

  /** How good the map at the end is by a scene's text: { recklessness, paranoia }, null where the scene has a fault. */
  async score(scene) {
    await this.seek(Infinity);
    try {
      return this.#engine.scoreBy(scene);
    } catch {
      this.#restore(this.#checkpoints.at(-1));
      return null;
    }
  }

  #restore(checkpoint) {
    this.#engine.restore(checkpoint);
    this.#offset = checkpoint.offset;
  }
}

/** A stream that is still coming. */
export class Live {
  #engine;
  #waiting = [];
  #busy = false;
  #stopped = false;

  constructor(engine) {
    this.#engine = engine;
    engine.open(0);
  }

  push(bytes) { this.#waiting.push(bytes); }
  stop() { this.#stopped = true; }
  look() { return look(this.#engine, true); }

  /** Uses what has come, in short turns; true if there was any. */
  async work() {
    if (this.#busy || this.#waiting.length === 0 || this.#stopped) return false;
    this.#busy = true;
    let turn = performance.now();
    while (this.#waiting.length && !this.#stopped) {
      const bytes = this.#waiting.shift();
      for (let offset = 0; offset < bytes.length;) {
        offset += this.#engine.feed(bytes.subarray(0, Math.min(offset + CHUNK, bytes.length)), offset);
        if (performance.now() - turn < TURN) continue;
        await pause();
        turn = performance.now();
      }
    }
    this.#busy = false;
    return true;
  }
}
