// Upright solids: their faces in the light, their shadows on the floor, and which of two hides the other.

export const SUN = [0.42, -0.36];  // where the shadow of a top falls, m for each metre of height
const SHARP = 0.8;                 // cosine of the bend at an edge that is drawn as one

const closed = (ring) => ring.length > 1 && ring[0][0] === ring.at(-1)[0] && ring[0][1] === ring.at(-1)[1];
const cross = (o, a, b) => (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);

/** The convex hull, to the left. */
export function hullOf(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1]);
  const half = (all) => all.reduce((chain, p) => {
    while (chain.length > 1 && cross(chain.at(-2), chain.at(-1), p) <= 0) chain.pop();
    chain.push(p);
    return chain;
  }, []).slice(0, -1);
  return [...half(sorted), ...half(sorted.reverse())];
}

/** `ring`: its corners from above; `low`, `high`: m above the floor. `more` is kept with it. */
export function solidOf(ring, low, high, more) {
  let corners = closed(ring) ? ring.slice(0, -1) : [...ring];
  const area = corners.reduce((sum, p, i) => sum + cross([0, 0], p, corners[(i + 1) % corners.length]), 0);
  if (area < 0) corners = corners.reverse();
  const middle = [0, 1].map((axis) => corners.reduce((sum, p) => sum + p[axis], 0) / corners.length);
  const radius = Math.max(...corners.map((p) => Math.hypot(p[0] - middle[0], p[1] - middle[1])));
  return { ...more, corners, low, high, middle, radius };
}

const shifted = (corners, height) => corners.map(([x, y]) => [x + SUN[0] * height, y + SUN[1] * height]);
export const shadowOf = ({ corners, low, high }) => hullOf([...shifted(corners, low), ...shifted(corners, high)]);

/** Those sides that `eye` sees, from far to near, and the top: { points: [[place, height]], light, sharp }. `sharp`: its first edge is one. */
export function facesOf({ corners, low, high }, eye) {
  const sun = Math.hypot(...SUN);
  const ways = corners.map((p, i) => {
    const q = corners[(i + 1) % corners.length];
    const length = Math.hypot(q[0] - p[0], q[1] - p[1]) || 1;
    return [(q[0] - p[0]) / length, (q[1] - p[1]) / length];
  });
  const far = (p) => Math.hypot(p[0] - eye[0], p[1] - eye[1]);
  const sides = corners.map((p, i) => {
    const q = corners[(i + 1) % corners.length];
    const [dx, dy] = ways[i];
    const before = ways[(i || ways.length) - 1];
    const lit = Math.max(0, -(dy * SUN[0] - dx * SUN[1]) / sun);
    return { points: [[p, low], [q, low], [q, high], [p, high]], light: 0.66 + 0.3 * lit, sharp: dx * before[0] + dy * before[1] < SHARP,
      seen: dy * (eye[0] - p[0]) - dx * (eye[1] - p[1]) > 0, far: far(p) + far(q) };
  }).filter(({ seen }) => seen).sort((a, b) => b.far - a.far);
  if (eye[2] > high) sides.push({ points: corners.map((p) => [p, high]), light: 1.08, sharp: false, top: true });
  return sides;
}

// An edge of `a` with all of `b` beyond: on which side of it the eye is. 0: there is none.
function beyondEdge(a, b, eye) {
  for (let i = 0; i < a.corners.length; ++i) {
    const [p, q] = [a.corners[i], a.corners[(i + 1) % a.corners.length]];
    if (b.corners.every((corner) => cross(p, q, corner) <= 0)) return cross(p, q, eye) < 0 ? 1 : -1;
  }
  return 0;
}

/** Above 0: `b` may hide a part of `a`, for `eye`. */
export function inFront(a, b, eye) {
  const [dx, dy] = [b.middle[0] - a.middle[0], b.middle[1] - a.middle[1]];
  const apart = Math.hypot(dx, dy);
  if (apart > a.radius + b.radius) {
    const along = ((eye[0] - a.middle[0]) * dx + (eye[1] - a.middle[1]) * dy) / apart;
    return along - (a.radius + apart - b.radius) / 2;
  }
  const side = beyondEdge(a, b, eye) || -beyondEdge(b, a, eye);
  if (side) return side;
  // They overlap on the floor: the upper one, then the one that is glass, is the later.
  if (b.low >= a.high) return 1;
  if (a.low >= b.high) return -1;
  if (Boolean(a.glass) !== Boolean(b.glass)) return b.glass ? 1 : -1;
  const far = ({ middle }) => Math.hypot(middle[0] - eye[0], middle[1] - eye[1]);
  return far(a) - far(b);
}

const turned = (angle) => Math.atan2(Math.sin(angle), Math.cos(angle));

// From where to where it is seen, by its middle's bearing from the eye, rad.
function spanOf({ corners, middle }, eye) {
  const at = Math.atan2(middle[1] - eye[1], middle[0] - eye[0]);
  const asides = corners.map(([x, y]) => turned(Math.atan2(y - eye[1], x - eye[0]) - at));
  return { at, low: Math.min(...asides), high: Math.max(...asides) };
}

// Seen in other directions, neither hides the other.
function overlap(a, b) {
  const aside = turned(b.at - a.at);
  return aside + b.low <= a.high && aside + b.high >= a.low;
}

/** From those that hide nothing to those that nothing hides. */
export function inOrder(solids, eye) {
  const spans = new Map(solids.map((solid) => [solid, spanOf(solid, eye)]));
  const far = ({ middle }) => Math.hypot(middle[0] - eye[0], middle[1] - eye[1]);
  const rest = [...solids].sort((a, b) => far(b) - far(a));
  const hidden = new Map(rest.map((solid) => [solid, new Set()]));  // by those
  rest.forEach((a, i) => rest.slice(i + 1).forEach((b) => {
    if (!overlap(spans.get(a), spans.get(b))) return;
    if (inFront(a, b, eye) > 0) hidden.get(b).add(a); else hidden.get(a).add(b);
  }));
  const order = [];
  while (rest.length) {
    // Three may hide each other in a ring: then the farthest is first.
    const at = Math.max(0, rest.findIndex((solid) => hidden.get(solid).size === 0));
    const [solid] = rest.splice(at, 1);
    order.push(solid);
    for (const waiting of hidden.values()) waiting.delete(solid);
  }
  return order;
}
