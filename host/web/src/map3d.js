// The same in 3-D: outlines as solids with their shadows, drawn from far to near.
import { niceStep, prepare } from "./canvas.js";
import { colourOf } from "./colours.js";
import { fitted, Labels } from "./labels.js";
import { bodyOf, centreOf, curvatureAt, isDoubtful, nameOf, opacityOf, outlineOf, placed, sweptRing } from "./scene.js";
import { facesOf, inOrder, shadowOf, solidOf } from "./solids.js";
import { NEAR } from "./viewpoint.js";
import { t } from "./words.js";

const ROBOT = { low: 0.015, high: 0.075, wheel: 0.06, tyre: 0.012, head: 0.03 };  // m, drawn: nobody says these
const GLASS = { coloured: 0.38, grey: 0.12 };  // opacity of true things: a grey wall may stand before the robot
const FAR = 300;     // m, as far as the floor goes
const LINES = 10;    // of the grid, to each side
const ROOM = 0.5;    // m between them for an eye that goes along

// Cuts off what is behind the eye.
function clipped(points) {
  const result = [];
  points.forEach((p, i) => {
    const q = points[(i + 1) % points.length];
    if (p[0] >= NEAR) result.push(p);
    if ((p[0] >= NEAR) === (q[0] >= NEAR)) return;
    const share = (NEAR - p[0]) / (q[0] - p[0]);
    result.push(p.map((value, axis) => value + share * (q[axis] - value)));
  });
  return result;
}

// Adds a face to the path; `points` in the eye's axes.
function addFace(g, eye, points) {
  const page = clipped(points).map((p) => eye.project(p));
  if (page.length < 2) return;
  page.forEach((p, i) => g[i ? "lineTo" : "moveTo"](...p));
  g.closePath();
}

function drawFace(g, eye, points) {
  g.beginPath();
  addFace(g, eye, points);
}

const onFloor = (eye, ring, height = 0) => ring.map((p) => eye.axes(p, height));

function shade(hex, factor) {
  const channel = (at) => Math.round(Math.min(255, parseInt(hex.slice(at, at + 2), 16) * factor));
  return `rgb(${channel(1)} ${channel(3)} ${channel(5)})`;
}

function drawFloor({ g, eye, ink }) {
  g.fillStyle = ink.ground;
  g.fillRect(0, 0, eye.width, eye.height);
  const [x, y] = eye.eye;
  drawFace(g, eye, onFloor(eye, [[x - FAR, y - FAR], [x + FAR, y - FAR], [x + FAR, y + FAR], [x - FAR, y + FAR]]));
  g.fillStyle = ink.paper;
  g.fill();
  const step = eye.alongside ? ROOM : niceStep(eye.distance / 9);
  const reach = LINES * step;
  const [cx, cy] = [Math.round(eye.x / step) * step, Math.round(eye.y / step) * step];
  g.strokeStyle = ink.rule;
  g.lineWidth = 1;
  g.beginPath();
  for (let i = -LINES; i <= LINES; ++i) {
    addFace(g, eye, onFloor(eye, [[cx + i * step, cy - reach], [cx + i * step, cy + reach]]));
    addFace(g, eye, onFloor(eye, [[cx - reach, cy + i * step], [cx + reach, cy + i * step]]));
  }
  g.stroke();
  return step;
}

function drawScale({ g, eye, ink }, step) {
  g.fillStyle = ink.soft;
  g.textAlign = "left";
  g.fillText(t("oneSquare", { size: step >= 1 ? `${step} m` : `${Math.round(step * 100)} cm` }), 8, eye.height - 8);
}

function drawZones({ g, eye, ink, view, pose, body }) {
  const bend = curvatureAt(view.path, view.t);
  g.globalAlpha = 0.22;
  for (const { level, reach } of body.zones) {
    drawFace(g, eye, onFloor(eye, sweptRing(body, reach, bend).map((p) => placed(pose, p))));
    g.fillStyle = ink[level];
    g.fill();
  }
  g.globalAlpha = 1;
}

function drawPath({ g, eye, ink, view: { path } }) {
  g.strokeStyle = ink.ink;
  g.lineWidth = 1.8;
  g.beginPath();
  let last = null;
  for (let i = 0; i < path.length; i += 4) {
    const p = eye.axes([path[i + 1], path[i + 2]], 0);
    if (p[0] < NEAR) { last = null; continue; }
    const page = eye.project(p);
    if (last && i + 4 < path.length && Math.hypot(page[0] - last[0], page[1] - last[1]) < 1) continue;
    g[last ? "lineTo" : "moveTo"](...page);
    last = page;
  }
  g.stroke();
}

// The edges of the camera's view, to a frame 0.4 m ahead.
function drawFrustum({ g, eye, ink, view, pose }) {
  const { camera } = view.result;
  if (!camera || !pose || camera.lens) return;
  const ahead = 0.4;
  const yaw = pose.heading + camera.mount.yaw;
  const lens = placed(pose, [camera.mount.x, camera.mount.y]);
  const corner = (u, v) => {
    const [left, up] = [-(u - camera.cx) / camera.fx * ahead, -(v - camera.cy) / camera.fy * ahead];
    return eye.axes(placed({ x: lens[0], y: lens[1], heading: yaw }, [ahead, left]), camera.mount.z + up - Math.tan(camera.mount.pitch ?? 0) * ahead);
  };
  const corners = [corner(0, 0), corner(camera.width, 0), corner(camera.width, camera.height), corner(0, camera.height)];
  const from = eye.axes(lens, camera.mount.z);
  g.strokeStyle = ink.accent;
  g.lineWidth = 1.2;
  g.beginPath();
  for (const face of [corners, ...corners.map((c) => [from, c])]) addFace(g, eye, face);
  g.stroke();
}

// The surroundings of the camera's picture are paler.
function drawImageBorder({ g, eye, ink }) {
  const [left, top, right, bottom] = eye.image;
  const box = (u1, v1, u2, v2) => { g.moveTo(u1, v1); g.lineTo(u2, v1); g.lineTo(u2, v2); g.lineTo(u1, v2); g.closePath(); };
  g.beginPath();
  box(0, 0, eye.width, eye.height);
  box(left, top, right, bottom);
  g.globalAlpha = 0.55;
  g.fillStyle = ink.ground;
  g.fill("evenodd");
  g.globalAlpha = 1;
  g.beginPath();
  box(left, top, right, bottom);
  g.strokeStyle = ink.accent;
  g.lineWidth = 2;
  g.stroke();
}

function robotOf({ view, pose, body, theme }) {
  const at = (ring, low, high, colour) => solidOf(ring.map((p) => placed(pose, p)), low, high, { colour, alpha: 1 });
  const box = (x1, y1, x2, y2) => [[x1, y1], [x2, y1], [x2, y2], [x1, y2]];
  const half = body.width / 2;
  const [shell, tyre, lens] = theme === "dark" ? ["#c8d2dc", "#6a7683", "#7cc0f5"] : ["#5a6673", "#2a323b", "#0b5fa5"];
  const parts = [at(body.ring, ROBOT.low, ROBOT.high, shell)];
  for (const side of [-1, 1]) parts.push(at(box(-ROBOT.wheel / 2, side * half, ROBOT.wheel / 2, side * (half + ROBOT.tyre)), 0, ROBOT.wheel, tyre));
  const mount = view.result.camera?.mount;
  if (mount) {
    const [x, y] = [mount.x - ROBOT.head / 2, mount.y];
    parts.push(at(box(x - ROBOT.head / 2, y - ROBOT.head / 2, x + ROBOT.head / 2, y + ROBOT.head / 2), ROBOT.high, Math.max(ROBOT.high, mount.z) + ROBOT.head / 2, lens));
  }
  return parts;
}

function solidsOf(all) {
  const { view, theme, ink, pose, eye, selected } = all;
  const solids = [];
  for (const object of view.result.objects) {
    const ring = outlineOf(object);
    if (!ring || isDoubtful(object)) continue;
    solids.push(solidOf(ring, object.base, Math.max(object.z_max, object.base + 0.005),
      { colour: colourOf(object.rgb, object.signature, theme), alpha: opacityOf(object), selected: object.id === selected }));
  }
  if (view.layers.has("truth")) {
    for (const { ring, low, high, rgb, signature } of view.truth) {
      solids.push(solidOf(ring, low, high, { colour: rgb ? colourOf(rgb, signature, theme) : ink.soft, glass: rgb ? GLASS.coloured : GLASS.grey }));
    }
  }
  if (pose && !eye.image) solids.push(...robotOf(all));
  return solids;
}

function drawShadows({ g, eye, theme }, solids) {
  g.beginPath();
  for (const solid of solids) addFace(g, eye, onFloor(eye, shadowOf(solid)));
  g.globalAlpha = theme === "dark" ? 0.4 : 0.17;
  g.fillStyle = "#000";
  g.fill();
  g.globalAlpha = 1;
}

const inAxes = (eye, { points }) => points.map(([p, height]) => eye.axes(p, height));

// All that is seen of it in one stroke of the brush, and its edges.
function drawGlass(g, eye, { colour, glass }, faces) {
  g.fillStyle = g.strokeStyle = colour;
  g.beginPath();
  for (const face of faces) addFace(g, eye, inAxes(eye, face));
  g.globalAlpha = glass;
  g.fill();
  g.globalAlpha = 0.55;
  g.lineWidth = 1;
  g.beginPath();
  for (const { points, sharp, top } of faces) {
    if (top) { addFace(g, eye, inAxes(eye, { points })); continue; }
    const [a, b, c, d] = inAxes(eye, { points });
    for (const edge of [[a, b], [c, d], ...sharp ? [[d, a]] : []]) addFace(g, eye, edge);
  }
  g.stroke();
  g.globalAlpha = 1;
}

function drawOpaque({ g, eye, ink }, { colour, alpha, selected }, faces) {
  for (const face of faces) {
    const points = inAxes(eye, face);
    drawFace(g, eye, points);
    g.globalAlpha = alpha;
    g.fillStyle = g.strokeStyle = shade(colour, face.light);
    g.fill();
    if (alpha === 1) {  // no gap to the next one
      g.lineWidth = 0.8;
      g.stroke();
    }
    if (face.top || face.sharp) {
      if (!face.top) drawFace(g, eye, [points[0], points[3]]);
      g.strokeStyle = selected ? ink.accent : shade(colour, 0.5);
      g.lineWidth = selected ? 3 : 1;
      g.stroke();
    }
    g.globalAlpha = 1;
  }
}

function drawNames({ g, eye, ink, theme, view, selected, memory }) {
  const { width, height } = eye;
  const labels = new Labels(g, width, height, memory);
  labels.block([0, height - 24, 140, height]);
  const shown = view.result.objects.filter((o) => o.state !== "tentative" && centreOf(o)).sort((a, b) => b.views - a.views)
    .map((object) => ({ object, top: eye.axes(centreOf(object), object.z_max) })).filter(({ top }) => top[0] >= NEAR);
  g.font = "700 13px system-ui, sans-serif";
  const names = fitted(shown.map(({ object }) => nameOf(object)), (text) => g.measureText(text).width < 0.6 * width);
  shown.forEach(({ object, top }, i) => {
    const [u, v] = eye.project(top);
    if (u < 0 || u > width || v < 0 || v > height) return;
    labels.mark([u - 3, v - 3, u + 3, v + 3]);
    const w = g.measureText(names[i]).width + 4;
    labels.add({ key: object.id, texts: [names[i], String(object.id)], at: [u, v], box: [u - 3, v - 3, u + 3, v + 3], first: [[u - w / 2, v - 15]],
      font: `${object.id === selected ? "700" : "600"} 13px system-ui, sans-serif`, ink: ink.ink, colour: colourOf(object.rgb, object.signature, theme) });
  });
  labels.draw(ink.paper);
  return labels.placed;
}

/** `eye`: an Orbit, Behind or Eye. */
export function drawSolid(canvas, eye, { view, ink, theme, selected, memory }) {
  const { g, width, height } = prepare(canvas);
  eye.size(width, height);
  eye.place(view);
  const { pose } = view;
  const all = { g, eye, view, ink, theme, selected, memory, pose, body: bodyOf(view.page.settings) };
  const step = drawFloor(all);
  if (pose && view.layers.has("zones")) drawZones(all);
  const solids = solidsOf(all);
  drawShadows(all, solids);
  if (view.layers.has("path")) drawPath(all);
  for (const object of view.result.objects) {
    const ring = isDoubtful(object) && outlineOf(object);
    if (!ring) continue;
    drawFace(g, eye, onFloor(eye, ring));
    g.strokeStyle = colourOf(object.rgb, object.signature, theme);
    g.globalAlpha = opacityOf(object);
    g.stroke();
    g.globalAlpha = 1;
  }
  for (const solid of inOrder(solids, eye.eye)) {
    const faces = facesOf(solid, eye.eye);
    if (solid.glass) drawGlass(g, eye, solid, faces); else drawOpaque(all, solid, faces);
  }
  if (eye.image) drawImageBorder(all);
  else if (view.layers.has("wedge")) drawFrustum(all);
  drawScale(all, step);
  canvas.placed = view.layers.has("labels") ? drawNames(all) : [];
}
