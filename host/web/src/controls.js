// The user's actions: pointer, buttons, keys, files. `page` is what main.js offers.
import { byId, make, plain } from "./dom.js";
import { describe } from "./map2d.js";
import { listen } from "./pointer.js";
import { levelsAt } from "./scene.js";
import { timeAt } from "./timeline.js";
import { objectAt, truthAt } from "./window.js";
import { t } from "./words.js";

/** Buttons of the map's views, in their order. */
const VIEWS = ["top", "solid", "behind", "eye"];

/** The map, its buttons and the pointer. */
export function bindMap(page) {
  const { state, flat, eyes, redraw } = page;
  const map = byId("map");
  const tip = byId("tip");
  const eye = () => eyes[state.view] ?? flat;
  const look = (view) => {
    state.view = view;
    for (const one of VIEWS) byId(one).setAttribute("aria-pressed", String(one === view));
    tip.hidden = true;
    redraw();
  };
  listen(map, {
    grabbed: (at) => {
      const holder = state.view !== "top" ? null : page.grab(flat.toMap(at));
      return holder && { moved: (to) => { holder.moved(flat.toMap(to)); redraw(); }, dropped: () => { holder.dropped(); redraw(); } };
    },
    moved: (du, dv) => {
      if (state.view === "top") byId("follow").checked = false;
      if (state.view !== "top") eye().drag(du, dv);
      else { flat.x -= du / flat.scale; flat.y += dv / flat.scale; }
      redraw();
    },
    zoomed: (factor, at) => { eye().zoom(factor, at); redraw(); },
    pointed: (at) => {
      tip.hidden = !at || state.view !== "top";
      if (tip.hidden) return;
      const view = page.view();
      const object = objectAt(flat, state.look.result.objects, at);
      const alerts = state.live ? state.look.result.alerts : page.last()?.result.alerts ?? [];
      const [x, y] = flat.toMap(at);
      const thing = view.layers.has("truth") ? truthAt(flat, view.truth, at) : undefined;
      tip.textContent = object ? describe(object, view.pose, levelsAt(alerts, state.t).get(object.id)) : t("tipPoint", { x: x.toFixed(2), y: y.toFixed(2) });
      if (thing) tip.textContent += `\n${t("tipTruth", { name: plain(thing.name) })}`;
      tip.style.left = `${Math.max(0, Math.min(at[0] + 14, map.clientWidth - tip.offsetWidth))}px`;
      tip.style.top = `${at[1] + 18 + tip.offsetHeight > map.clientHeight ? Math.max(0, at[1] - tip.offsetHeight - 10) : at[1] + 18}px`;
    },
    clicked: (at) => {
      const object = state.view === "top" && objectAt(flat, state.look.result.objects, at);
      if (object) page.select(object.id);
    },
  });
  for (const view of VIEWS) byId(view).onclick = () => look(view);
  byId("zoom-in").onclick = () => { eye().zoom(1.3); redraw(); };
  byId("zoom-out").onclick = () => { eye().zoom(1 / 1.3); redraw(); };
  byId("fit").onclick = page.fit;
  byId("follow").onchange = redraw;
}

/** Actions of keys, wherever they are pressed. */
export function bindKeys({ state, play, stop, goTo, fit }) {
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.target.closest("select, summary, input:not([type=range])")) return;
    if (event.key === " " && event.target.closest("button")) return;
    const step = event.shiftKey ? 1 : 0.1;
    const actions = {
      " ": () => state.playing ? stop() : play(), ArrowLeft: () => { stop(); goTo(state.t - step); }, ArrowRight: () => { stop(); goTo(state.t + step); },
      Home: () => { stop(); goTo(state.begin); }, End: () => { stop(); goTo(state.end); }, "+": () => byId("zoom-in").click(), "-": () => byId("zoom-out").click(),
      0: fit, 3: () => byId(VIEWS[(VIEWS.indexOf(state.view) + 1) % VIEWS.length]).click(),
    };
    const action = actions[event.key];
    if (!action || (state.live && /^( |Arrow|Home|End)/.test(event.key))) return;
    event.preventDefault();
    action();
  });
}

export function bindTransport({ state, play, stop, goTo }) {
  byId("play").onclick = () => state.playing ? stop() : play();
  byId("slider").oninput = (event) => { stop(); goTo(Number(event.target.value)); };
  byId("timeline").onclick = (event) => { stop(); goTo(timeAt(byId("timeline"), event.offsetX, state.begin, state.end)); };
}

/** Files that are chosen or dropped, and the recordings in the page. */
export function bindFiles(recordings, { openFiles, openRecording }) {
  byId("files").onchange = (event) => { openFiles([...event.target.files]).finally(() => { event.target.value = ""; }); };
  const drop = byId("drop");
  document.addEventListener("dragover", (event) => { event.preventDefault(); drop.hidden = false; });
  document.addEventListener("dragleave", (event) => { if (!event.relatedTarget) drop.hidden = true; });
  document.addEventListener("drop", (event) => {
    event.preventDefault();
    drop.hidden = true;
    openFiles([...event.dataTransfer.files]);
  });
  const list = byId("recordings");
  list.replaceChildren(make("option", { value: "", "data-t": "recording" }, t("recording")), ...recordings.map((r, i) => make("option", { value: i }, r.name)));
  list.onchange = () => { if (list.value !== "") openRecording(recordings[Number(list.value)]); };
}
