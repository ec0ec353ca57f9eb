import { figure } from "./canvas.js";
import { colourOf, drawMark, markOf } from "./colours.js";
import { headed, make, plain } from "./dom.js";
import { t } from "./words.js";

const degrees = (radians) => radians === null || radians === undefined ? "–" : (radians * 180 / Math.PI).toFixed(0).replace(/^-0$/, "0");

/** The mark of a signature in its colour. */
export function keyOf(object, theme) {
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
    const name = object.name === null ? t("signature", { number: object.signature }) : plain(object.name);
    return make("tr", { className: object.id === selected ? "lit" : "" },
      make("td", {}, make("button", { type: "button", onclick: () => select(object.id), "aria-label": t("showObject", { id: object.id }), "aria-pressed": String(object.id === selected) }, object.id)),
      make("td", { className: "name" }, keyOf(object, theme), name),
      make("td", {}, make("span", { className: `level ${level}` }, level)),
      make("td", { className: "n" }, figure(circle.x, 3)), make("td", { className: "n" }, figure(circle.y, 3)),
      make("td", { className: "n" }, area == null ? "–" : figure(area * 1e4, 0)), make("td", { className: "n" }, figure(object.confidence, 2)),
      make("td", {}, object.state), make("td", { className: "n" }, object.views),
      make("td", { className: "n" }, figure(circle.radius, 3)), make("td", { className: "n" }, figure(object.z_max, 3)));
  });
  if (!rows.length) rows.push(make("tr", {}, make("td", { colSpan: 11 }, t("noObjects"))));
  const n = "n";
  table.replaceChildren(
    headed(["id"], [t("colName")], [t("colAlert")], ["x, m", n], ["y, m", n], [t("colArea"), n], [t("colConfidence"), n], [t("colState")], [t("colViews"), n], [t("colRadius"), n], [t("colTop"), n]),
    make("tbody", {}, ...rows));
}

const ROWS = 100;  // of alerts at a time: a long run has thousands

/** Those around the time `at`. Returns which: [first, end). */
export function fillAlerts(table, { result, at, go }) {
  const now = alertsUntil(result.alerts, at);
  const first = Math.max(0, Math.min(now - ROWS / 2, result.alerts.length - ROWS));
  const shown = result.alerts.slice(first, first + ROWS);
  const more = (n, when) => n > 0 ? [make("tr", {}, make("td", { colSpan: 6 }, t(when, { count: n })))] : [];
  const nameOf = (id) => id === 0 ? t("something") : `${id} ${plain(result.objects.find((o) => o.id === id)?.name ?? "")}`;
  const rows = shown.map((alert) => make("tr", {},
    make("td", {}, make("button", { type: "button", onclick: () => go(alert.t), "aria-label": t("goToTime", { time: alert.t.toFixed(2) }) }, `${alert.t.toFixed(2)}`)),
    make("td", {}, make("span", { className: `level ${alert.level}` }, alert.level)), make("td", { className: "name" }, nameOf(alert.id)),
    make("td", { className: "n" }, figure(alert.distance, 2)), make("td", { className: "n" }, degrees(alert.bearing)),
    make("td", { className: "n" }, figure(alert.ttc, 1))));
  if (!rows.length) rows.push(make("tr", {}, make("td", { colSpan: 6 }, t("noAlerts"))));
  const n = "n";
  table.replaceChildren(
    headed([t("colTime")], [t("colLevel")], [t("colObject")], [t("colAway"), n], [t("colLeft"), n], [t("colContact"), n]),
    make("tbody", {}, ...more(first, "earlier"), ...rows, ...more(result.alerts.length - first - shown.length, "later")));
  return [first, first + shown.length];
}

/** Counts of the whole run, also where its alerts were thinned. */
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
  if (!row || box.contains(document.activeElement)) return;
  const head = table.tHead.offsetHeight;
  const wanted = row.offsetTop - box.clientHeight / 2;
  const top = rows.find(({ offsetTop }) => offsetTop >= wanted + head);  // no row is cut by the head
  box.scrollTop = top ? top.offsetTop - head : wanted;
}

export function fillFacts(list, facts) {
  list.replaceChildren(...facts.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value instanceof Node ? value : plain(value))]));
}

/** The facts of a run; `last`: of all of it, null while it goes on. */
export function factsOf({ name, result, page, last, took, duration }) {
  const { log } = result;
  const total = (counts) => Object.values(counts).reduce((a, b) => a + b, 0);
  const facts = [[t("factLog"), name], [t("factDigestNow"), make("code", { id: "digest-now" }, result.digest ?? "")]];
  if (last) facts.push([t("factDigestEnd"), make("code", { id: "digest" }, last.result.digest)]);
  facts.push([t("factProfile"), result.profile ?? ""],
    [t("factUsed"), t("factUsedSays", { records: log.records ?? 0, frames: log.frames ?? 0, odometry: log.odometry ?? 0 })],
    [t("factUnused"), t("factUnusedSays", { lines: total(log.rejected), frames: total(log.refused), foreign: log.foreign ?? 0 })]);
  if (last?.page.check.compared) {
    const { compared, differing, damaged } = last.page.check;
    facts.push([t("factOwn"), t(differing ? "factDiffers" : "factAgrees", { differing, compared }) + (damaged ? t("factDamaged", { count: damaged }) : "")]);
  }
  if (page.runs > 1) facts.push([t("factRuns"), t("factRunsSays", { count: page.runs })]);
  if (last && took) facts.push([t("factTook"), t("factTookSays", { ms: Math.round(took.busy), times: (duration * 1000 / Math.max(1, took.busy)).toFixed(0) })]);
  return facts;
}

const REASONS = { crc: "whyCrc", kind: "whyKind", fields: "whyFields", number: "whyNumber", range: "whyRange", length: "whyLength",
  truncated: "whyTruncated", time: "whyTime", format: "whyFormat" };
const REFUSED = { no_pose: "whyNoPose", odometry_gap: "whyGap", no_camera: "whyNoCamera", queue: "whyQueue" };
const because = (reasons, reason) => reason in reasons ? t(reasons[reason]) : reason;

/** Lists a log's problems; empty and hidden where all is well. `lines(n)`: the text of a line. */
export function fillProblems(section, { result, page, lines }) {
  const parts = [];
  const say = (text) => parts.push(make("p", {}, plain(text)));
  if (page.unreadable) say(page.unreadable);
  for (const [reason, count] of Object.entries(result.log.rejected)) {
    if (count) say(t(count === 1 ? "lineUnused" : "linesUnused", { count, reason, why: because(REASONS, reason) }));
  }
  for (const [reason, count] of Object.entries(result.log.refused)) {
    if (count) say(t(count === 1 ? "frameUnused" : "framesUnused", { count, reason, why: because(REFUSED, reason) }));
  }
  page.complaints.forEach(say);
  result.calibration.forEach((doubt) => say(`${doubt.t.toFixed(2)} s: ${doubt.says}`));
  if (page.check.differing) say(t("recordsDiffer", { ...page.check, first: page.check.first[0] ?? "" }));
  if (page.bad_lines.length) {
    const rows = page.bad_lines.map(({ line, reason }) => make("tr", {}, make("td", { className: "n" }, line), make("td", {}, reason),
      make("td", {}, plain(lines(line)))));
    parts.push(make("details", { open: page.bad_lines.length <= 12 }, make("summary", {}, page.bad_lines.length < 100 ? t("byLine") : t("byLineFirst")),
      make("div", { className: "scroll tall", tabIndex: 0, role: "region", "aria-label": t("badLines") },
        make("table", {}, headed([t("colLine"), "n"], [t("colReason")], [t("colText")]), make("tbody", {}, ...rows)))));
  }
  section.replaceChildren(...parts);
  section.hidden = parts.length === 0;
}
