// A row for each object that was alerted of: when, and how much.
import { niceStep, prepare } from "./canvas.js";
import { LEVELS } from "./colours.js";
import { plain } from "./dom.js";
import { fitted } from "./labels.js";
import { t as words } from "./words.js";

const ROW = 17;
const AXIS = 20;
const INSET = 8;  // px: the slider's thumb has half its width there

/** Spans of one level, by object: [{id, name, spans: [{from, to, level}]}]. */
export function rowsOf(result, end) {
  const rows = new Map();
  for (const alert of result.alerts) {
    const row = rows.get(alert.id) ?? { id: alert.id, spans: [] };
    rows.set(alert.id, row);
    const last = row.spans.at(-1);
    if (last?.level === alert.level && last.to === null) continue;
    if (last && last.to === null) last.to = alert.t;
    if (alert.level !== "clear") row.spans.push({ from: alert.t, to: null, level: alert.level });
  }
  const name = (id) => id === 0 ? "guard" : `${id} ${plain(result.objects.find((o) => o.id === id)?.name ?? "")}`.trim();
  return [...rows.values()].sort((a, b) => a.id - b.id).map(({ id, spans }) =>
    ({ id, name: name(id), spans: spans.map((span) => ({ ...span, to: span.to ?? end })) })).filter((row) => row.spans.length);
}

const across = (width, begin, end) => (t) => INSET + (t - begin) / Math.max(1e-3, end - begin) * (width - 2 * INSET);

// Where a name hides no bar: at the left, else behind the last, else in a gap.
function clearOf(bars, w, width) {
  const free = (left) => left >= INSET && left + w <= width - INSET && !bars.some(([u1, u2]) => left < u2 + 3 && left + w > u1 - 3);
  return [INSET, bars.at(-1)[1] + 6, bars[0][0] - w - 6, ...bars.map(([, u2]) => u2 + 6)].find(free) ?? INSET;
}

export function drawTimeline(canvas, { rows, begin, end, t, ink }) {
  canvas.style.height = `${AXIS + 4 + ROW * Math.max(1, rows.length)}px`;
  const { g, width, height } = prepare(canvas);
  const x = across(width, begin, end);
  const bottom = height - AXIS;
  g.font = "12px system-ui, sans-serif";
  g.textBaseline = "middle";
  g.strokeStyle = ink.rule;
  g.lineWidth = 1;
  g.fillStyle = ink.soft;
  const step = niceStep(Math.max(1e-3, end - begin) / Math.max(2, width / 70));
  g.textAlign = "center";
  g.beginPath();
  for (let at = Math.ceil(begin / step) * step; at <= end + 1e-9; at += step) {
    g.moveTo(x(at), 0);
    g.lineTo(x(at), bottom);
    if (x(at) < width - 14) g.fillText(`${+at.toFixed(3)}${at + step > end ? " s" : ""}`, Math.max(10, x(at)), height - 8);
  }
  g.stroke();
  const names = fitted(rows.map(({ name }) => name), (text) => g.measureText(text).width < width - 2 * INSET);
  canvas.shown = names;
  rows.forEach(({ spans }, i) => {
    const base = 2 + ROW * (i + 1) - 3;
    for (const { from, to, level } of spans) {
      const tall = [0, 5, 9, 13, 13][LEVELS.indexOf(level)];
      g.fillStyle = ink[level];
      g.fillRect(x(from), base - tall, Math.max(2, x(to) - x(from)), tall);
      g.strokeStyle = ink.ink;
      g.lineWidth = 0.7;
      g.strokeRect(x(from), base - tall, Math.max(2, x(to) - x(from)), tall);
    }
    g.textAlign = "left";
    g.lineWidth = 3;
    g.lineJoin = "round";
    g.strokeStyle = ink.paper;
    const at = clearOf(spans.map(({ from, to }) => [x(from), x(to)]), g.measureText(names[i]).width, width);
    g.strokeText(names[i], at, base - 6);
    g.fillStyle = ink.ink;
    g.fillText(names[i], at, base - 6);
  });
  if (!rows.length) {
    g.textAlign = "left";
    g.fillText(words("noAlertsLine"), INSET, 10);
  }
  g.strokeStyle = ink.accent;
  g.lineWidth = 2;
  g.beginPath();
  g.moveTo(x(t), 0);
  g.lineTo(x(t), bottom);
  g.stroke();
}

/** The time at a place of the drawing. */
export const timeAt = (canvas, u, begin, end) =>
  Math.min(end, Math.max(begin, begin + (u - INSET) / (canvas.clientWidth - 2 * INSET) * (end - begin)));
