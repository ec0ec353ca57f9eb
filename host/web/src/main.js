import { inks, theme } from "./colours.js";
import { drawCamera } from "./cameraview.js";
import { bindFiles, bindKeys, bindMap, bindTransport } from "./controls.js";
import { bundled, entriesOf, entryOf, given } from "./data.js";
import { byId, download, make, plain } from "./dom.js";
import { Engine } from "./engine.js";
import { addCard } from "./gallery.js";
import { drawMap } from "./map2d.js";
import { Orbit, drawSolid } from "./map3d.js";
import { Player } from "./player.js";
import { bindPort } from "./port.js";
import { levelsAt, poseAt } from "./scene.js";
import { alertsUntil, fillAlerts, fillFacts, fillObjects, fillProblems, markAlerts } from "./tables.js";
import { drawTimeline, rowsOf } from "./timeline.js";
import { Window, extentOf } from "./window.js";

const LAYERS = { truth: "truth", path: "path", zones: "alert zones", wedge: "camera", guard: "guard's points", labels: "names" };
const NOTHING = { result: { objects: [], alerts: [], guard: [], calibration: [], signatures: [], camera: null, log: { rejected: {}, refused: {} } },
  page: { settings: {}, frame: null, bad_lines: [], complaints: [], check: {} }, path: new Float64Array(), time: 0 };

const state = {
  entry: { name: "", bytes: new Uint8Array(), truth: [] }, look: NOTHING, whole: NOTHING.path, t: 0, begin: 0, end: 0, rows: [],
  models: ["hybrid"], layers: new Set(Object.keys(LAYERS)), selected: null, playing: false, solid: false, live: false, loaded: false,
};
const flat = new Window();
const orbit = new Orbit();
const cards = [];
let engine;
let player;
let ink = inks();

const drawnNow = { pending: false };
function redraw() {
  if (drawnNow.pending) return;
  drawnNow.pending = true;
  requestAnimationFrame(() => {
    drawnNow.pending = false;
    draw();
  });
}

function viewNow() {
  const whole = state.live ? state.look.path : state.whole;
  return { ...state.look, t: state.t, pose: poseAt(whole, state.t), truth: state.entry.truth, models: state.models, layers: state.layers };
}

function draw() {
  const view = viewNow();
  const all = { view, whole: state.live ? NOTHING.path : state.whole, ink, theme: theme(), selected: state.selected };
  if (byId("follow").checked && view.pose) {
    for (const eye of [flat, orbit]) [eye.x, eye.y] = [view.pose.x, view.pose.y];
  }
  if (state.solid) drawSolid(byId("map"), orbit, all); else drawMap(byId("map"), flat, all);
  byId("camera-note").textContent = drawCamera(byId("camera"), all);
  drawTimeline(byId("timeline"), { rows: state.rows, begin: state.begin, end: state.end, t: state.t, ink });
  byId("clock").textContent = `${state.t.toFixed(2)} s`;
  if (!state.live) {
    byId("slider").value = state.t;
    byId("slider").setAttribute("aria-valuetext", `${state.t.toFixed(2)} seconds`);
  }
}

// The tables keep the keyboard's place when they are filled anew.
function keepingFocus(table, fill) {
  const label = table.contains(document.activeElement) ? document.activeElement.getAttribute("aria-label") : null;
  fill();
  if (label) [...table.querySelectorAll("button")].find((b) => b.getAttribute("aria-label") === label)?.focus();
}

const shownTables = { at: 0, alerts: null, rows: [0, 0] };
function fillTables(force) {
  if (!force && performance.now() - shownTables.at < 200) return;
  shownTables.at = performance.now();
  const { result, page } = state.look;
  const all = state.live ? result.alerts : player.last?.result.alerts ?? [];
  const levels = levelsAt(all, state.t);
  keepingFocus(byId("objects"), () => fillObjects(byId("objects"), { result, levels, theme: theme(), selected: state.selected, select }));
  const count = alertsUntil(all, state.t);
  const [first, end] = shownTables.rows;
  if (shownTables.alerts !== all || (count < first + 10 && first > 0) || (count > end - 10 && end < all.length)) {
    const known = state.live ? result : player.last?.result ?? result;
    keepingFocus(byId("alerts"), () => {
      shownTables.rows = fillAlerts(byId("alerts"), { result: known, t: state.t, go: (t) => { stop(); goTo(t); } });
    });
    shownTables.alerts = all;
  }
  markAlerts(byId("alerts"), shownTables.rows, count);
  const worst = [...levels.values()].filter((alert) => alert.level !== "clear");
  byId("now").replaceChildren(...worst.slice(0, 4).flatMap((alert) => [make("span", { className: `level ${alert.level}` }, alert.level),
    ` ${alert.id === 0 ? "something" : `${alert.id} ${plain(result.objects.find((o) => o.id === alert.id)?.name ?? "")}`} `]));
  fillFactsNow(result, page);
}

function fillFactsNow(result, page) {
  const last = state.live ? null : player.last;
  const { log } = result;
  const total = (counts) => Object.values(counts).reduce((a, b) => a + b, 0);
  const facts = [["log", state.entry.name], ["digest now", make("code", { id: "digest-now" }, result.digest ?? "")]];
  if (last) facts.push(["digest at the end", make("code", { id: "digest" }, last.result.digest)]);
  facts.push(["profile", result.profile ?? ""], ["records used", `${log.records ?? 0}: ${log.frames ?? 0} frames, ${log.odometry ?? 0} of odometry`],
    ["not used", `${total(log.rejected)} bad lines, ${total(log.refused)} frames, ${log.foreign ?? 0} lines that are no records`]);
  if (last?.page.check.compared) {
    const { compared, differing } = last.page.check;
    facts.push(["the robot's own log", differing ? `differs in ${differing} of ${compared} records` : `agrees in all ${compared} records compared`]);
  }
  if (page.runs > 1) facts.push(["runs in it", `${page.runs}; the last is shown, as by fencepost replay`]);
  if (last && player.took) facts.push(["replayed here in", `${Math.round(player.took.busy)} ms, ${(player.duration * 1000 / Math.max(1, player.took.busy)).toFixed(0)} times as fast as it was driven`]);
  fillFacts(byId("facts"), facts);
}

function show(look, t, force = false) {
  document.documentElement.dataset.shown = t.toFixed(2);
  state.look = look;
  state.t = t;
  offerModels(look.result);
  fillTables(force || !state.playing);
  redraw();
}

function offerModels(result) {
  const names = new Set(["hybrid", ...result.objects.flatMap((object) => Object.keys(object.models))]);
  const list = byId("layer-list");
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

const going = { wanted: null, busy: false, cost: 20 };
async function goTo(t) {
  if (state.live) return;
  state.t = Math.min(state.end, Math.max(state.begin, t));
  redraw();
  going.wanted = state.t;
  if (going.busy) return;
  going.busy = true;
  while (going.wanted !== null) {
    const wanted = going.wanted;
    going.wanted = null;
    const started = performance.now();
    const look = await player.seek(wanted);
    going.cost = performance.now() - started;
    if (look) show(look, state.playing ? state.t : wanted, wanted >= state.end);
  }
  going.busy = false;
}

function play() {
  if (state.live || !state.loaded) return;
  if (state.t >= state.end - 1e-6) state.t = state.begin;
  state.playing = true;
  byId("play").textContent = "❚❚";
  byId("play").setAttribute("aria-label", "Pause");
  let last = performance.now();
  let asked = 0;
  const tick = (now) => {
    if (!state.playing) return;
    state.t = Math.min(state.end, state.t + Math.max(0, now - last) / 1000 * Number(byId("speed").value));
    last = now;
    if (now - asked > Math.max(60, 3 * going.cost) || state.t >= state.end) {
      asked = now;
      goTo(state.t);
    } else {
      redraw();
    }
    if (state.t >= state.end) stop(); else requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}

function stop() {
  state.playing = false;
  byId("play").textContent = "▶";
  byId("play").setAttribute("aria-label", "Play");
}

function select(id) {
  state.selected = state.selected === id ? null : id;
  fillTables(true);
  redraw();
}

function fit() {
  const points = extentOf({ ...(state.live ? state.look : player?.last ?? state.look), truth: state.layers.has("truth") ? state.entry.truth : [] });
  const map = byId("map");
  flat.size(map.clientWidth, map.clientHeight);
  orbit.size(map.clientWidth, map.clientHeight);
  flat.fit(points);
  orbit.fit(points);
  redraw();
}

function summary(text) { byId("summary").textContent = plain(text); }

function lineOf(bytes, number) {
  let start = 0;
  for (let line = 1; line < number && start >= 0; ++line) start = bytes.indexOf(10, start) + 1 || -1;
  if (start < 0) return "";
  const end = bytes.indexOf(10, start);
  return new TextDecoder().decode(bytes.subarray(start, Math.min(end < 0 ? bytes.length : end, start + 200))).trimEnd();
}

// What is still coming has no end to go back from.
function setLive(live) {
  state.live = live;
  for (const id of ["slider", "play", "save-result"]) byId(id).disabled = live;
}

async function openEntry(entry) {
  stop();
  Object.assign(state, { entry, loaded: false, selected: null, rows: [], t: 0, begin: 0, end: 0, whole: NOTHING.path });
  byId("title").textContent = plain(entry.name);
  document.title = `${plain(entry.name)} · Fencepost`;
  summary(`Replaying ${entry.name} …`);
  byId("progress").hidden = false;
  setLive(false);
  let shown = performance.now();
  let last = null;
  try {
    last = await player.load(entry.bytes, 0, (share, look) => {
      byId("progress").value = share;
      if (performance.now() - shown < 400) return;
      const now = look();
      Object.assign(state, { look: now, t: now.time, whole: now.path, end: now.time });
      fit();
      shown = performance.now();
    });
  } catch (error) {
    byId("progress").hidden = true;
    summary(`${entry.name} stopped the loop (${error.message}): does fencepost replay read it? Please report it, with the log.`);
  }
  if (!last) return null;
  byId("progress").hidden = true;
  Object.assign(state, { loaded: true, whole: last.path, begin: player.begin, end: player.end, rows: rowsOf(last.result, player.end) });
  Object.assign(byId("slider"), { min: player.begin, max: player.end, step: 0.01 });
  fillProblems(byId("problems"), { ...last, lines: (n) => lineOf(entry.bytes, n) });
  show(last, player.end, true);
  fit();
  const { objects, alerts, log, profile, digest } = last.result;
  summary(last.page.unreadable ? `${entry.name} cannot be replayed` :
    `${objects.length} objects (${objects.filter((o) => o.state !== "tentative").length} confirmed), ${alerts.length} alerts, ${log.frames} frames, ${player.duration.toFixed(1)} s, profile ${profile}, digest ${digest}`);
  return last;
}

async function openFiles(files) {
  byId("recordings").value = "";
  const { logs, scenes, complaints } = await entriesOf(files);
  if (complaints.length) summary(complaints.join("; "));
  if (!logs.length && scenes.length) {
    state.entry.truth = scenes[0].truth;
    return fit();
  }
  if (!logs.length) return null;
  const others = [];
  for (const entry of logs) {
    const look = await openEntry(entry);
    if (!look) return null;
    if (logs.length > 1) others.push([entry, look]);
  }
  for (const [entry, look] of others) cards.push(addCard(entry, look, () => openEntry(entry).then(() => window.scrollTo(0, 0))));
  return logs.length > 1 ? openEntry(logs[0]) : null;
}

function setTheme(name) {
  document.documentElement.dataset.theme = name;
  byId("theme").setAttribute("aria-pressed", String(name === "dark"));
  ink = inks();
  if (player) fillTables(true);
  for (const card of cards) card();
  redraw();
}

function bindSaving() {
  const name = () => state.entry.name.replace(/\.(log|txt|gz)$/i, "") || "fencepost";
  byId("save-result").onclick = async () => download(`${name()}.json`, [await player.resultText()], "application/json");
  byId("save-picture").onclick = () => byId("map").toBlob((blob) => download(`${name()}.png`, [blob], "image/png"));
}

async function begin() {
  setTheme(window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  byId("theme").onclick = () => setTheme(theme() === "dark" ? "light" : "dark");
  const { wasm, recordings } = await bundled();
  engine = await Engine.create(wasm);
  player = new Player(engine);
  const page = { state, flat, orbit, redraw, play, stop, goTo, fit, select, openFiles, openEntry, view: viewNow, last: () => player.last };
  bindMap(page);
  bindKeys(page);
  bindTransport(page);
  bindFiles(recordings, page);
  bindSaving();
  bindPort({
    engine: () => new Engine(engine.module), open: openEntry,
    begin: (name) => {
      stop();
      player.stop();
      setLive(true);
      byId("recordings").value = "";
      summary("Live: the map is made here, of what the robot sends.");
      Object.assign(state, { entry: { name, bytes: new Uint8Array(), truth: [] }, look: NOTHING, rows: [], selected: null });
      byId("title").textContent = name;
      byId("problems").hidden = true;
    },
    show: (look) => {
      const first = state.look.path.length === 0 && look.path.length > 0;
      Object.assign(state, { begin: look.path[0] ?? 0, end: look.time, rows: rowsOf(look.result, look.time) });
      show(look, look.time);
      if (first || look.result.objects.length !== state.fitted) fit();
      state.fitted = look.result.objects.length;
    },
  });
  new ResizeObserver(redraw).observe(byId("map"));
  const log = given();
  await openEntry(await entryOf(log ?? recordings[0]));
  if (!log) byId("recordings").value = "0";
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

begin().catch((error) => { summary(`The page could not start: ${error.message}. It needs a browser with WebAssembly and DecompressionStream (2023 or later).`); });
