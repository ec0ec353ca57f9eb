// Names beside what they name: none over another, none beyond the edge, and a line to it where it had to go further away.
import { label } from "./canvas.js";

const LINE = 16;   // px
const FAR = 10;    // px from what it names: from here on a line leads there
const NEAR = 60;   // px: so far it keeps clear of other things' marks
const REACH = 220; // px, the furthest away

const over = (a, b) => a[0] < b[2] && a[2] > b[0] && a[1] < b[3] && a[3] > b[1];

const letters = (text) => typeof Intl.Segmenter === "function" ? [...new Intl.Segmenter().segment(text)].map((s) => s.segment) : [...text];

function cut(text, fits, behind = "") {
  const all = letters(text);
  for (let left = all.length - 1; left > 1; --left) {
    const head = Math.ceil(left / 2);
    const short = `${all.slice(0, head).join("")}…${all.slice(all.length - (left - head)).join("")}${behind}`;
    if (fits(short)) return short;
  }
  return `…${behind}`;
}

/** The texts as far as they fit; what is too long is cut in its middle, and never so that two different ones read alike. */
export function fitted(texts, fits) {
  const whole = new Map(texts.filter(fits).map((text) => [text, text]));
  return texts.map((text) => {
    if (fits(text)) return text;
    let short = cut(text, fits);
    for (let i = 2; (whole.get(short) ?? text) !== text; ++i) short = cut(text, fits, ` (${i})`);
    whole.set(short, text);
    return short;
  });
}

const nearest = ([u1, v1, u2, v2], [u, v]) => [Math.min(u2, Math.max(u1, u)), Math.min(v2, Math.max(v1, v))];

// Left end and middle of a text of width w, the nearest first.
function* placesAround([u1, v1, u2, v2], [u, v], w, reach) {
  const h = LINE / 2 + 3;
  yield* [[u2 + 5, v], [u1 - w - 3, v], [u - w / 2, v1 - h], [u - w / 2, v2 + h], [u2 + 3, v1 - h], [u2 + 3, v2 + h], [u1 - w, v1 - h], [u1 - w, v2 + h]];
  for (let away = 14; away < reach; away += 12) {
    for (let i = 0; i < 16; ++i) {
      const [c, s] = [Math.cos(i * Math.PI / 8), Math.sin(i * Math.PI / 8)];
      yield [u + c * ((u2 - u1) / 2 + away) - w * (1 - c) / 2, v + s * ((v2 - v1) / 2 + away)];
    }
  }
}

const boxAt = ([x, y], w) => [x, y - LINE / 2, x + w, y + LINE / 2];

/** Where the texts of one drawing are. `memory` keeps each where it was while it can stay. */
export class Labels {
  #taken = [];
  #marks = [];
  #memory;
  placed = [];

  constructor(g, width, height, memory = new Map()) {
    Object.assign(this, { g, width, height });
    this.#memory = memory;
  }

  /** Keeps labels out of the box. */
  block(box) { this.#taken.push(box); }
  /** Labels avoid it if they can. */
  mark(box) { this.#marks.push(box); }

  #free(box, marks) {
    return box[0] >= 0 && box[1] >= 0 && box[2] <= this.width && box[3] <= this.height && !this.#taken.some((b) => over(box, b)) &&
      !(marks && this.#marks.some((b) => over(box, b)));
  }

  #find(item, w, marks) {
    const places = [...item.first ?? [], ...placesAround(item.box, item.at, w, marks ? NEAR : REACH)];
    const free = (place) => place && this.#free(boxAt(place, w), marks);
    const last = this.#memory.get(item.key);
    const index = free(places[last]) ? last : places.findIndex(free);
    if (index >= 0) this.#memory.set(item.key, index);
    return places[index];
  }

  /** One more. `texts`: the longest first, the others for where that has no place. `box`, `at`: what it names, and its
   * middle; `first`: places to try before others. `key`: the same from one drawing to the next. `font`, `ink`, and
   * `colour` of the line. */
  add(item) {
    this.g.font = item.font;
    for (const text of item.texts) {
      const w = this.g.measureText(text).width + 4;
      for (const marks of [true, false]) {
        const place = this.#find(item, w, marks);
        if (!place) continue;
        const box = boxAt(place, w);
        this.#taken.push(box);
        this.placed.push({ ...item, text, place, box, around: item.box });
        return;
      }
    }
  }

  draw(rim) {
    const { g } = this;
    g.textAlign = "left";
    g.textBaseline = "middle";
    for (const { box, around, at, colour } of this.placed) {
      const end = nearest(box, at);
      const from = nearest(around, end);
      if (Math.hypot(end[0] - from[0], end[1] - from[1]) < FAR) continue;
      g.strokeStyle = colour;
      g.lineWidth = 1;
      g.beginPath();
      g.moveTo(...from);
      g.lineTo(...end);
      g.stroke();
    }
    for (const { text, place, font, ink } of this.placed) {
      g.font = font;
      label(g, text, place[0] + 2, place[1], ink, rim);
    }
  }
}
