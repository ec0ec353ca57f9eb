// Which part of the map the page shows, and what is under the pointer.
import { centreOf, outlineOf } from "./scene.js";

/** Map to page: metres to pixels, with y to the left of the page as the world has it when x goes right. */
export class Window {
  constructor() { this.x = 0; this.y = 0; this.scale = 100; }
  size(width, height) { this.width = width; this.height = height; }
  toPage([x, y]) { return [this.width / 2 + (x - this.x) * this.scale, this.height / 2 - (y - this.y) * this.scale]; }
  toMap([u, v]) { return [this.x + (u - this.width / 2) / this.scale, this.y - (v - this.height / 2) / this.scale]; }
  fit(points, margin = 46) {
    if (points.length === 0) points = [[-1, -1], [1, 1]];
    const range = (axis) => points.reduce(([a, b], p) => [Math.min(a, p[axis]), Math.max(b, p[axis])], [Infinity, -Infinity]);
    const [x1, x2] = range(0);
    const [y1, y2] = range(1);
    this.x = (x1 + x2) / 2;
    this.y = (y1 + y2) / 2;
    const room = (size) => Math.max(40, size - 2 * margin);
    this.scale = Math.min(room(this.width) / Math.max(0.5, x2 - x1), room(this.height) / Math.max(0.5, y2 - y1), 600);
  }
  zoom(factor, at = [this.width / 2, this.height / 2]) {
    const [x, y] = this.toMap(at);
    this.scale = Math.min(20000, Math.max(0.5, this.scale * factor));
    const [x2, y2] = this.toMap(at);
    this.x += x - x2;
    this.y += y - y2;
  }
}

/** All that a first picture should show. `ahead`: floor before a robot that drives now. */
export function extentOf(view) {
  const points = [];
  for (let i = 0; i < view.path.length; i += 4) points.push([view.path[i + 1], view.path[i + 2]]);
  for (const object of view.result.objects) points.push(...(object.state === "tentative" ? [] : outlineOf(object) ?? []));
  for (const object of view.truth) points.push(...object.ring);
  points.push(...view.ahead ?? []);
  return points;
}

export const inside = (ring, [x, y]) => ring.reduce((is, [xi, yi], i) => {
  const [xj, yj] = ring[(i || ring.length) - 1];
  return (yi > y) !== (yj > y) && x < (xj - xi) * (y - yi) / (yj - yi) + xi ? !is : is;
}, false);

/** The true thing at a place of the page, or undefined. */
export const truthAt = (window, truth, at) => truth.findLast(({ ring }) => inside(ring, window.toMap(at)));

/** The object at a place of the page, or null. */
export function objectAt(window, objects, at) {
  const p = window.toMap(at);
  const near = (object) => {
    const centre = centreOf(object);
    if (!centre) return Infinity;
    if (inside(outlineOf(object), p)) return 0;
    return Math.hypot(centre[0] - p[0], centre[1] - p[1]) * window.scale;
  };
  const best = objects.map((object) => [near(object), object]).sort((a, b) => a[0] - b[0])[0];
  return best && best[0] < 12 ? best[1] : null;
}
