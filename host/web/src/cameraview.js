// The image plane: the boxes that the camera sent, and where the map says they should be.
import { prepare } from "./canvas.js";
import { colourOf, drawMark, markOf } from "./colours.js";
import { fitted, Labels } from "./labels.js";
import { boxOf, ringInImage } from "./lens.js";
import { isDoubtful, nameOf, outlineOf, poseAt } from "./scene.js";
import { t } from "./words.js";

function drawSolid(g, camera, pose, object, scale, colour) {
  const ring = outlineOf(object);
  const [low, high] = [object.base, object.z_max].map((z) => ringInImage(camera, pose, ring, z));
  if ([...low, ...high].some((p) => p === null)) return;
  g.strokeStyle = colour;
  g.globalAlpha = 0.6;
  g.lineWidth = 1;
  g.beginPath();
  for (const corners of [low, high]) corners.forEach((p, i) => g[i ? "lineTo" : "moveTo"](p[0] * scale, p[1] * scale));
  g.stroke();
  g.globalAlpha = 1;
}

// An end at the image's border, or where another box is, may be that of a part only.
const seenWhole = (camera, u, others) => u > 1 && u < camera.width - 2 && !others.some(({ box }) => u >= box[0] - 2 && u <= box[2] + 2);

// Above its box, in it or below it; else wherever there is room.
function nameBoxes(g, { width, height, ink, memory }, named) {
  const font = "600 12px system-ui, sans-serif";
  g.font = font;
  const labels = new Labels(g, width, height, memory);
  const names = fitted(named.map(({ object, signature }) => object ? nameOf(object) : signature ?? t("noObject")), (text) => g.measureText(text).width < 0.6 * width);
  named.forEach(({ object, box, colour }, i) => {
    const w = g.measureText(names[i]).width + 4;
    const left = Math.max(0, Math.min(box[0], width - w));
    labels.add({ key: object?.id ?? -1 - i, texts: object ? [names[i], String(object.id)] : [names[i], "–"], box, colour, font, ink: ink.ink,
      at: [(box[0] + box[2]) / 2, (box[1] + box[3]) / 2], first: [[left, box[1] - 8], [left, box[1] + 9], [left, box[3] + 8]] });
  });
  labels.draw(ink.paper);
  return labels.placed;
}

/** Returns what there is to say about the picture. */
export function drawCamera(canvas, { view, ink, theme, selected, memory, picture }) {
  const { camera, objects, signatures } = view.result;
  const { frame } = view.page;
  const ratio = camera ? camera.height / camera.width : 0.65;
  canvas.style.aspectRatio = `${1 / ratio}`;
  canvas.style.maxWidth = `max(240px, ${(21 / ratio).toFixed(2)}vh)`;
  const { g, width, height } = prepare(canvas);
  g.fillStyle = theme === "dark" ? "#0a1016" : "#f6f8fa";
  g.fillRect(0, 0, width, height);
  g.strokeStyle = ink.rule;
  g.strokeRect(0.5, 0.5, width - 1, height - 1);
  if (picture) g.drawImage(picture.image, 0, 0, width, height);
  if (!camera) return t("noCameraYet");
  const scale = width / camera.width;
  if (picture?.cross) drawCross(g, picture.cross.map((px) => (px + 0.5) * scale), ink);
  const pose = frame && poseAt(view.path, frame.exposure);
  const rendered = new Map();
  if (pose) {
    if (!picture) drawHorizon(g, camera, width, scale, ink);
    for (const object of objects) {
      const box = boxOf(camera, pose, object);
      if (!box) continue;
      rendered.set(object.id, box);
      const colour = colourOf(object.rgb, object.signature, theme);
      if (!isDoubtful(object)) drawSolid(g, camera, pose, object, scale, colour);
      g.setLineDash([5, 4]);
      g.lineWidth = object.id === selected ? 2.5 : 1.4;
      g.strokeStyle = colour;
      g.strokeRect(box[0] * scale, box[1] * scale, (box[2] - box[0]) * scale, (box[3] - box[1]) * scale);
      g.setLineDash([]);
    }
  }
  const errors = [];
  const named = [];
  for (const { id, signature, box } of frame?.boxes ?? []) {
    const [u1, v1, u2, v2] = [box[0] - 0.5, box[1] - 0.5, box[2] + 0.5, box[3] + 0.5];
    const colour = colourOf(signatures.find((s) => s.id === signature)?.rgb, signature, theme);
    g.fillStyle = g.strokeStyle = colour;
    g.globalAlpha = 0.22;
    g.fillRect(u1 * scale, v1 * scale, (u2 - u1) * scale, (v2 - v1) * scale);
    g.globalAlpha = 1;
    g.lineWidth = 2;
    g.strokeRect(u1 * scale, v1 * scale, (u2 - u1) * scale, (v2 - v1) * scale);
    drawMark(g, markOf(signature), (u1 + u2) / 2 * scale, (v1 + v2) / 2 * scale, 4);
    named.push({ object: objects.find((o) => o.id === id), signature: picture && signatures.find((s) => s.id === signature)?.name, box: [u1, v1, u2, v2].map((value) => value * scale), colour });
    const ours = rendered.get(id);
    const others = frame.boxes.filter((other) => other.box !== box);
    if (ours && seenWhole(camera, box[0], others)) errors.push(Math.abs(ours[0] - u1));
    if (ours && seenWhole(camera, box[2], others)) errors.push(Math.abs(ours[2] - u2));
  }
  canvas.placed = nameBoxes(g, { width, height, ink, memory }, named);
  if (!frame) return t("noFrameYet");
  const mean = errors.length ? t("frameMean", { mean: (errors.reduce((a, b) => a + b) / errors.length).toFixed(1) }) : "";
  return t(frame.boxes.length === 1 ? "frameSaysOne" : "frameSays", { number: frame.number, time: frame.t.toFixed(2), model: camera.model, boxes: frame.boxes.length, mean });
}

function drawCross(g, [x, y], ink) {
  for (const [colour, width] of [[ink.paper, 4], [ink.ink, 2]]) {
    g.strokeStyle = colour;
    g.lineWidth = width;
    g.beginPath();
    for (const [dx, dy] of [[1, 0], [-1, 0], [0, 1], [0, -1]]) {
      g.moveTo(x + 4 * dx, y + 4 * dy);
      g.lineTo(x + 12 * dx, y + 12 * dy);
    }
    g.stroke();
  }
}

function drawHorizon(g, camera, width, scale, ink) {
  const v = (camera.cy - camera.fy * Math.tan(camera.mount.pitch ?? 0)) * scale;
  g.strokeStyle = ink.soft;
  g.lineWidth = 0.6;
  g.beginPath();
  g.moveTo(0, v);
  g.lineTo(width, v);
  g.stroke();
}
