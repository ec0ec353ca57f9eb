// The top view: x forward is up on the page where the run began, as the robot's driver would look at it.
import { figure, label, niceStep, prepare } from "./canvas.js";
import { colourOf } from "./colours.js";
import { halfAngle } from "./lens.js";
import { drawLabels } from "./maplabels.js";
import { bodyOf, centreOf, curvatureAt, isDoubtful, nameOf, opacityOf, openSidesOf, outlineOf, placed, polygonsOf, poseIndex, sweptRing } from "./scene.js";
import { t } from "./words.js";

const DASHES = {
  hybrid: [], cylinder: [7, 4], sheaf: [10, 3, 2, 3], carve: [2, 3], clip: [4, 2], cylinder_paper: [6, 4], sheaf_paper: [2, 4],
  carve_paper: [1, 3], clip_paper: [4, 4],
};
const WEDGE = 1.5;  // m, how far the camera's wedge is drawn

export function trace(g, window, ring, close = true) {
  ring.forEach((p, i) => g[i ? "lineTo" : "moveTo"](...window.toPage(p)));
  if (close) g.closePath();
}

// Returns where its numbers are.
export function drawGrid({ g, window, ink, bare }) {
  const { width, height } = window;
  const step = niceStep(70 / window.scale);
  const [x1, y1] = window.toMap([0, height]);
  const [x2, y2] = window.toMap([width, 0]);
  const decimals = Math.max(0, -Math.floor(Math.log10(step) + 1e-9));
  const lines = (from, to) => Array.from({ length: Math.max(0, Math.floor(to / step) - Math.ceil(from / step) + 1) },
    (_, i) => (Math.ceil(from / step) + i) * step);
  g.strokeStyle = ink.rule;
  g.lineWidth = 1;
  g.beginPath();
  for (const x of lines(x1, x2)) { const [u] = window.toPage([x, 0]); g.moveTo(u, 0); g.lineTo(u, height); }
  for (const y of lines(y1, y2)) { const [, v] = window.toPage([0, y]); g.moveTo(0, v); g.lineTo(width, v); }
  g.stroke();
  if (bare) return [];
  const numbers = [];
  const write = (text, u, v, align) => {
    g.textAlign = align;
    const w = g.measureText(text).width;
    const left = align === "center" ? u - w / 2 : align === "right" ? u - w : u;
    numbers.push([left - 2, v - 12, left + w + 2, v + 4]);
    label(g, text, u, v, ink.soft, ink.paper);
  };
  g.font = "12px system-ui, sans-serif";
  g.textBaseline = "alphabetic";
  for (const x of lines(x1, x2)) {
    const u = window.toPage([x, 0])[0];
    if (u > 36 && u < width - 46) write(`${x.toFixed(decimals)}`, u, height - 6, "center");
  }
  for (const y of lines(y1, y2)) {
    const v = window.toPage([0, y])[1];
    if (v > 16 && v < height - 26) write(`${y.toFixed(decimals)}`, 5, v + 4, "left");
  }
  write("y, m", 5, 14, "left");
  write("x, m", width - 5, height - 6, "right");
  return numbers;
}

const HATCH = 6;  // px
const hatches = new Map();  // by colour

function hatchOf(g, colour) {
  if (!hatches.has(colour)) {
    const tile = new OffscreenCanvas(HATCH, HATCH);
    const t = tile.getContext("2d");
    t.strokeStyle = colour;
    t.beginPath();
    for (const shift of [-HATCH, 0, HATCH]) { t.moveTo(shift - 1, HATCH + 1); t.lineTo(shift + HATCH + 1, -1); }
    t.stroke();
    hatches.set(colour, g.createPattern(tile, "repeat"));
  }
  return hatches.get(colour);
}

function drawTruth({ g, window, ink, theme, view }) {
  for (const { ring, rgb, signature, index } of view.truth) {
    const colour = rgb ? colourOf(rgb, signature, theme) : ink.soft;
    g.beginPath();
    trace(g, window, ring);
    g.fillStyle = hatchOf(g, colour);
    g.fill();
    g.strokeStyle = colour;
    g.lineWidth = view.chosen === index ? 2.5 : 1;
    g.stroke();
  }
}

function drawPath({ g, window, ink, view, whole }) {
  const draw = (path, from, to) => {
    g.beginPath();
    let last = null;
    for (let i = from; i < to; ++i) {
      const p = window.toPage([path[4 * i + 1], path[4 * i + 2]]);
      if (last && i + 1 < to && Math.hypot(p[0] - last[0], p[1] - last[1]) < 1) continue;
      g[last ? "lineTo" : "moveTo"](...p);
      last = p;
    }
    g.stroke();
  };
  g.lineJoin = "round";
  g.strokeStyle = ink.soft;
  g.globalAlpha = 0.45;
  g.lineWidth = 1.2;
  g.setLineDash([3, 4]);
  if (whole.length) draw(whole, poseIndex(whole, view.t), whole.length / 4);
  g.setLineDash([]);
  g.globalAlpha = 1;
  g.strokeStyle = ink.ink;
  g.lineWidth = 1.8;
  if (view.path.length) draw(view.path, 0, view.path.length / 4);
}

function drawZones({ g, window, ink, view, pose }) {
  const body = bodyOf(view.page.settings);
  const bend = curvatureAt(view.path, view.t);
  for (const { level, reach } of body.zones) {
    g.beginPath();
    trace(g, window, sweptRing(body, reach, bend).map((p) => placed(pose, p)));
    g.globalAlpha = 0.16;
    g.fillStyle = ink[level];
    g.fill();
    g.globalAlpha = 0.9;
    g.strokeStyle = ink[level];
    g.lineWidth = 1;
    g.stroke();
  }
  g.globalAlpha = 1;
}

function drawWedge({ g, window, ink, view, pose }) {
  const { camera } = view.result;
  if (!camera) return;
  const lens = placed(pose, [camera.mount.x, camera.mount.y]);
  const half = halfAngle(camera);
  const yaw = pose.heading + camera.mount.yaw;
  const [u, v] = window.toPage(lens);
  g.beginPath();
  g.moveTo(u, v);
  g.arc(u, v, WEDGE * window.scale, -yaw - half, -yaw + half);
  g.closePath();
  g.globalAlpha = 0.08;
  g.fillStyle = ink.accent;
  g.fill();
  g.globalAlpha = 0.7;
  g.strokeStyle = ink.accent;
  g.lineWidth = 1;
  g.stroke();
  g.globalAlpha = 1;
}

function drawRobot({ g, window, ink, view, pose }) {
  const body = bodyOf(view.page.settings);
  g.beginPath();
  trace(g, window, body.ring.map((p) => placed(pose, p)));
  g.fillStyle = ink.ink;
  g.globalAlpha = 0.85;
  g.fill();
  g.globalAlpha = 1;
  g.strokeStyle = ink.paper;
  g.lineWidth = 1.5;
  g.stroke();
  g.beginPath();
  const nose = Math.min(body.front, body.width) * 0.7;
  trace(g, window, [[nose, 0], [-nose * 0.5, nose * 0.6], [-nose * 0.2, 0], [-nose * 0.5, -nose * 0.6]].map((p) => placed(pose, p)));
  g.fillStyle = ink.paper;
  g.fill();
}

// Where the robot is while it takes itself to be elsewhere.
function drawTrueRobot({ g, window, ink, view }) {
  const { trueRobot, pose } = view;
  if (!trueRobot || Math.hypot(trueRobot.x - pose.x, trueRobot.y - pose.y) < 0.01) return;
  g.beginPath();
  trace(g, window, bodyOf(view.page.settings).ring.map((p) => placed(trueRobot, p)));
  g.strokeStyle = ink.soft;
  g.lineWidth = 1.5;
  g.setLineDash([4, 3]);
  g.stroke();
  g.setLineDash([]);
}

function drawModel({ g, window, theme }, object, model) {
  const polygons = polygonsOf(object, model);
  if (!polygons.length) return;
  const colour = colourOf(object.rgb, object.signature, theme);
  const doubtful = isDoubtful(object);
  g.globalAlpha = opacityOf(object);
  g.beginPath();
  for (const rings of polygons) for (const ring of rings) trace(g, window, ring);
  g.strokeStyle = g.fillStyle = colour;
  g.lineWidth = model === "hybrid" && !doubtful ? 2.6 : 1.2;
  g.setLineDash(DASHES[model] ?? [3, 3]);
  g.stroke();
  g.setLineDash([]);
  if (model === "hybrid" && !doubtful) {
    g.globalAlpha *= 0.3;
    g.fill("evenodd");
  }
  g.globalAlpha = 1;
}

function drawOpenSides({ g, window, ink }, object) {
  g.strokeStyle = ink.paper;
  g.lineWidth = 2.8;
  g.setLineDash([4, 4]);
  for (const line of openSidesOf(object)) {
    g.beginPath();
    trace(g, window, line, false);
    g.stroke();
  }
  g.setLineDash([]);
}

function drawGuard({ g, window, ink, view }) {
  for (const point of view.result.guard) {
    const [u, v] = window.toPage([point.x, point.y]);
    g.strokeStyle = ink.stop;
    g.lineWidth = 1.5;
    g.beginPath();
    g.moveTo(u - 3, v - 3); g.lineTo(u + 3, v + 3); g.moveTo(u - 3, v + 3); g.lineTo(u + 3, v - 3);
    g.stroke();
  }
}

function drawHighlight({ g, window, ink, view, selected }) {
  const object = view.result.objects.find((o) => o.id === selected);
  const ring = object && outlineOf(object);
  if (!ring) return;
  const points = ring.map((p) => window.toPage(p));
  const [u, v] = window.toPage(centreOf(object));
  g.beginPath();
  g.arc(u, v, 8 + Math.max(...points.map((p) => Math.hypot(p[0] - u, p[1] - v))), 0, 2 * Math.PI);
  g.strokeStyle = ink.accent;
  g.lineWidth = 2;
  g.stroke();
}

/** `view`: a look with t, pose, truth and layers; `whole`: the path of all the run; `bare`: too small for numbers.
 * `memory`: of where names were. For tests the canvas has `placed` (names and their places) and the window's `toPage`. */
export function drawMap(canvas, window, { view, whole, ink, theme, selected, bare = false, memory }) {
  const { g, width, height } = prepare(canvas);
  window.size(width, height);
  canvas.toPage = (place) => window.toPage(place);
  g.fillStyle = ink.paper;
  g.fillRect(0, 0, width, height);
  const all = { canvas, g, window, ink, theme, view, whole, selected, bare, memory, pose: view.pose };
  all.axes = drawGrid(all);
  if (view.layers.has("truth")) drawTruth(all);
  if (view.pose && view.layers.has("zones")) drawZones(all);
  if (view.pose && view.layers.has("wedge")) drawWedge(all);
  if (view.layers.has("path")) drawPath(all);
  if (view.layers.has("guard")) drawGuard(all);
  for (const object of view.result.objects) {
    for (const model of view.models) drawModel(all, object, model);
    if (view.models.includes("hybrid") && !isDoubtful(object)) drawOpenSides(all, object);
  }
  if (view.pose) {
    drawTrueRobot(all);
    drawRobot(all);
  }
  drawHighlight(all);
  drawLabels(all);
}

/** The numbers of an object, a line each. */
export function describe(object, pose, alert) {
  const circle = object.models.cylinder;
  const lines = [nameOf(object), t("tipState", { state: object.state, views: object.views, confidence: figure(object.confidence, 2) })];
  if (circle?.x != null) lines.push(t("tipCircle", { x: figure(circle.x, 3), y: figure(circle.y, 3), radius: figure(circle.radius, 3) }));
  const area = object.models.hybrid?.area;
  lines.push(t("tipHigh", { base: figure(object.base, 2), top: figure(object.z_max, 2) }) + (area == null ? "" : `, ${figure(area * 1e4, 0)} cm²`));
  if (pose && circle?.x != null) {
    const bearing = Math.atan2(circle.y - pose.y, circle.x - pose.x) - pose.heading;
    const degrees = Math.atan2(Math.sin(bearing), Math.cos(bearing)) * 180 / Math.PI;
    lines.push(t("tipCentre", { distance: figure(Math.hypot(circle.x - pose.x, circle.y - pose.y), 2), degrees: figure(Math.abs(degrees), 0), side: t(degrees < 0 ? "right" : "left") }));
  }
  if (alert) lines.push(t(alert.distance == null ? "tipAlert" : "tipAlertAt", { level: alert.level, distance: figure(alert.distance, 2) }));
  return lines.join("\n");
}
