// A robot that is driven here: the simulator's senses and the robot's own loop, in a room that can be changed on the way.
import { byId, download, make, plain } from "./dom.js";
import { KINDS, ROOM, middleOf, movedBy, turnedBy, withErrors } from "./room.js";
import { truthOf } from "./scene.js";
import { Steering } from "./steering.js";
import { inside } from "./window.js";
import { onLanguage, t } from "./words.js";

const LONGEST = 0.1;  // s between two frames: a page that comes back from the background does not leap
const EVERY = 15;     // ms between two pictures, at least: 60 a second
const SCORED = 500;   // ms between two scores
const SLIDERS = {     // in the units of the scene file; `worn`: of a room that says nothing
  noise: { of: (scene) => scene.noise?.edge_px ?? 0, say: (value) => `${value.toFixed(1)} px` },
  lens: { of: () => 0, say: (value) => `${value > 0 ? "+" : ""}${(100 * value).toFixed(0)} cm` },
  tilt: { of: (scene) => scene.noise?.pitch_error ?? 0, say: (value) => `${(value * 180 / Math.PI).toFixed(1)}°` },
  slip: { of: (scene) => scene.noise?.drift_scale ?? 0, say: (value) => `${(100 * value).toFixed(0)} %` },
};

const STEP = 0.05;           // m, of a thing that is moved by a button
const TURN = Math.PI / 12;  // rad, of one that is turned
const EDITS = {             // by button
  "thing-left": (thing) => movedBy(thing, -STEP, 0), "thing-right": (thing) => movedBy(thing, STEP, 0),
  "thing-up": (thing) => movedBy(thing, 0, STEP), "thing-down": (thing) => movedBy(thing, 0, -STEP),
  "thing-turn": (thing) => turnedBy(thing, TURN), "thing-back": (thing) => turnedBy(thing, -TURN),
};

/** The name of the page's own room among `rooms`. */
export const OWN = "a room";

const percent = (share) => share === null ? "–" : `${Math.round(100 * share)} %`;

/** True things of a scene with the colours that the camera has for them. */
export function coloured(scene) {
  const rgb = new Map((scene.signatures ?? []).map(({ id, rgb: hex, name }) => [id, { hex, name }]));
  return truthOf(scene).map((thing) => {
    const object = scene.objects[thing.index];
    const colour = object.trained === false ? null : rgb.get(object.signature);
    return { ...thing, rgb: colour?.hex ?? null, signature: object.signature ?? 0 };
  });
}

/** `page`: engine(), begin(name), show(look), open(entry), redraw(), setTruth(things, chosen), fit(). `rooms`: { name: scene }. */
export class Driver {
  #page;
  #rooms;
  #steering;
  #scene = ROOM;
  #chosen = null;  // index of an object
  #errors = {};
  #engine = null;
  #alerts = [];
  #driven = 0;
  #changed = false;
  #dragging = false;
  #faultless = null;  // the last scene without a fault
  #score = { at: 0, recklessness: null, paranoia: null };

  constructor(page, rooms) {
    this.#page = page;
    this.#rooms = rooms;
    this.#steering = new Steering(byId("pad"), () => this.going);
    const list = byId("rooms");
    list.replaceChildren(...Object.keys(rooms).map((name) => make("option", name === OWN ? { value: name, "data-t": "ownRoom" } : { value: name }, name === OWN ? t("ownRoom") : name)));
    list.onchange = () => this.start(rooms[list.value]);
    byId("drive").onclick = () => this.going ? this.end() : this.start(this.#scene);
    byId("again").onclick = () => this.start(this.#scene);
    byId("drive-end").onclick = () => this.end();
    byId("drive-log").onclick = () => download("drive.log", [this.#engine.log()], "text/plain");
    byId("drive-scene").onclick = () => download("room.json", [`${JSON.stringify(this.#true(), null, 1)}\n`], "application/json");
    byId("room-file").onchange = async (event) => {
      const [file] = event.target.files;
      event.target.value = "";
      if (file) this.load(file.name, await file.text());
    };
    byId("obey").onchange = () => this.#engine?.obey(byId("obey").checked);
    byId("reveal").onchange = () => this.#showTruth();
    for (const name of Object.keys(SLIDERS)) {
      byId(name).oninput = () => { this.#errors[name] = Number(byId(name).value); this.#say(name); this.#changed = true; };
      byId(name).onpointerup = () => byId("map").focus({ preventScroll: true });
    }
    for (const kind of Object.keys(KINDS)) byId(`add-${kind}`).onclick = () => this.#add(kind);
    byId("remove").onclick = () => this.#remove();
    byId("thing").onchange = () => { this.#chosen = byId("thing").value === "" ? null : Number(byId("thing").value); this.#showTruth(); this.#sayPlace(); };
    for (const [id, edit] of Object.entries(EDITS)) byId(id).onclick = () => this.#edit(edit);
    onLanguage(() => this.#offerThings());
  }

  get going() { return this.#engine !== null; }

  /** A scene file's text. */
  load(name, text) {
    try {
      const scene = JSON.parse(text);
      this.#page.engine().drive(text);
      this.start(scene);
      byId("rooms").value = "";
      this.#complain("");
    } catch (error) {
      this.#complain(`${name}: ${error.message}`);
    }
  }

  start(scene) {
    this.#halt();
    Object.assign(this, { last: null });
    this.#scene = this.#faultless = structuredClone(scene);
    this.#chosen = null;
    this.#errors = { noise: null, lens: 0, tilt: null, slip: null };
    for (const [name, { of }] of Object.entries(SLIDERS)) {
      byId(name).value = of(scene);
      this.#say(name);
    }
    this.#alerts = [];
    this.#driven = 0;
    this.#changed = false;
    this.#page.begin(t("drive"));
    this.#engine = this.#page.engine();
    this.#engine.drive(JSON.stringify(scene));
    this.#engine.obey(byId("obey").checked);
    this.#score = { at: 0, recklessness: null, paranoia: null };
    document.documentElement.dataset.mode = "drive";
    byId("drive").setAttribute("aria-pressed", "true");
    byId("robot-wheel").hidden = byId("driving").hidden = false;
    byId("drive-said").textContent = "";
    this.#showTruth();
    this.#engine.advance(0.02);
    this.#show();
    this.#page.fit();
    byId("map").focus({ preventScroll: true });
    this.#run();
  }

  #halt() {
    this.#engine = null;
    this.#steering.release();
    delete document.documentElement.dataset.mode;
    byId("drive").setAttribute("aria-pressed", "false");
    byId("robot-wheel").hidden = byId("driving").hidden = true;
  }

  /** Another log is shown. */
  leave() { if (this.going) this.#halt(); }

  /** The drive becomes a log like any other. */
  end() {
    if (!this.going) return null;
    this.#engine.endDrive();
    const bytes = this.#engine.log();
    const truth = truthOf(this.#true());
    this.#halt();
    return this.#page.open({ name: "drive.log", bytes, truth });
  }

  #run() {
    const engine = this.#engine;
    let last = performance.now();
    let shown = last;
    const tick = (now) => {
      if (engine !== this.#engine) return;
      const passed = Math.min(LONGEST, Math.max(0, now - last) / 1000);
      last = now;
      if (this.#changed) this.#apply();
      engine.steer(this.#steering.now());
      if (!engine.advance(passed)) return void this.end();
      if (now - shown >= EVERY) {
        shown = now;
        this.#show();
      }
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  #show() {
    const engine = this.#engine;
    const result = engine.driven();
    this.#alerts.push(...result.alerts);
    result.alerts = this.#alerts;
    const truth = engine.truth();
    this.#driven += this.last ? Math.hypot(truth.pose[0] - this.last[0], truth.pose[1] - this.last[1]) : 0;
    this.last = truth.pose;
    if (performance.now() - this.#score.at > SCORED) this.#score = { ...engine.score(), at: performance.now() };
    byId("recklessness").textContent = percent(this.#score.recklessness);
    byId("paranoia").textContent = percent(this.#score.paranoia);
    byId("bumps").textContent = truth.bumps;
    byId("driven").textContent = `${this.#driven.toFixed(1)} m`;
    byId("held").textContent = truth.held ? t("held") : "";
    const [x, y, heading] = truth.pose;
    this.#page.show({ result, page: engine.page(), path: engine.path(), time: engine.time }, byId("reveal").checked ? { x, y, heading } : null);
  }

  #true() { return withErrors(this.#scene, { noise: null, tilt: null, slip: null, lens: 0, ...this.#errors }); }

  // A room with a fault is not driven through: it becomes the last one without.
  #apply() {
    this.#changed = false;
    const text = JSON.stringify(this.#true());
    try {
      this.#page.engine().drive(text);
      this.#engine.change(text);
      this.#faultless = this.#scene;
      this.#complain("");
    } catch (error) {
      this.#complain(error.message);
      if (!this.#dragging) this.#scene = this.#faultless;
    }
    this.#showTruth();
  }

  // Their list has the place of each when it was chosen last: names alone may be alike.
  #offerThings() {
    const shown = byId("reveal").checked;
    for (const control of byId("thing-row").querySelectorAll("select, button")) control.disabled = !shown;
    const names = this.#scene.objects.map(({ name }, i) => plain(`${i + 1}: ${name ?? ""}`));
    const list = byId("thing");
    const offered = [t("choose"), ...names];
    if ([...list.options].map(({ text }) => text).join("\n") !== offered.join("\n")) {
      list.replaceChildren(...offered.map((text, i) => make("option", { value: i ? i - 1 : "" }, text)));
    }
    list.value = this.#chosen ?? "";
    if (this.#chosen === null) byId("thing-place").textContent = "";
  }

  #sayPlace() {
    const thing = this.#scene.objects[this.#chosen];
    const [x, y] = thing ? middleOf(thing.footprint) : [];
    byId("thing-place").textContent = thing ? `x ${x.toFixed(2)} m, y ${y.toFixed(2)} m` : "";
  }

  #edit(change) {
    if (this.#chosen === null) return this.#complain(t("chooseFirst"));
    this.#scene = { ...this.#scene, objects: this.#scene.objects.map((object, i) => i === this.#chosen ? change(object) : object) };
    this.#apply();
    return this.#sayPlace();
  }

  #showTruth() {
    this.#offerThings();
    this.#page.setTruth(byId("reveal").checked ? coloured(this.#scene) : [], this.#chosen);
  }
  #say(name) { byId(`${name}-said`).textContent = SLIDERS[name].say(Number(byId(name).value)); }
  #complain(text) { byId("drive-said").textContent = plain(text); }

  #add(kind) {
    const { height, at } = KINDS[kind];
    const signature = this.#scene.signatures[this.#scene.objects.length % this.#scene.signatures.length];
    const [x, y, heading] = this.last ?? [0, 0, 0];
    const place = this.#free(x + 0.6 * Math.cos(heading), y + 0.6 * Math.sin(heading));
    this.#scene = { ...this.#scene, objects: [...this.#scene.objects, { name: `${signature.name} ${kind}`, signature: signature.id, height, footprint: at(...place) }] };
    this.#chosen = this.#scene.objects.length - 1;
    this.#changed = true;
    this.#sayPlace();
  }

  // Beside what stands there, the nearest place.
  #free(x, y) {
    const taken = truthOf(this.#scene);
    for (let i = 0; i < 200; ++i) {
      const at = [x + 0.06 * Math.sqrt(i) * Math.cos(2.4 * i), y + 0.06 * Math.sqrt(i) * Math.sin(2.4 * i)];
      if (!taken.some(({ ring }) => inside(ring, at) || ring.some((p) => Math.hypot(p[0] - at[0], p[1] - at[1]) < 0.35))) return at;
    }
    return [x, y];
  }

  #remove() {
    if (this.#chosen === null) return this.#complain(t("chooseFirst"));
    this.#scene = { ...this.#scene, objects: this.#scene.objects.filter((_, i) => i !== this.#chosen) };
    this.#chosen = null;
    this.#changed = true;
    return undefined;
  }

  /** The thing at a place of the map follows the pointer from now on: { moved(at), dropped() }; null where there is none. */
  grab(at) {
    const thing = this.going && byId("reveal").checked ? truthOf(this.#scene).findLast(({ ring }) => inside(ring, at)) : null;
    if (!thing) return null;
    const { index } = thing;
    this.#chosen = index;
    this.#showTruth();
    this.#sayPlace();
    const before = this.#scene.objects[index];
    this.#dragging = true;
    return {
      moved: ([x, y]) => {
        this.#scene = { ...this.#scene, objects: this.#scene.objects.map((object, i) => i === index ? movedBy(before, x - at[0], y - at[1]) : object) };
        this.#changed = true;
        this.#showTruth();
        this.#sayPlace();
      },
      dropped: () => {
        this.#dragging = false;
        if (this.going) this.#apply();
        this.#sayPlace();
      },
    };
  }
}
