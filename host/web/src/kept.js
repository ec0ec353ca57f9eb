// A report's data of a log that was too long for the page: its state at some times, and at the end. It takes a Player's place.
import { poseIndex } from "./scene.js";

const until = (path, t) => path.subarray(0, path.length && path[0] <= t ? 4 * (poseIndex(path, t) + 1) : 0);

export class Kept {
  #looks;

  constructor({ path, page, result, looks, alerts, stops }) {
    const whole = Float64Array.from(path);
    // Frame, objects and counts are of that time, the rest is as at the end.
    this.#looks = looks.map(({ time, result: then, frame }) =>
      ({ time, result: { ...result, alerts: [], ...then }, page: { ...page, frame }, path: until(whole, time) }));
    this.last = { time: page.time, result, page, path: whole, counts: { alerts, stops } };
    this.begin = whole.length ? whole[0] : 0;
    this.end = page.time;
  }

  get duration() { return this.end - this.begin; }
  async load() { return this.last; }
  stop() {}
  async score() { return null; }

  /** The data kept for `t`, or for the nearest earlier time. */
  async seek(t) {
    if (t >= this.end) return this.last;
    const look = this.#looks.findLast(({ time }) => time <= t) ?? this.#looks[0] ?? this.last;
    return { ...look, path: until(this.last.path, t) };
  }
}
