// What the map shows, by choice: layers, and the outlines of which models.
import { make } from "./dom.js";

export const LAYERS = { truth: "truth", path: "path", zones: "alert zones", wedge: "camera", guard: "guard's points", labels: "names" };
/** Those that are shown first: the guard's points hide what they stand on. */
export const FIRST = Object.keys(LAYERS).filter((name) => name !== "guard");

/** The legend has what the map shows: each line of a layer, and of the truth where there is one. */
export function showLegend(list, { layers, truth }) {
  for (const line of list.querySelectorAll("[data-layer]")) {
    const { layer } = line.dataset;
    line.hidden = !layers.has(layer) || (layer === "truth" && truth.length === 0);
  }
}

/** Boxes to tick in `list`: the layers, and the models that `result` has. */
export function offerLayers(list, { state, result, redraw }) {
  const names = new Set(["hybrid", ...result.objects.flatMap((object) => Object.keys(object.models))]);
  const offered = [...names].join();
  if (list.dataset.offered === offered) return;
  list.dataset.offered = offered;
  const box = (text, checked, change) => make("label", {}, make("input", { type: "checkbox", checked, onchange: (e) => { change(e.target.checked); redraw(); } }), ` ${text}`);
  const pick = (set, name) => (on) => { if (on) set.add(name); else set.delete(name); };
  list.replaceChildren(
    ...Object.entries(LAYERS).map(([name, text]) => box(text, state.layers.has(name), pick(state.layers, name))),
    make("b", {}, "models"),
    ...[...names].map((name) => box(name, state.models.includes(name), (on) => {
      state.models = on ? [...state.models, name] : state.models.filter((m) => m !== name);
    })));
}
