// The user's choice of the map's layers, and of the models whose outlines it shows.
import { make } from "./dom.js";
import { language, t } from "./words.js";

export const LAYERS = { truth: "layerTruth", path: "layerPath", zones: "layerZones", wedge: "layerCamera", guard: "layerGuard", labels: "layerLabels" };
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
  const offered = [language(), ...names].join();
  if (list.dataset.offered === offered) return;
  list.dataset.offered = offered;
  const box = (text, checked, change) => make("label", {}, make("input", { type: "checkbox", checked, onchange: (e) => { change(e.target.checked); redraw(); } }), ` ${text}`);
  const pick = (set, name) => (on) => { if (on) set.add(name); else set.delete(name); };
  list.replaceChildren(
    ...Object.entries(LAYERS).map(([name, words]) => box(t(words), state.layers.has(name), pick(state.layers, name))),
    make("b", {}, t("models")),
    ...[...names].map((name) => box(name, state.models.includes(name), (on) => {
      state.models = on ? [...state.models, name] : state.models.filter((m) => m !== name);
    })));
}
