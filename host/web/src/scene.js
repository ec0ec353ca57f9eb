// A look in metres: outlines, the robot's body and zones, poses in between. Map frame.
import { plain } from "./dom.js";
import { t } from "./words.js";

const ringsOf = (geometry) => !geometry ? [] : geometry.type === "Polygon" ? [geometry.coordinates] : geometry.coordinates;

/** Polygons of one model, each a list of rings. */
export const polygonsOf = (object, model) => ringsOf(object.models[model]?.geometry);

/** The ring that stands for the object: the hybrid's, else the cylinder's. */
export function outlineOf(object) {
  return polygonsOf(object, "hybrid")[0]?.[0] ?? polygonsOf(object, "cylinder")[0]?.[0] ?? null;
}

export const openSidesOf = (object) => object.models.hybrid?.open?.coordinates ?? [];

export function centreOf(object) {
  const ring = outlineOf(object);
  if (!ring) return null;
  const points = ring.slice(0, -1);
  const mean = (axis) => points.reduce((sum, p) => sum + p[axis], 0) / points.length;
  return [mean(0), mean(1)];
}

const DOUBTFUL = 0.1;  // confidence below which an outline is a guess: it gets no area

export const isDoubtful = (object) => !(object.confidence >= DOUBTFUL);
/** How solid an object is drawn: by its confidence. */
export const opacityOf = (object) => Math.min(1, 0.25 + (object.confidence ?? 0));

export const nameOf = (object) => `${object.id} ${plain(object.name ?? t("signature", { number: object.signature }))}`;

/** The truth of a scene file: rings with names, and their index in it. */
export function truthOf(scene) {
  return (scene?.objects ?? []).map((object, index) => {
    const { circle, coordinates } = object.footprint ?? {};
    const round = (x, y, r) => Array.from({ length: 49 }, (_, i) =>
      [x + r * Math.cos(i * Math.PI / 24), y + r * Math.sin(i * Math.PI / 24)]);
    return { index, name: String(object.name ?? ""), ring: circle ? round(...circle) : coordinates?.[0] ?? [], low: object.base ?? 0,
      high: (object.base ?? 0) + (object.height ?? 0) };
  }).filter((object) => object.ring.length > 2 && object.ring.every((p) => p.every(Number.isFinite)));
}

const turn = (from, to) => Math.atan2(Math.sin(to - from), Math.cos(to - from));

/** Index of the last pose of `path` at or before `t`, or 0. */
export function poseIndex(path, t) {
  let low = 0;
  let high = path.length / 4;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (path[4 * middle] <= t) low = middle; else high = middle;
  }
  return low;
}

/** Between two samples on a straight line; null without any. */
export function poseAt(path, t) {
  if (path.length === 0) return null;
  const i = 4 * poseIndex(path, t);
  const pose = { t, x: path[i + 1], y: path[i + 2], heading: path[i + 3] };
  if (i + 4 >= path.length || t <= path[i]) return pose;
  const share = (t - path[i]) / (path[i + 4] - path[i]);
  pose.x += share * (path[i + 5] - pose.x);
  pose.y += share * (path[i + 6] - pose.y);
  pose.heading += share * turn(pose.heading, path[i + 7]);
  return pose;
}

/** Curvature of the robot's way now, 1/m; null where it is stationary or turns on the spot. */
export function curvatureAt(path, t) {
  const now = poseAt(path, t);
  const before = poseAt(path, t - 0.2);
  if (!now) return null;
  const way = Math.hypot(now.x - before.x, now.y - before.y);
  return way < 0.004 ? null : turn(before.heading, now.heading) / way;
}

/** From a frame on the robot into the map. */
export const placed = (pose, [x, y]) => {
  const c = Math.cos(pose.heading);
  const s = Math.sin(pose.heading);
  return [pose.x + c * x - s * y, pose.y + s * x + c * y];
};

/** The robot's body, robot frame, and what its alerts look at. */
export function bodyOf(settings) {
  const number = (key, otherwise) => Number(settings?.[key] ?? otherwise);
  const width = number("robot.width", 0.2);
  const front = number("robot.front", 0) || width / 2;
  const rear = number("robot.rear", 0) || width / 2;
  const lane = width / 2 + number("robot.margin", 0.05);
  const overhang = Math.max(0, front - width / 2);
  const zones = ["notice", "warn", "stop"].map((level) => ({ level, reach: number(`alert.${level}`, 0) + overhang }));
  return { width, front, rear, lane, zones,
    ring: [[front, width / 2], [-rear, width / 2], [-rear, -width / 2], [front, -width / 2]] };
}

/** The floor straight ahead whose things raise alerts. Robot frame. */
export function alertedFloor(settings) {
  const body = bodyOf(settings);
  return [...body.ring, ...sweptRing(body, Math.max(...body.zones.map(({ reach }) => reach)), 0)];
}

/** The floor that the robot is about to sweep, up to `reach` from its origin along its way. Robot frame. */
export function sweptRing(body, reach, curvature) {
  const steps = 16;
  const at = (s, side) => {
    const bend = (curvature ?? 0) * s;
    if (Math.abs(bend) < 1e-4) return [s, side];
    return [Math.sin(bend) / curvature - side * Math.sin(bend), (1 - Math.cos(bend)) / curvature + side * Math.cos(bend)];
  };
  const side = (offset) => Array.from({ length: steps + 1 }, (_, i) => at(reach * i / steps, offset));
  return [...side(-body.lane), ...side(body.lane).reverse()];
}

/** The level in force at `t` by object, 0 being the guard. */
export function levelsAt(alerts, t) {
  const levels = new Map();
  for (const alert of alerts) {
    if (alert.t > t) break;
    levels.set(alert.id, alert);
  }
  return levels;
}
