// usage: node draw_test.mjs SOURCE: what the maps draw of an object by its confidence, on canvases that keep what is asked of them.
import assert from "node:assert/strict";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { run } from "./harness.mjs";

const source = (name) => import(pathToFileURL(join(process.argv[2], name)));
const { drawMap } = await source("map2d.js");
const { Orbit, drawSolid } = await source("map3d.js");
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

function solid(confidence) {
  const { canvas, done } = recorded();
  const orbit = new Orbit();
  orbit.size(600, 400);
  drawSolid(canvas, orbit, { view: lookAt(confidence), ink, theme: "light", selected: null, memory: new Map() });
  return done;
}

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
  async "below 0.1 there is a faint outline and a question mark, no area and no solid"() {
    for (const confidence of [0.09, 0, null]) {
      const done = flat(confidence);
      assert.equal(outlines(done, "fill").length, 0);
      assert.ok(outlines(done, "stroke")[0].alpha < 0.35);
      assert.equal(marks(done), 1);
      assert.equal(faces(solid(confidence)).length, 0);
    }
    assert.equal(outlines(flat(0.1), "fill").length, 1);
    assert.ok(faces(solid(0.1)).length > CORNERS);
  },
}, process.argv[3]);
