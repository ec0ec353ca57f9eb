// Where 3-D is looked at from: around a point of the floor, from behind the robot, or through its camera.
import { halfAngle } from "./lens.js";
import { placed, poseAt } from "./scene.js";

export const NEAR = 0.05;    // m: what is nearer to the eye is cut off
const CALM = [0, 0.15, 0.3, 0.45];  // s ago: the view from behind turns by the mean of these headings
const EDGE = 0.94;           // share of the map that the camera's image takes
const clamp = (low, value, high) => Math.min(high, Math.max(low, value));

/** Goes around (x, y, z) at `distance`. `turn`, `tilt`: where it looks, rad; the tilt is downwards. `alongside`: it goes with the robot. */
export class Orbit {
  constructor() { Object.assign(this, { turn: -0.6, tilt: 0.6, distance: 3, x: 0, y: 0, z: 0, middle: 0.52, alongside: false }); }
  size(width, height) {
    Object.assign(this, { width, height, focal: 1.1 * Math.min(width, height * 1.5), across: width / 2, down: height * this.middle });
  }
  fit(points) {
    if (points.length === 0) return;
    const range = (axis) => points.reduce(([a, b], p) => [Math.min(a, p[axis]), Math.max(b, p[axis])], [Infinity, -Infinity]);
    const [x1, x2] = range(0);
    const [y1, y2] = range(1);
    this.x = (x1 + x2) / 2;
    this.y = (y1 + y2) / 2;
    this.distance = 0.4 + 0.95 * Math.hypot(x2 - x1, y2 - y1) * Math.max(1, 0.75 * this.height / this.width);
  }
  /** Where it is for a view. */
  place() {}
  zoom(factor) { this.distance = clamp(0.2, this.distance / factor, 200); }
  drag(du, dv) {
    this.turn -= du * 0.006;
    this.tilt = clamp(0.12, this.tilt + dv * 0.006, 1.5);
  }
  /** Its own place: x, y, height. */
  get eye() {
    const back = this.distance * Math.cos(this.tilt);
    return [this.x - back * Math.cos(this.turn), this.y - back * Math.sin(this.turn), this.z + this.distance * Math.sin(this.tilt)];
  }
  /** Depth along the axis, then right and up of it. */
  axes([x, y], height) {
    const [c, s] = [Math.cos(this.turn), Math.sin(this.turn)];
    const [ct, st] = [Math.cos(this.tilt), Math.sin(this.tilt)];
    const ahead = c * (x - this.x) + s * (y - this.y);
    const right = s * (x - this.x) - c * (y - this.y);
    const z = height - this.z;
    return [this.distance + ct * ahead - st * z, right, st * ahead + ct * z];
  }
  project([depth, right, up]) {
    const f = this.focal / depth;
    return [this.across + f * right, this.down - f * up];
  }
}

/** From behind the robot and above it. */
export class Behind extends Orbit {
  constructor() { super(); this.fit(); Object.assign(this, { middle: 0.62, alongside: true }); }
  fit() { Object.assign(this, { aside: 0, tilt: 0.38, distance: 1.3 }); }
  drag(du, dv) {
    this.aside -= du * 0.006;
    super.drag(0, dv);
  }
  place({ pose, path, t }) {
    if (!pose) return;
    const headings = CALM.map((ago) => poseAt(path, t - ago)?.heading ?? pose.heading);
    const mean = (of) => headings.reduce((sum, heading) => sum + of(heading), 0);
    Object.assign(this, { x: pose.x, y: pose.y, turn: Math.atan2(mean(Math.sin), mean(Math.cos)) + this.aside });
  }
}

/** The robot's camera. `image`: the border of its picture on the page: left, top, right, bottom. */
export class Eye extends Orbit {
  constructor() { super(); this.fit(); this.alongside = true; }
  fit() { this.distance = 0; this.closer = 1; }
  zoom(factor) { this.closer = clamp(0.3, this.closer * factor, 4); }
  drag() { /* it looks where the camera does */ }
  place({ pose, result: { camera } }) {
    this.image = null;
    if (!pose || !camera) return;
    const { mount } = camera;
    const [x, y] = placed(pose, [mount.x, mount.y]);
    Object.assign(this, { x, y, z: mount.z, turn: pose.heading + mount.yaw, tilt: mount.pitch ?? 0 });
    // A fisheye's picture is drawn as a straight lens has it, as wide as that can be.
    const focal = camera.lens ? camera.width / 2 / Math.tan(Math.min(halfAngle(camera), 1.1)) : camera.fx;
    const scale = this.closer * EDGE * Math.min(this.width / camera.width, this.height / camera.height);
    const [left, top] = [(this.width - scale * camera.width) / 2, (this.height - scale * camera.height) / 2];
    Object.assign(this, { focal: scale * focal, across: left + scale * camera.cx, down: top + scale * camera.cy });
    this.image = [left, top, left + scale * camera.width, top + scale * camera.height];
  }
}
