import { inks, theme } from "./colours.js";
import { drawCamera } from "./cameraview.js";
import { bindSound, showBanner } from "./banner.js";
import { BoardPanel, isImage } from "./board.js";
import { bindFiles, bindKeys, bindMap, bindTransport } from "./controls.js";
import { compare } from "./compare.js";
import { boardImages, bundled, entriesOf, entryOf, given } from "./data.js";
import { byId, download, plain } from "./dom.js";
import { Driver, OWN } from "./drive.js";
import { Engine, PROFILES } from "./engine.js";
import { addCard } from "./gallery.js";
import { Kept } from "./kept.js";
import { FIRST, offerLayers, showLegend } from "./layers.js";
import { drawMap } from "./map2d.js";
import { drawSolid } from "./map3d.js";
import { Player } from "./player.js";
import { bindPort } from "./port.js";
import { follow } from "./stream.js";
import { ROOM } from "./room.js";
import { alertedFloor, levelsAt, placed, poseAt } from "./scene.js";
import { bindTour } from "./tour.js";
import { alertsUntil, countsOf, factsOf, fillAlerts, fillFacts, fillObjects, fillProblems, markAlerts } from "./tables.js";
import { drawTimeline, rowsOf } from "./timeline.js";
import { Behind, Eye, Orbit } from "./viewpoint.js";
import { Webcam } from "./webcam.js";
import { Window, extentOf } from "./window.js";
import { bindLanguage, fill, onLanguage, t } from "./words.js";

const NOTHING = { result: { objects: [], alerts: [], guard: [], calibration: [], signatures: [], camera: null, log: { rejected: {}, refused: {} } },
  page: { settings: {}, frame: null, bad_lines: [], complaints: [], check: {} }, path: new Float64Array(), time: 0 };

const state = {
  entry: { name: "", bytes: new Uint8Array(), truth: [] }, look: NOTHING, whole: NOTHING.path, t: 0, begin: 0, end: 0, rows: [],
  models: ["hybrid"], layers: new Set(FIRST), selected: null, playing: false, view: "top", live: false, loaded: false, trueRobot: null, chosen: null,
};
const memory = { flat: new Map(), solid: new Map(), camera: new Map() };  // of where names were
const flat = new Window();
const eyes = { solid: new Orbit(), behind: new Behind(), eye: new Eye() };  // of 3-D
const cards = [];
const compared = [];
let engine;
let replayer;  // of logs, one at a time
let player;    // it, or what was kept of a log
let driver;    // of a robot that is driven here
let webcam;    // the camera that is looked through here
let boards;    // the panel of boards
let ink = inks();

/** A run is made here. */
const made = () => driver?.going || webcam?.going;

const drawnNow = { pending: false, frame: null, tables: 0 };
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
  return { ...state.look, t: state.t, pose: poseAt(whole, state.t), truth: state.entry.truth, models: state.models, layers: state.layers,
    trueRobot: state.trueRobot, chosen: state.chosen };
}

function draw() {
  const view = viewNow();
  const all = { view, whole: state.live ? NOTHING.path : state.whole, ink, theme: theme(), selected: state.selected };
  if (byId("follow").checked && view.pose) {
    for (const eye of [flat, eyes.solid]) [eye.x, eye.y] = [view.pose.x, view.pose.y];
  }
  showLegend(byId("legend"), { layers: state.layers, truth: state.entry.truth });
  if (state.view !== "top") drawSolid(byId("map"), eyes[state.view], { ...all, memory: memory.solid }); else drawMap(byId("map"), flat, { ...all, memory: memory.flat });
  const frame = view.page.frame?.number;
  if (!driver?.going || frame !== drawnNow.frame) byId("camera-note").textContent = drawCamera(byId("camera"), { ...all, memory: memory.camera, picture: webcam?.picture });
  drawnNow.frame = frame;
  if (view.path.length) document.documentElement.dataset.pictured ??= String(Math.round(performance.now()));
  if (!made() || shownTables.at !== drawnNow.tables) drawTimeline(byId("timeline"), { rows: state.rows, begin: state.begin, end: state.end, t: state.t, ink });
  drawnNow.tables = shownTables.at;
  byId("clock").textContent = `${state.t.toFixed(2)} s`;
  if (!state.live) {
    byId("slider").value = state.t;
    byId("slider").setAttribute("aria-valuetext", t("sliderSays", { time: state.t.toFixed(2) }));
  }
}

// The tables keep the keyboard's place when they are filled anew.
function keepingFocus(table, fill) {
  const label = table.contains(document.activeElement) ? document.activeElement.getAttribute("aria-label") : null;
  fill();
  if (label) [...table.querySelectorAll("button")].find((b) => b.getAttribute("aria-label") === label)?.focus();
}

const shownTables = { at: 0, alerts: null, rows: [0, 0], count: 0 };
function fillTables(force) {
  // While a run is made here, pictures come first.
  const driven = made();
  if (!force && performance.now() - shownTables.at < (driven ? 1000 : 200)) return;
  shownTables.at = performance.now();
  const { result, page } = state.look;
  const all = state.live ? result.alerts : player.last?.result.alerts ?? [];
  const levels = levelsAt(all, state.t);
  const last = state.live ? null : player.last;
  fillFacts(byId("facts"), factsOf({ name: state.entry.name, result, page, last, took: player.took, duration: player.duration }));
  if (driven) {
    state.rows = rowsOf(result, state.t);
    return;
  }
  keepingFocus(byId("objects"), () => fillObjects(byId("objects"), { result, levels, theme: theme(), selected: state.selected, select }));
  const count = alertsUntil(all, state.t);
  const [first, end] = shownTables.rows;
  if (shownTables.alerts !== all || (count < first + 10 && first > 0) || (count > end - 10 && end < all.length)) {
    const known = state.live ? result : player.last?.result ?? result;
    keepingFocus(byId("alerts"), () => {
      shownTables.rows = fillAlerts(byId("alerts"), { result: known, at: state.t, go: (time) => { stop(); goTo(time); } });
    });
    shownTables.alerts = all;
  }
  shownTables.count = count;
  markAlerts(byId("alerts"), shownTables.rows, count);
}

/** `t`: of the look; the time that is asked for may be another one by now. */
function show(look, t, force = false) {
  document.documentElement.dataset.shown = t.toFixed(2);
  state.look = look;
  const all = state.live ? look.result.alerts : player.last?.result.alerts ?? [];
  showBanner({ levels: levelsAt(all, state.live ? look.time : t), objects: look.result.objects, moves: state.live || state.playing });
  offerLayers(byId("layer-list"), { state, result: state.entry.kept ? player.last.result : look.result, redraw });
  fillTables(force || !(state.playing || made()));
  redraw();
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
    if (look && state.loaded) show(look, wanted, wanted <= state.begin || wanted >= state.end);
  }
  going.busy = false;
}

function showPlay(plays) {
  byId("play").textContent = plays ? "❚❚" : "▶";
  byId("play").dataset.tLabel = plays ? "pause" : "play";
  byId("play").setAttribute("aria-label", t(byId("play").dataset.tLabel));
}

let plays = 0;  // paused and played again within a frame, the first must not go on beside the second
function play() {
  if (state.live || !state.loaded) return;
  if (state.t >= state.end - 1e-6) goTo(state.begin);
  state.playing = true;
  const mine = ++plays;
  showPlay(true);
  let last = performance.now();
  let asked = 0;
  const tick = (now) => {
    if (!state.playing || mine !== plays) return;
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

function halt() {
  state.playing = false;
  showPlay(false);
}

function stop() {
  if (!state.playing) return;
  halt();
  goTo(state.t);  // the look that is shown is a little older
}

function select(id) {
  state.selected = state.selected === id ? null : id;
  fillTables(true);
  redraw();
}

function fit() {
  const pose = state.live ? poseAt(state.look.path, state.look.time) : null;
  const points = extentOf({ ...(state.live ? state.look : player?.last ?? state.look), truth: state.layers.has("truth") ? state.entry.truth : [],
    ahead: pose ? alertedFloor(state.look.page.settings).map((p) => placed(pose, p)) : [] });
  const map = byId("map");
  flat.size(map.clientWidth, map.clientHeight);
  flat.fit(points);
  for (const eye of Object.values(eyes)) {
    eye.size(map.clientWidth, map.clientHeight);
    eye.fit(points);
  }
  redraw();
}

/** Says it now, and in another language when one is chosen. */
function summary(words) {
  state.says = words;
  byId("summary").textContent = plain(words());
}

function lineOf(bytes, number) {
  let start = 0;
  for (let line = 1; line < number && start >= 0; ++line) start = bytes.indexOf(10, start) + 1 || -1;
  if (start < 0) return "";
  const end = bytes.indexOf(10, start);
  return new TextDecoder().decode(bytes.subarray(start, Math.min(end < 0 ? bytes.length : end, start + 200))).trimEnd();
}

// A run that still goes on has no end to go back from.
function setLive(live) {
  state.live = live;
  for (const id of ["slider", "play", "save-result", "save-log", "profile"]) byId(id).disabled = live;
}

async function openEntry(entry) {
  halt();
  driver.leave();
  webcam.leave();
  Object.assign(state, { entry, loaded: false, selected: null, trueRobot: null, chosen: null, rows: [], t: 0, begin: 0, end: 0, whole: NOTHING.path });
  byId("title").textContent = plain(entry.name);
  document.title = `${plain(entry.name)} · Fencepost`;
  summary(() => t("runReplaying"));
  byId("progress").hidden = false;
  setLive(false);
  player.stop();
  player = entry.kept ? new Kept(entry.kept) : replayer;
  for (const id of ["save-result", "save-log", "profile"]) byId(id).disabled = Boolean(entry.kept);
  byId("thinned").hidden = !entry.kept;
  byId("thinned").textContent = entry.kept ? plain(t("thinned", entry.kept)) : "";
  let shown = -Infinity;  // the first picture comes at once
  let last = null;
  try {
    last = await player.load(entry.bytes, Number(byId("profile").value), (share, look) => {
      byId("progress").value = share;
      if (performance.now() - shown < 400) return;
      const now = look();
      Object.assign(state, { look: now, t: now.time, whole: now.path, end: now.time });
      fit();
      if (now.path.length) shown = performance.now();
    });
  } catch (error) {
    byId("progress").hidden = true;
    summary(() => t("runStopped", { detail: error.message }));
  }
  if (!last) return null;
  byId("progress").hidden = true;
  Object.assign(state, { loaded: true, whole: last.path, begin: player.begin, end: player.end, t: player.end, rows: rowsOf(last.result, player.end) });
  Object.assign(byId("slider"), { min: player.begin, max: player.end, step: 0.01 });
  fillProblems(byId("problems"), { ...last, lines: (n) => lineOf(entry.bytes, n) });
  show(last, player.end, true);
  fit();
  const { objects, log } = last.result;
  const { alerts } = countsOf(last);
  const counts = { time: player.duration.toFixed(1), frames: log.frames, objects: objects.length, confirmed: objects.filter((o) => o.state !== "tentative").length, alerts };
  summary(() => last.page.unreadable ? t("runUnreadable") : t("runSays", counts));
  return last;
}

/** A recording of the page's own is there to be looked at: it plays at once, where motion is welcome. */
async function openRecording(recording) {
  if (await openEntry(await entryOf(recording)) && !window.matchMedia("(prefers-reduced-motion: reduce)").matches) play();
}

async function openFiles(files) {
  const image = files.find(({ name }) => isImage(name));
  if (image) await boards.load(image.name, new Uint8Array(await image.arrayBuffer()));
  const others = files.filter(({ name }) => !isImage(name));
  if (image && !others.length) return null;
  byId("recordings").value = "";
  const { logs, scenes, complaints } = await entriesOf(others);
  if (complaints.length) summary(() => complaints.join("; "));
  if (!logs.length && scenes.length && driver.going) return driver.load(scenes[0].name, scenes[0].text);
  if (!logs.length && scenes.length) {
    state.entry.truth = scenes[0].truth;
    return fit();
  }
  return logs.length ? openAll(logs) : null;
}

/** The first in full, and each as a card where there are several. */
async function openAll(logs) {
  const others = [];
  for (const entry of logs) {
    const look = await openEntry(entry);
    if (!look) return null;
    if (logs.length > 1) others.push([entry, look, entry.scene ? await player.score(entry.scene) : null]);
  }
  for (const [entry, look, score] of others) {
    const open = () => openEntry(entry).then(() => window.scrollTo(0, 0));
    cards.push(addCard(entry, look, open));
    compared.push({ name: entry.name, look, score, truth: entry.truth, open });
  }
  if (others.length) compare(compared, { ink, theme: theme() });
  return logs.length > 1 ? openEntry(logs[0]) : null;
}

function setTheme(name) {
  document.documentElement.dataset.theme = name;
  byId("theme").setAttribute("aria-pressed", String(name === "dark"));
  ink = inks();
  if (!player) return;  // the loop comes before the first picture
  fillTables(true);
  for (const card of cards) card();
  if (compared.length) compare(compared, { ink, theme: name });
  redraw();
}

/** All that is put together of words, in the language of now. */
function sayAgain() {
  if (!player) return;
  if (state.says) summary(state.says);
  if (state.entry.kept) byId("thinned").textContent = plain(t("thinned", state.entry.kept));
  shownTables.alerts = null;
  for (const eye of Object.values(memory)) eye.clear();
  if (state.loaded) fillProblems(byId("problems"), { ...player.last, lines: (n) => lineOf(state.entry.bytes, n) });
  if (state.loaded || state.live) show(state.look, state.t, true);
  drawnNow.frame = null;
  if (compared.length) compare(compared, { ink, theme: theme() });
}

function bindSaving() {
  const name = () => state.entry.name.replace(/\.(log|txt|gz)$/i, "") || "fencepost";
  byId("save-result").onclick = async () => download(`${name()}.json`, [await player.resultText()], "application/json");
  byId("save-log").onclick = () => download(`${name()}.log`, [state.entry.bytes], "text/plain");
  byId("save-picture").onclick = () => byId("map").toBlob((blob) => download(`${name()}.png`, [blob], "image/png"));
}

async function openFirst(recordings, comingLog) {
  const mine = given();
  if (mine?.stream) {
    byId("reach").dataset.t = "reachStream";
    fill(byId("reach").parentElement);
    follow(mine.stream, comingLog).catch((error) => summary(() => t("cannotFollow", { detail: error.message })));
  } else if (mine) {
    byId("profile").value = String(Math.max(0, PROFILES.indexOf(mine.profile)));
    const [first, ...others] = mine.logs;
    if (!others.length && recordings.some(({ name }) => name === first.name)) await openRecording(first);
    else await openAll(await Promise.all(mine.logs.map(entryOf)));
  } else {
    await openRecording(recordings[0]);
    byId("recordings").value = "0";
  }
}

async function begin() {
  bindLanguage(byId("language"));
  onLanguage(sayAgain);
  summary(() => t("loading"));
  setTheme(window.matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light");
  byId("theme").onclick = () => setTheme(theme() === "dark" ? "light" : "dark");
  const { wasm, recordings } = await bundled();
  engine = await Engine.create(wasm);
  replayer = new Player(engine);
  player = replayer;
  const page = { state, flat, eyes, redraw, grab: (at) => driver.grab(at), play, stop, goTo, fit, select, openFiles, openRecording, view: viewNow, last: () => player.last };
  bindMap(page);
  bindKeys(page);
  bindTransport(page);
  bindFiles(recordings, page);
  bindSaving();
  byId("profile").onchange = () => { if (!state.live && player.last) openEntry(state.entry); };
  const comingLog = {
    engine: () => new Engine(engine.module), open: (entry) => state.live ? openEntry(entry) : null,
    begin: (name) => {
      driver.leave();
      webcam.leave();
      halt();
      player.stop();
      player = replayer;
      byId("thinned").hidden = true;
      setLive(true);
      byId("recordings").value = "";
      summary(() => t("mapLive"));
      Object.assign(state, { entry: { name, bytes: new Uint8Array(), truth: [] }, look: NOTHING, rows: [], selected: null });
      byId("title").textContent = name;
      document.title = `${name} · Fencepost`;
      byId("problems").hidden = true;
      byId("progress").hidden = true;
    },
    show: (look) => {
      if (!state.live) return;  // another log was opened meanwhile
      const first = state.look.path.length === 0 && look.path.length > 0;
      Object.assign(state, { t: look.time, begin: look.path[0] ?? 0, end: look.time, rows: rowsOf(look.result, look.time) });
      show(look, look.time);
      if (first || look.result.objects.length !== state.fitted) fit();
      state.fitted = look.result.objects.length;
    },
  };
  bindPort(comingLog);
  boards = new BoardPanel(comingLog.engine, boardImages());
  bindSound();
  bindTour({ goTo, begin: async () => {
    await openEntry(await entryOf(recordings[0]));
    byId("recordings").value = "0";
  } });
  driver = new Driver({
    engine: comingLog.engine, open: openEntry, redraw, fit,
    begin: (name) => {
      comingLog.begin(name);
      summary(() => t("driveKeys"));
    },
    show: (look, trueRobot) => {
      Object.assign(state, { t: look.time, begin: 0, end: look.time, trueRobot });
      show(look, look.time);
    },
    setTruth: (things, chosen) => {
      Object.assign(state.entry, { truth: things });
      state.chosen = chosen;
      redraw();
    },
  }, { [OWN]: ROOM, ...Object.fromEntries(recordings.map(({ name, scene }) => [name.replace(/\.log$/, ""), scene])) });
  webcam = new Webcam({
    ...comingLog, redraw,
    begin: (name) => {
      comingLog.begin(name);
      summary(() => t("camNote"));
    },
  });
  new ResizeObserver(redraw).observe(byId("map"));
  new ResizeObserver(() => markAlerts(byId("alerts"), shownTables.rows, shownTables.count)).observe(byId("alerts").parentElement);
  await openFirst(recordings, comingLog);
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

begin().catch((error) => { summary(() => t("cannotStart", { detail: error.message })); });
