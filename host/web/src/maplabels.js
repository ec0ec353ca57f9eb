// Marks and names on the top view.
import { label } from "./canvas.js";
import { colourOf, drawMark, markOf } from "./colours.js";
import { fitted, Labels } from "./labels.js";
import { bodyOf, centreOf, isDoubtful, nameOf, outlineOf, placed as placedAt } from "./scene.js";

const sansSerif = (weight, size = 13) => `${weight} ${size}px system-ui, sans-serif`;
const SHARE = 0.6;  // of the width, the longest name

function extent(points) {
  const range = (axis) => [Math.min(...points.map((p) => p[axis])), Math.max(...points.map((p) => p[axis]))];
  const [[u1, u2], [v1, v2]] = [range(0), range(1)];
  return [u1, v1, u2, v2];
}

// A large outline's name is beside the mark in its middle.
function placeOf(window, object) {
  const [u, v] = window.toPage(centreOf(object));
  const [u1, v1, u2, v2] = extent(outlineOf(object).map((p) => window.toPage(p)));
  const wide = u2 - u1 > 110;
  const tall = v2 - v1 > 110;
  return { at: [u, v], box: [wide ? u - 9 : u1, tall ? v - 9 : v1, wide ? u + 9 : u2, tall ? v + 9 : v2] };
}

const isShown = ({ width, height }, [u1, v1, u2, v2]) => u2 > 0 && u1 < width && v2 > 0 && v1 < height;

function objectLabels({ g, window, ink, theme, selected }, labels, placed) {
  const items = placed.map(({ object, ...place }) => ({ ...place, object, key: object.id, font: sansSerif(object.state === "confirmed" ? "600" : "italic") }));
  g.font = sansSerif("600");
  const names = fitted(items.map(({ object }) => nameOf(object)), (text) => g.measureText(text).width < SHARE * window.width);
  items.forEach(({ object, ...item }, i) => labels.add({ ...item, texts: [names[i], String(object.id)],
    ink: object.id === selected ? ink.accent : ink.ink, colour: colourOf(object.rgb, object.signature, theme) }));
}

/** Marks, then names, most seen objects first. `axes`: places of numbers; they are `placed` of the canvas then. */
export function drawLabels(all) {
  const { canvas, g, window, ink, view, theme } = all;
  const objects = view.result.objects.filter((o) => centreOf(o)).sort((a, b) => (a.state === "tentative") - (b.state === "tentative") || b.views - a.views);
  const placed = objects.map((object) => ({ object, ...placeOf(window, object) }));
  const labels = new Labels(g, window.width, window.height, all.memory);
  for (const { object, at: [u, v], box } of placed) {
    const size = Math.min(7, Math.max(2.5, (box[2] - box[0]) / 4));
    g.fillStyle = colourOf(object.rgb, object.signature, theme);
    if (isDoubtful(object)) {
      g.font = sansSerif("700");
      g.textAlign = "center";
      g.textBaseline = "middle";
      label(g, "?", u, v, g.fillStyle, ink.paper);
    } else {
      drawMark(g, markOf(object.signature), u, v, size);
    }
    labels.mark(box);
  }
  if (view.pose) labels.mark(extent(bodyOf(view.page.settings).ring.map((p) => window.toPage(placedAt(view.pose, p)))));
  if (view.layers.has("labels")) {
    for (const box of all.axes) labels.block(box);
    objectLabels(all, labels, placed.filter(({ box }) => isShown(window, box)));
    labels.draw(ink.paper);
  }
  canvas.placed = labels.placed;
}
