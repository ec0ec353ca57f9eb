// Many logs on one map and in one table.
import { figure, prepare } from "./canvas.js";
import { colourOf } from "./colours.js";
import { byId, headed, make, plain } from "./dom.js";
import { drawGrid, trace } from "./map2d.js";
import { outlineOf } from "./scene.js";
import { rowsOf } from "./timeline.js";
import { Window, extentOf } from "./window.js";
import { t } from "./words.js";

const HUES = ["d02020", "2040c0", "20a040", "c08020", "20a0c0", "a02080", "808080"];
const DASHES = [[], [8, 4], [2, 3], [10, 3, 2, 3]];

/** The line of the log with that index: no two of the first 28 are alike. */
const lineOf = (i, theme) => ({ colour: colourOf(HUES[i % HUES.length], 0, theme), dash: DASHES[Math.floor(i / HUES.length) % DASHES.length] });

const sum = (counts) => Object.values(counts).reduce((a, b) => a + b, 0);

/** Figures of a run to compare: `nearest` m of all things that it drove past, `stops` times that a STOP began. `score`: of its map, where truth is known. */
export function figuresOf({ result, path }, score) {
  const percent = (share) => share === null || share === undefined ? null : 100 * share;
  const way = Array.from({ length: Math.max(0, path.length / 4 - 1) }, (_, i) => Math.hypot(path[4 * i + 5] - path[4 * i + 1], path[4 * i + 6] - path[4 * i + 2]));
  const spans = rowsOf(result, 0).flatMap((row) => row.spans).filter(({ level }) => level === "stop");
  return {
    length: way.reduce((a, b) => a + b, 0), nearest: result.passes?.length ? Math.min(...result.passes.map(({ distance }) => distance)) : null,
    stops: spans.length, first: spans.length ? Math.min(...spans.map(({ from }) => from)) : null,
    objects: result.objects.filter(({ state }) => state !== "tentative").length, errors: sum(result.log.rejected) + sum(result.log.refused), reckless: percent(score?.recklessness), paranoid: percent(score?.paranoia),
  };
}

const COLUMNS = [["colDriven", "length", 2], ["colNearest", "nearest", 2], ["colStops", "stops", 0], ["colFirst", "first", 2], ["colObjects", "objects", 0], ["recklessness", "reckless", 0, ", %"], ["paranoia", "paranoid", 0, ", %"], ["colErrors", "errors", 0]];

const headOf = ([words, , , unit = ""]) => `${t(words)}${unit}`;

function key(line) {
  const canvas = make("canvas", { className: "key wide", width: 56, height: 20, "aria-hidden": "true" });
  const g = canvas.getContext("2d");
  g.scale(2, 2);
  g.strokeStyle = line.colour;
  g.lineWidth = 2.5;
  g.setLineDash(line.dash);
  g.beginPath();
  g.moveTo(0, 5);
  g.lineTo(28, 5);
  g.stroke();
  return canvas;
}

const order = { column: null, up: true };

/** `runs`: [{ name, look, score, truth, open }]. */
export function compare(runs, { ink, theme }) {
  const canvas = byId("all-map");
  const { g, width, height } = prepare(canvas);
  const window = new Window();
  window.size(width, height);
  window.fit(runs.flatMap(({ look, truth }) => extentOf({ ...look, truth })), 40);
  g.fillStyle = ink.paper;
  g.fillRect(0, 0, width, height);
  drawGrid({ g, window, ink, bare: false });
  g.strokeStyle = ink.soft;
  g.lineWidth = 1;
  for (const { ring } of runs[0].truth) {
    g.beginPath();
    trace(g, window, ring);
    g.stroke();
  }
  runs.forEach(({ look }, i) => {
    const { colour, dash } = lineOf(i, theme);
    g.strokeStyle = colour;
    g.lineWidth = 2.2;
    g.setLineDash(dash);
    g.beginPath();
    for (let at = 0; at < look.path.length; at += 4) g[at ? "lineTo" : "moveTo"](...window.toPage([look.path[at + 1], look.path[at + 2]]));
    g.stroke();
    g.lineWidth = 1.2;
    for (const object of look.result.objects) {
      const ring = object.state === "tentative" ? null : outlineOf(object);
      if (!ring) continue;
      g.beginPath();
      trace(g, window, ring);
      g.stroke();
    }
    g.setLineDash([]);
  });

  const rows = runs.map((run, i) => ({ run, line: lineOf(i, theme), figures: figuresOf(run.look, run.score) }));
  const value = ({ figures }) => figures[order.column] ?? Infinity;
  if (order.column) rows.sort((a, b) => (order.up ? 1 : -1) * (value(a) - value(b)));
  const table = byId("all-table");
  table.replaceChildren(headed([t("colLog")], ...COLUMNS.map((column) => [headOf(column), "n"])), make("tbody", {}, ...rows.map(({ run, line, figures }) => make("tr", {},
    make("td", { className: "name" }, key(line), make("button", { type: "button", onclick: run.open, "aria-label": t("showLog", { name: plain(run.name) }) }, plain(run.name))),
    ...COLUMNS.map(([, name, decimals]) => make("td", { className: "n" }, figure(figures[name], decimals)))))));
  [...table.tHead.rows[0].cells].slice(1).forEach((cell, i) => {
    const [, name] = COLUMNS[i];
    cell.setAttribute("aria-sort", order.column !== name ? "none" : order.up ? "ascending" : "descending");
    cell.replaceChildren(make("button", { type: "button", onclick: () => {
      Object.assign(order, { up: order.column === name ? !order.up : true, column: name });
      compare(runs, { ink, theme });
    } }, headOf(COLUMNS[i])));
  });
}
