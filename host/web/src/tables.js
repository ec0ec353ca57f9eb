import { figure } from "./canvas.js";
import { colourOf, drawMark, markOf } from "./colours.js";
import { headed, make, plain } from "./dom.js";

const degrees = (radians) => radians === null || radians === undefined ? "–" : (radians * 180 / Math.PI).toFixed(0).replace(/^-0$/, "0");

function key(object, theme) {
  const canvas = make("canvas", { className: "key", width: 30, height: 30, "aria-hidden": "true" });
  const g = canvas.getContext("2d");
  g.fillStyle = colourOf(object.rgb, object.signature, theme);
  drawMark(g, markOf(object.signature), 15, 15, 13);
  return canvas;
}

/** `levels`: by id the alert in force. */
export function fillObjects(table, { result, levels, theme, selected, select }) {
  const rows = result.objects.map((object) => {
    const level = levels.get(object.id)?.level ?? "clear";
    const circle = object.models.cylinder ?? {};
    const area = object.models.hybrid?.area;
    const name = object.name === null ? `signature ${object.signature}` : plain(object.name);
    return make("tr", { className: object.id === selected ? "lit" : "" },
      make("td", {}, make("button", { type: "button", onclick: () => select(object.id), "aria-label": `Show object ${object.id}`, "aria-pressed": String(object.id === selected) }, object.id)),
      make("td", { className: "name" }, key(object, theme), name),
      make("td", {}, make("span", { className: `level ${level}` }, level)),
      make("td", { className: "n" }, figure(circle.x, 3)), make("td", { className: "n" }, figure(circle.y, 3)),
      make("td", { className: "n" }, area == null ? "–" : figure(area * 1e4, 0)), make("td", { className: "n" }, figure(object.confidence, 2)),
      make("td", {}, object.state), make("td", { className: "n" }, object.views),
      make("td", { className: "n" }, figure(circle.radius, 3)), make("td", { className: "n" }, figure(object.z_max, 3)));
  });
  if (!rows.length) rows.push(make("tr", {}, make("td", { colSpan: 11 }, "No objects yet.")));
  const n = "n";
  table.replaceChildren(
    headed(["id"], ["name"], ["alert"], ["x, m", n], ["y, m", n], ["area, cm²", n], ["confidence", n], ["state"], ["views", n], ["radius, m", n], ["top, m", n]),
    make("tbody", {}, ...rows));
}

const ROWS = 300;  // of alerts at a time: a long run has thousands

/** Those around time t. Returns which: [first, end). */
export function fillAlerts(table, { result, t, go }) {
  const now = alertsUntil(result.alerts, t);
  const first = Math.max(0, Math.min(now - ROWS / 2, result.alerts.length - ROWS));
  const shown = result.alerts.slice(first, first + ROWS);
  const more = (n, when) => n > 0 ? [make("tr", {}, make("td", { colSpan: 6 }, `${n} ${when}: move the slider`))] : [];
  const nameOf = (id) => id === 0 ? "something" : `${id} ${plain(result.objects.find((o) => o.id === id)?.name ?? "")}`;
  const rows = shown.map((alert) => make("tr", {},
    make("td", {}, make("button", { type: "button", onclick: () => go(alert.t), "aria-label": `Go to ${alert.t.toFixed(2)} seconds` }, `${alert.t.toFixed(2)}`)),
    make("td", {}, make("span", { className: `level ${alert.level}` }, alert.level)), make("td", { className: "name" }, nameOf(alert.id)),
    make("td", { className: "n" }, figure(alert.distance, 2)), make("td", { className: "n" }, degrees(alert.bearing)),
    make("td", { className: "n" }, figure(alert.ttc, 1))));
  if (!rows.length) rows.push(make("tr", {}, make("td", { colSpan: 6 }, "No alerts in this run.")));
  const n = "n";
  table.replaceChildren(
    headed(["time, s"], ["level"], ["object"], ["away, m", n], ["left, °", n], ["contact, s", n]),
    make("tbody", {}, ...more(first, "earlier"), ...rows, ...more(result.alerts.length - first - shown.length, "later")));
  return [first, first + shown.length];
}

/** Of the whole run, also where its alerts were thinned. */
export const countsOf = ({ result, counts }) =>
  counts ?? { alerts: result.alerts.length, stops: result.alerts.filter((alert) => alert.level === "stop").length };

/** How many there were up to t. */
export function alertsUntil(alerts, t) {
  const next = alerts.findIndex((alert) => alert.t > t + 1e-9);
  return next < 0 ? alerts.length : next;
}

/** Which of the rows filled with [first, end) are later than `count` of them all, and which is the latest. */
export function markAlerts(table, [first, end], count) {
  const rows = [...table.tBodies[0]?.rows ?? []].slice(first > 0 ? 1 : 0).slice(0, end - first);
  rows.forEach((row, i) => { row.className = first + i >= count ? "later" : first + i === count - 1 ? "lit" : ""; });
  const box = table.parentElement;
  const row = rows[Math.max(0, count - 1 - first)];
  if (row && !box.contains(document.activeElement)) box.scrollTop = row.offsetTop - box.clientHeight / 2;
}

export function fillFacts(list, facts) {
  list.replaceChildren(...facts.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value instanceof Node ? value : plain(value))]));
}

/** What there is to say of a run; `last`: of all of it, null while it goes on. */
export function factsOf({ name, result, page, last, took, duration }) {
  const { log } = result;
  const total = (counts) => Object.values(counts).reduce((a, b) => a + b, 0);
  const facts = [["log", name], ["digest now", make("code", { id: "digest-now" }, result.digest ?? "")]];
  if (last) facts.push(["digest at the end", make("code", { id: "digest" }, last.result.digest)]);
  facts.push(["profile", result.profile ?? ""], ["records used", `${log.records ?? 0}: ${log.frames ?? 0} frames, ${log.odometry ?? 0} of odometry`],
    ["not used", `${total(log.rejected)} bad lines, ${total(log.refused)} frames, ${log.foreign ?? 0} lines that are no records`]);
  if (last?.page.check.compared) {
    const { compared, differing, damaged } = last.page.check;
    facts.push(["the robot's own log", (differing ? `differs in ${differing} of ${compared} records` : `agrees in all ${compared} records compared`) +
      (damaged ? `; ${damaged} more cannot be read` : "")]);
  }
  if (page.runs > 1) facts.push(["runs in it", `${page.runs}; the last is shown, as by fencepost replay`]);
  if (last && took) facts.push(["replayed here in", `${Math.round(took.busy)} ms, ${(duration * 1000 / Math.max(1, took.busy)).toFixed(0)} times as fast as it was driven`]);
  return facts;
}

const REASONS = {
  crc: "damaged on its way: a loose cable, a wrong speed, or edited by hand", kind: "a record that this version does not know",
  fields: "too few or too many fields", number: "a number that is none", range: "a number outside its range",
  length: "longer than 1024 characters", truncated: "the file ends within the line", time: "not later than the one before",
  format: "another version of the stream",
};
const REFUSED = {
  no_pose: "no odometry ($FPODO) at their exposure: check latency and clock", odometry_gap: "odometry stopped for more than 0.5 s around them",
  no_camera: "no calibration ($FPCAM) before them", queue: "the log could not keep up",
};

/** What a log is short of; nothing and hidden where all is well. `lines(n)`: the text of a line. */
export function fillProblems(section, { result, page, lines }) {
  const parts = [];
  const say = (text) => parts.push(make("p", {}, plain(text)));
  if (page.unreadable) say(page.unreadable);
  for (const [reason, count] of Object.entries(result.log.rejected)) {
    if (count) say(`${count} line${count === 1 ? "" : "s"} not used, ${reason}: ${REASONS[reason] ?? reason}`);
  }
  for (const [reason, count] of Object.entries(result.log.refused)) {
    if (count) say(`${count} frame${count === 1 ? "" : "s"} not used, ${reason}: ${REFUSED[reason] ?? reason}`);
  }
  page.complaints.forEach(say);
  result.calibration.forEach((doubt) => say(`${doubt.t.toFixed(2)} s: ${doubt.says}`));
  if (page.check.differing) say(`${page.check.differing} of ${page.check.compared} of the robot's own records differ from this replay: ${page.check.first[0] ?? ""}`);
  if (page.bad_lines.length) {
    const rows = page.bad_lines.map(({ line, reason }) => make("tr", {}, make("td", { className: "n" }, line), make("td", {}, reason),
      make("td", {}, plain(lines(line)))));
    parts.push(make("details", { open: page.bad_lines.length <= 12 }, make("summary", {}, page.bad_lines.length < 100 ? "By line" : "The first 100, by line"),
      make("div", { className: "scroll tall", tabIndex: 0, role: "region", "aria-label": "Bad lines" },
        make("table", {}, headed(["line", "n"], ["reason"], ["text"]), make("tbody", {}, ...rows)))));
  }
  section.replaceChildren(...parts);
  section.hidden = parts.length === 0;
}
