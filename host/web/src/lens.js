// Points of the map as the robot's camera sees them, and boxes around outlines. See host/share/doc/frames.md.
import { outlineOf, placed } from "./scene.js";

const NEAREST = 0.02;  // m ahead of the lens

/** Into camera axes: ahead along the optical axis, left, up. */
function toCamera(camera, pose, [x, y], z) {
  const { mount } = camera;
  const [lensX, lensY] = placed(pose, [mount.x, mount.y]);
  const yaw = pose.heading + mount.yaw;
  const ahead = Math.cos(yaw) * (x - lensX) + Math.sin(yaw) * (y - lensY);
  const left = Math.cos(yaw) * (y - lensY) - Math.sin(yaw) * (x - lensX);
  const pitch = mount.pitch ?? 0;
  const up = z - mount.z;
  return [Math.cos(pitch) * ahead - Math.sin(pitch) * up, left, Math.cos(pitch) * up + Math.sin(pitch) * ahead];
}

/** Pixels of a direction in camera axes; null where the lens has no image of it. */
function toPixel(camera, [ahead, left, up]) {
  const across = Math.hypot(left, up);
  if (camera.lens === "equidistant") {
    const angle = Math.atan2(across, ahead);
    if (angle > 1.4) return null;
    const bent = angle * (1 + camera.k1 * angle * angle) / (across || 1);
    return [camera.cx - camera.fx * bent * left, camera.cy - camera.fy * bent * up];
  }
  if (ahead < NEAREST) return null;
  const [a, b] = [left / ahead, up / ahead];
  const bent = 1 + camera.k1 * (a * a + b * b);
  return [camera.cx - camera.fx * bent * a, camera.cy - camera.fy * bent * b];
}

/** Where the ring at height z appears: pixels, or null for corners that do not. */
export const ringInImage = (camera, pose, ring, z) => ring.map((p) => toPixel(camera, toCamera(camera, pose, p, z)));

/** The box around an outline from floor to top, as the camera should report it; null if a part is behind. */
export function boxOf(camera, pose, object) {
  const ring = outlineOf(object);
  if (!ring || object.state === "lost") return null;
  const corners = [object.base, object.z_max].flatMap((z) => ringInImage(camera, pose, ring, z));
  if (corners.some((c) => c === null)) return null;
  const range = (axis) => [Math.min(...corners.map((c) => c[axis])), Math.max(...corners.map((c) => c[axis]))];
  const [u1, u2] = range(0);
  const [v1, v2] = range(1);
  if (u2 < 0 || v2 < 0 || u1 > camera.width || v1 > camera.height) return null;
  return [u1, v1, u2, v2];
}

/** Half the angle that the image spans across, rad. */
export function halfAngle(camera) {
  const half = camera.width / 2 / camera.fx;
  return camera.lens === "equidistant" ? Math.min(half, 1.5) : Math.atan(half);
}
