// usage: node draw_test.mjs SOURCE: what the maps draw of an object by its confidence, on canvases that keep what is asked of them.
import assert from "node:assert/strict";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { run } from "./harness.mjs";

const source = (name) => import(pathToFileURL(join(process.argv[2], name)));
const { drawMap } = await source("map2d.js");
const { drawSolid } = await source("map3d.js");
const { Behind, Eye, Orbit } = await source("viewpoint.js");
const { facesOf, inOrder, shadowOf, solidOf } = await source("solids.js");
const { Window } = await source("window.js");
globalThis.window = { devicePixelRatio: 1 };

/** A canvas, and what was filled, stroked and written on it: { what, corners, alpha, text }. */
function recorded() {
  const done = [];
  let corners = 0;
  const g = { globalAlpha: 1, measureText: (text) => ({ width: 7 * text.length }), canvas: null };
  for (const name of ["setTransform", "clearRect", "fillRect", "setLineDash", "save", "restore", "clip", "closePath"]) g[name] = () => {};
  g.beginPath = () => { corners = 0; };
  for (const name of ["moveTo", "lineTo", "arc", "rect"]) g[name] = () => { ++corners; };
  for (const what of ["fill", "stroke"]) g[what] = () => done.push({ what, corners, alpha: g.globalAlpha, colour: g[`${what}Style`] });
  g.fillText = (text) => done.push({ what: "text", text });
  g.strokeText = () => {};
  return { canvas: { clientWidth: 600, clientHeight: 400, getContext: () => g }, done };
}

const CORNERS = 7;
const COLOUR = { red: "#c24a00" };  // of the object on the page by day
const ring = Array.from({ length: CORNERS }, (_, i) => [1 + 0.2 * Math.cos(i * 2 * Math.PI / CORNERS), 0.2 * Math.sin(i * 2 * Math.PI / CORNERS)]);
const ink = new Proxy({}, { get: (_, name) => `--${String(name)}` });

function lookAt(confidence) {
  const object = { id: 1, name: "red", rgb: "d02020", signature: 1, state: "confirmed", views: 9, confidence, base: 0, z_max: 0.2,
    models: { hybrid: { geometry: { type: "Polygon", coordinates: [[...ring, ring[0]]] } } } };
  return { t: 0, pose: null, truth: [], layers: new Set(["labels"]), models: ["hybrid"], path: new Float64Array(),
    page: { settings: {} }, result: { objects: [object], guard: [], camera: null } };
}

function flat(confidence) {
  const { canvas, done } = recorded();
  drawMap(canvas, new Window(), { view: lookAt(confidence), whole: [], ink, theme: "light", selected: null, memory: new Map() });
  return done;
}

function solid(confidence, eye = new Orbit(), more = {}) {
  const { canvas, done } = recorded();
  eye.size(600, 400);
  drawSolid(canvas, eye, { view: { ...lookAt(confidence), ...more }, ink, theme: "light", selected: null, memory: new Map() });
  return done;
}

const box = (name, x1, y1, x2, y2, low = 0, high = 0.2) => solidOf([[x1, y1], [x2, y1], [x2, y2], [x1, y2], [x1, y1]], low, high, { name });
const orderOf = (solids, eye) => inOrder(solids, eye).map(({ name }) => name).join(" ");
/** Share of a ring's area by its corners. */
const areaOf = (corners) => Math.abs(corners.reduce((sum, [x, y], i) => sum + x * corners[(i + 1) % corners.length][1] - y * corners[(i + 1) % corners.length][0], 0)) / 2;

const outlines = (done, what) => done.filter((d) => d.what === what && d.corners === CORNERS + 1 && d.colour === COLOUR.red);
const faces = (done) => done.filter((d) => d.what === "fill" && String(d.colour).startsWith("rgb("));
const marks = (done) => done.filter((d) => d.text === "?").length;

await run({
  async "the surer, the more solid, from above and in 3-D"() {
    const alphas = (draw, of) => [0.15, 0.4, 0.7].map((confidence) => of(draw(confidence)));
    for (const series of [alphas(flat, (done) => outlines(done, "stroke")[0].alpha), alphas(flat, (done) => outlines(done, "fill")[0].alpha),
      alphas(solid, (done) => faces(done)[0].alpha)]) {
      assert.ok(series[0] < series[1] && series[1] < series[2] && series[2] <= 1, series.join());
    }
    assert.equal(marks(flat(0.15)), 0);
  },
  async "what stands before another thing is drawn after it, also before the far end of a wall"() {
    const wall = box("wall", 1, -3, 1.1, 3);
    const [near, behind] = [box("near", 0.7, 2.6, 0.9, 2.8), box("behind", 1.3, -0.1, 1.5, 0.1)];
    for (const solids of [[wall, near, behind], [behind, near, wall]]) {
      assert.equal(orderOf(solids, [-1, 0, 0.5]), "behind wall near");
      assert.equal(orderOf(solids, [3, 0, 0.5]), "near wall behind");
    }
    assert.equal(orderOf([box("lid", 0, 0, 1, 1, 0.2, 0.3), box("body", 0, 0, 1, 1, 0, 0.2)], [-1, 0, 1]), "body lid");
    // Each hides a part of the next one: there is an order all the same.
    const ring = [box("a", 0, 0, 2, 0.1), box("b", 1.9, 0.2, 2, 2), box("c", 0, 0.3, 1.8, 0.4)];
    assert.equal(orderOf(ring, [-1, -1, 1]).split(" ").sort().join(""), "abc");
  },

  async "only sides towards the eye are drawn, lit by where they look; a shadow lies beside its solid, a floating one's apart"() {
    const cube = box("cube", 0, 0, 1, 1, 0, 1);
    const seen = facesOf(cube, [-3, 0.5, 0.5]);
    assert.deepEqual(seen.map(({ points }) => points.every(([[x]]) => x === 0)), [true]);
    const all = facesOf(cube, [-3, -3, 4]);
    assert.equal(all.length, 3);
    assert.ok(all.at(-1).top && new Set(all.map(({ light }) => light)).size === 3);
    const floor = areaOf(shadowOf(cube));
    assert.ok(floor > 1.5 && floor < 2.2, `${floor} m2: the cube's own floor and what it darkens beside it`);
    assert.ok(shadowOf(box("shelf", 0, 0, 1, 1, 2, 2.1)).every(([x]) => x > 0.5));
    assert.equal(shadowOf(cube).length, 6);
  },

  async "from behind the robot is before the eye and what is ahead of it above; its own eye sees the camera's picture, and not the robot"() {
    const camera = { width: 316, height: 208, fx: 273.6, fy: 273.6, cx: 157.5, cy: 103.5, k1: 0, lens: 0, mount: { x: 0.05, y: 0, z: 0.12, yaw: 0, pitch: 0.1 } };
    const pose = { t: 1, x: 2, y: 1, heading: Math.PI / 2 };
    const path = Float64Array.of(0, 2, 0, Math.PI / 2, 1, 2, 1, Math.PI / 2);
    const more = { pose, path, t: 1, result: { ...lookAt(0.5).result, camera } };
    const [behind, eye] = [new Behind(), new Eye()];
    const robots = (done) => done.filter(({ colour }) => colour === "rgb(59 67 75)" || /^rgb\(9\d 1\d\d 1\d\d\)$/.test(colour)).length;
    assert.ok(robots(solid(0.5, behind, more)) > 0);
    const place = (of, x, y, z) => of.project(of.axes([x, y], z));
    const [u, v] = place(behind, 2, 1, 0);
    assert.ok(Math.abs(u - 300) < 1e-6 && v > 200);
    assert.ok(place(behind, 2, 2, 0)[1] < v && place(behind, 2.3, 1, 0)[0] > u, "its right is on the right");
    assert.equal(robots(solid(0.5, eye, more)), 0);
    // A point 0.5 m ahead of the lens on its axis, which looks down by 0.1 rad, is at the picture's middle.
    const middle = place(eye, 2, 1 + 0.05 + 0.5 * Math.cos(0.1), 0.12 - 0.5 * Math.sin(0.1));
    const [left, top, right, bottom] = eye.image;
    const scale = (right - left) / camera.width;
    assert.ok(Math.hypot(middle[0] - left - scale * 157.5, middle[1] - top - scale * 103.5) < 1e-6, middle.join());
    assert.ok(Math.abs((bottom - top) / scale - 208) < 1e-9 && top > 0 && left > 0);
    // 20 px to the left in the picture.
    const aside = place(eye, 2 - 0.5 * 20 / 273.6, 1 + 0.05 + 0.5 * Math.cos(0.1), 0.12 - 0.5 * Math.sin(0.1));
    assert.ok(Math.abs(middle[0] - aside[0] - 20 * scale) < 1e-6);
    assert.equal(eye.place({ pose: null, path, t: 1, result: { camera } }), undefined);
    assert.equal(eye.image, null, "without a pose there is no picture");
  },

  async "below 0.1 there is a faint outline and a question mark, no area and no solid"() {
    for (const confidence of [0.09, 0, null]) {
      const done = flat(confidence);
      assert.equal(outlines(done, "fill").length, 0);
      assert.ok(outlines(done, "stroke")[0].alpha < 0.35);
      assert.equal(marks(done), 1);
      assert.equal(faces(solid(confidence)).length, 0);
    }
    assert.equal(outlines(flat(0.1), "fill").length, 1);
    assert.ok(faces(solid(0.1)).length > CORNERS / 2, "the sides towards the eye, and the top");
  },
}, process.argv[3]);
