// The same from the side: outlines as solids, drawn from far to near.
import { niceStep, prepare } from "./canvas.js";
import { colourOf } from "./colours.js";
import { fitted, Labels } from "./labels.js";
import { bodyOf, centreOf, curvatureAt, isDoubtful, nameOf, opacityOf, outlineOf, placed, sweptRing } from "./scene.js";
import { t } from "./words.js";

const ROBOT_HEIGHT = 0.09;  // m, drawn: nobody tells it
const NEAR = 0.05;

/** A camera that goes around a point of the floor. */
export class Orbit {
  constructor() { this.turn = -0.6; this.tilt = 0.6; this.distance = 3; this.x = 0; this.y = 0; }
  size(width, height) { this.width = width; this.height = height; }
  fit(points) {
    if (points.length === 0) return;
    const range = (axis) => points.reduce(([a, b], p) => [Math.min(a, p[axis]), Math.max(b, p[axis])], [Infinity, -Infinity]);
    const [x1, x2] = range(0);
    const [y1, y2] = range(1);
    this.x = (x1 + x2) / 2;
    this.y = (y1 + y2) / 2;
    this.distance = 0.4 + 0.95 * Math.hypot(x2 - x1, y2 - y1) * Math.max(1, 0.75 * this.height / this.width);
  }
  zoom(factor) { this.distance = Math.min(200, Math.max(0.2, this.distance / factor)); }
  drag(du, dv) {
    this.turn -= du * 0.006;
    this.tilt = Math.min(1.5, Math.max(0.12, this.tilt + dv * 0.006));
  }
  /** Depth along the axis, then right and up of it. */
  axes([x, y], z) {
    const [c, s] = [Math.cos(this.turn), Math.sin(this.turn)];
    const [ct, st] = [Math.cos(this.tilt), Math.sin(this.tilt)];
    const ahead = c * (x - this.x) + s * (y - this.y);
    const right = s * (x - this.x) - c * (y - this.y);
    return [this.distance + ct * ahead - st * z, right, st * ahead + ct * z];
  }
  project([depth, right, up]) {
    const f = 1.1 * Math.min(this.width, this.height * 1.5) / depth;
    return [this.width / 2 + f * right, this.height * 0.52 - f * up];
  }
}

// Cuts off what is behind the camera.
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

function drawFace(g, orbit, points) {
  const page = clipped(points).map((p) => orbit.project(p));
  if (page.length < 2) return;
  g.beginPath();
  page.forEach((p, i) => g[i ? "lineTo" : "moveTo"](...p));
  g.closePath();
}

function shade(hex, factor) {
  const channel = (at) => Math.round(Math.min(255, parseInt(hex.slice(at, at + 2), 16) * factor));
  return `rgb(${channel(1)} ${channel(3)} ${channel(5)})`;
}

/** The faces of a solid, with what to fill them. */
function facesOf(orbit, ring, low, high, colour, alpha) {
  const corners = ring.slice(0, ring.length > 1 && ring[0][0] === ring.at(-1)[0] && ring[0][1] === ring.at(-1)[1] ? -1 : undefined);
  const faces = corners.map((p, i) => {
    const q = corners[(i + 1) % corners.length];
    const light = 0.75 + 0.2 * Math.cos(Math.atan2(q[1] - p[1], q[0] - p[0]) - orbit.turn);
    return { points: [[p, low], [q, low], [q, high], [p, high]], fill: shade(colour, light), alpha };
  });
  faces.push({ points: corners.map((p) => [p, high]), fill: shade(colour, 1.12), alpha });
  return faces.map((face) => {
    const points = face.points.map(([p, z]) => orbit.axes(p, z));
    return { ...face, points, depth: points.reduce((sum, p) => sum + p[0], 0) / points.length };
  });
}

function drawFloor(g, orbit, ink) {
  const step = niceStep(orbit.distance / 9);
  const reach = 8 * step;
  const [cx, cy] = [Math.round(orbit.x / step) * step, Math.round(orbit.y / step) * step];
  g.strokeStyle = ink.rule;
  g.lineWidth = 1;
  for (let i = -8; i <= 8; ++i) {
    drawFace(g, orbit, [orbit.axes([cx + i * step, cy - reach], 0), orbit.axes([cx + i * step, cy + reach], 0)]);
    g.stroke();
    drawFace(g, orbit, [orbit.axes([cx - reach, cy + i * step], 0), orbit.axes([cx + reach, cy + i * step], 0)]);
    g.stroke();
  }
  g.fillStyle = ink.soft;
  g.textAlign = "left";
  g.fillText(t("oneSquare", { size: step >= 1 ? `${step} m` : `${Math.round(step * 100)} cm` }), 8, orbit.height - 8);
}

function drawOnFloor(g, orbit, ring, ink, alpha) {
  drawFace(g, orbit, ring.map((p) => orbit.axes(p, 0)));
  g.globalAlpha = alpha;
  g.fillStyle = ink;
  g.fill();
  g.globalAlpha = 1;
}

function drawPath(g, orbit, path, ink) {
  g.strokeStyle = ink;
  g.lineWidth = 1.8;
  g.beginPath();
  let drawn = false;
  for (let i = 0; i < path.length; i += 4) {
    const p = orbit.axes([path[i + 1], path[i + 2]], 0);
    if (p[0] < NEAR) { drawn = false; continue; }
    g[drawn ? "lineTo" : "moveTo"](...orbit.project(p));
    drawn = true;
  }
  g.stroke();
}

// The edges of what the camera sees, to a frame 0.4 m ahead.
function drawFrustum(g, orbit, { view, ink }) {
  const { camera } = view.result;
  const { pose } = view;
  if (!camera || !pose || camera.lens) return;
  const ahead = 0.4;
  const yaw = pose.heading + camera.mount.yaw;
  const lens = placed(pose, [camera.mount.x, camera.mount.y]);
  const corner = (u, v) => {
    const [left, up] = [-(u - camera.cx) / camera.fx * ahead, -(v - camera.cy) / camera.fy * ahead];
    return orbit.axes(placed({ x: lens[0], y: lens[1], heading: yaw }, [ahead, left]), camera.mount.z + up - Math.tan(camera.mount.pitch ?? 0) * ahead);
  };
  const corners = [corner(0, 0), corner(camera.width, 0), corner(camera.width, camera.height), corner(0, camera.height)];
  const eye = orbit.axes(lens, camera.mount.z);
  g.strokeStyle = ink.accent;
  g.lineWidth = 1.2;
  for (const face of [corners, ...corners.map((c) => [eye, c])]) {
    drawFace(g, orbit, face);
    g.stroke();
  }
}

export function drawSolid(canvas, orbit, { view, ink, theme, selected, memory }) {
  const { g, width, height } = prepare(canvas);
  orbit.size(width, height);
  g.fillStyle = ink.paper;
  g.fillRect(0, 0, width, height);
  drawFloor(g, orbit, ink);
  const body = bodyOf(view.page.settings);
  const { pose } = view;
  if (pose && view.layers.has("zones")) {
    const bend = curvatureAt(view.path, view.t);
    for (const { level, reach } of body.zones) drawOnFloor(g, orbit, sweptRing(body, reach, bend).map((p) => placed(pose, p)), ink[level], 0.22);
  }
  if (view.layers.has("path")) drawPath(g, orbit, view.path, ink.ink);
  const faces = [];
  if (view.layers.has("truth")) {
    g.strokeStyle = ink.soft;
    g.lineWidth = 0.8;
    for (const { ring, low, high } of view.truth) {
      for (const z of [low, high]) { drawFace(g, orbit, ring.map((p) => orbit.axes(p, z))); g.stroke(); }
      if (ring.length > 12) continue;
      for (const p of ring) { drawFace(g, orbit, [orbit.axes(p, low), orbit.axes(p, high)]); g.stroke(); }
    }
  }
  for (const object of view.result.objects) {
    const ring = outlineOf(object);
    if (!ring) continue;
    const colour = colourOf(object.rgb, object.signature, theme);
    if (isDoubtful(object)) {
      drawFace(g, orbit, ring.map((p) => orbit.axes(p, 0)));
      g.strokeStyle = colour;
      g.globalAlpha = opacityOf(object);
      g.stroke();
      g.globalAlpha = 1;
      continue;
    }
    faces.push(...facesOf(orbit, ring, object.base, Math.max(object.z_max, object.base + 0.005), colour, 0.95 * opacityOf(object)));
  }
  if (pose) faces.push(...facesOf(orbit, body.ring.map((p) => placed(pose, p)), 0.01, ROBOT_HEIGHT, theme === "dark" ? "#c8d2dc" : "#4a5663", 1));
  faces.sort((a, b) => b.depth - a.depth);
  for (const face of faces) {
    drawFace(g, orbit, face.points);
    g.globalAlpha = face.alpha;
    g.fillStyle = face.fill;
    g.fill();
    g.strokeStyle = ink.paper;
    g.lineWidth = 0.6;
    g.stroke();
    g.globalAlpha = 1;
  }
  if (view.layers.has("wedge")) drawFrustum(g, orbit, { view, ink });
  canvas.placed = [];
  if (!view.layers.has("labels")) return;
  const labels = new Labels(g, width, height, memory);
  labels.block([0, height - 24, 140, height]);
  const shown = view.result.objects.filter((o) => o.state !== "tentative" && centreOf(o)).sort((a, b) => b.views - a.views)
    .map((object) => ({ object, top: orbit.axes(centreOf(object), object.z_max) })).filter(({ top }) => top[0] >= NEAR);
  g.font = "700 13px system-ui, sans-serif";
  const names = fitted(shown.map(({ object }) => nameOf(object)), (text) => g.measureText(text).width < 0.6 * width);
  shown.forEach(({ object, top }, i) => {
    const [u, v] = orbit.project(top);
    if (u < 0 || u > width || v < 0 || v > height) return;
    labels.mark([u - 3, v - 3, u + 3, v + 3]);
    const w = g.measureText(names[i]).width + 4;
    labels.add({ key: object.id, texts: [names[i], String(object.id)], at: [u, v], box: [u - 3, v - 3, u + 3, v + 3], first: [[u - w / 2, v - 15]],
      font: `${object.id === selected ? "700" : "600"} 13px system-ui, sans-serif`, ink: ink.ink, colour: colourOf(object.rgb, object.signature, theme) });
  });
  labels.draw(ink.paper);
  canvas.placed = labels.placed;
}
