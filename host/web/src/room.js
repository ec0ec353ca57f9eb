// The room that a robot is driven through: a scene (host/share/doc/scene.md) that is edited. Map frame, metres.
const box = (x, y, wide, deep, turn = 0) => {
  const [c, s] = [Math.cos(turn), Math.sin(turn)];
  const corner = (u, v) => [round(x + c * u - s * v), round(y + s * u + c * v)];
  const ring = [corner(-deep / 2, -wide / 2), corner(deep / 2, -wide / 2), corner(deep / 2, wide / 2), corner(-deep / 2, wide / 2)];
  return { type: "Polygon", coordinates: [[...ring, ring[0]]] };
};
const can = (x, y, radius) => ({ circle: [round(x), round(y), radius] });
const round = (metres) => Math.round(metres * 1e4) / 1e4;

// The camera was not taught the colour of these: it does not report them.
const grey = (x1, y1, x2, y2) => ({ name: "grey wall", trained: false, height: 0.3, footprint: box((x1 + x2) / 2, (y1 + y2) / 2, y2 - y1, x2 - x1) });

/** A room of 4 m by 3 m. */
export const ROOM = {
  format: 1, seed: 7,
  camera: { model: "pixy2", width: 316, height: 208, fx: 273.6, fy: 273.6, cx: 157.5, cy: 103.5, k1: 0,
    mount: { x: 0.05, y: 0, z: 0.12, yaw: 0, pitch: 0 }, latency: 0.05, rate: 20, max_blobs: 16 },
  robot: { width: 0.2 },
  signatures: [{ id: 1, name: "red", rgb: "d02020" }, { id: 2, name: "yellow", rgb: "d8c020" }, { id: 3, name: "green", rgb: "20a040" }, { id: 4, name: "blue", rgb: "2040c0" }],
  objects: [
    { name: "red box", signature: 1, height: 0.14, footprint: box(1.45, 0.05, 0.26, 0.16, 0.1) },
    { name: "yellow can", signature: 2, height: 0.16, footprint: can(1.0, 0.75, 0.05) },
    { name: "green can", signature: 3, height: 0.16, footprint: can(1.9, -0.7, 0.05) },
    { name: "yellow can", signature: 2, height: 0.16, footprint: can(0.5, -0.85, 0.05) },
    { name: "blue wall", signature: 4, height: 0.2, footprint: box(2.7, 0.55, 0.7, 0.05) },
    { name: "green box", signature: 3, height: 0.12, footprint: box(2.75, -0.75, 0.2, 0.2, 0.5) },
    grey(-0.65, -1.5, 3.45, -1.45), grey(-0.65, 1.45, 3.45, 1.5), grey(-0.65, -1.45, -0.6, 1.45), grey(3.4, -1.45, 3.45, 1.45),
  ],
  noise: { edge_px: 0.5 },
};

/** Things to add: a footprint at (x, y), and a height. */
export const KINDS = {
  box: { height: 0.14, at: (x, y) => box(x, y, 0.2, 0.15) },
  can: { height: 0.16, at: (x, y) => can(x, y, 0.05) },
  wall: { height: 0.2, at: (x, y) => box(x, y, 0.6, 0.05) },
};

/** The same footprint, so far from where it was. */
export function shifted(footprint, dx, dy) {
  if (footprint.circle) return { circle: [round(footprint.circle[0] + dx), round(footprint.circle[1] + dy), footprint.circle[2]] };
  return { ...footprint, coordinates: footprint.coordinates.map((ring) => ring.map(([x, y]) => [round(x + dx), round(y + dy)])) };
}

/** The middle of a footprint's corners. */
export function middleOf({ circle, coordinates }) {
  if (circle) return circle.slice(0, 2);
  const corners = coordinates[0].slice(0, -1);
  return [0, 1].map((axis) => corners.reduce((sum, corner) => sum + corner[axis], 0) / corners.length);
}

/** `object`, turned on its place, rad to the left. */
export function turnedBy(object, angle) {
  const { footprint } = object;
  if (footprint.circle) return object;
  const [mx, my] = middleOf(footprint);
  const [c, s] = [Math.cos(angle), Math.sin(angle)];
  const turned = ([x, y]) => [round(mx + c * (x - mx) - s * (y - my)), round(my + s * (x - mx) + c * (y - my))];
  return { ...object, footprint: { ...footprint, coordinates: footprint.coordinates.map((ring) => ring.map(turned)) } };
}

/** `object`, elsewhere; one that moves takes its way along. */
export function movedBy(object, dx, dy) {
  const path = object.path && { ...object.path, poses: object.path.poses.map((pose) => ({ ...pose, x: pose.x + dx, y: pose.y + dy })) };
  return { ...object, footprint: shifted(object.footprint, dx, dy), ...(path ? { path } : {}) };
}

/** Where the room is after switches: what of the robot is not as it takes it to be, and how bad its camera is. */
export function withErrors(scene, { noise, lens, tilt, slip }) {
  const camera = { ...scene.camera, mount: { ...scene.camera.mount, z: Math.max(0.01, (scene.camera.mount?.z ?? 0) + lens) } };
  const bad = { ...scene.noise };
  if (noise !== null) Object.assign(bad, { edge_px: noise, loss_probability: noise / 20, miss_probability: noise / 20, false_rate: noise / 20 });
  if (tilt !== null) bad.pitch_error = tilt;
  if (slip !== null) Object.assign(bad, { drift_scale: slip, ...(scene.odometry ? {} : { drift_turn: slip }) });
  return { ...scene, camera, noise: bad };
}
