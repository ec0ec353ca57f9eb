// This machine's camera, looked through here: pictures go to the loop, which finds the boxes of the colours that were clicked on.
import { byId, download, make, plain } from "./dom.js";
import { within } from "./patience.js";
import { keyOf } from "./tables.js";
import { theme } from "./colours.js";
import { onLanguage, t } from "./words.js";

const STARTS = 10_000;  // ms, until the first picture at most
const LOOKS = 1000;     // ms between two looks whether pictures come
const SILENT = 8;       // looks in vain: the camera sends nothing any more
const LONG = 320;  // px of a picture along its longer side, at most
const SHORT = 240;
const WANTED = { audio: false, video: { width: { ideal: 640 }, height: { ideal: 480 }, frameRate: { ideal: 30 }, facingMode: { ideal: "environment" } } };
const STEP = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const FAR = 8;  // px, of an arrow key; 1 with Shift

const ERRORS = {  // by the name of getUserMedia's exception
  NotAllowedError: ["camRefused", "camRefusedFix"], SecurityError: ["camPage", "camPageFix"], NotFoundError: ["camNone", "camNoneFix"],
  NotReadableError: ["camBusy", "camBusyFix"], AbortError: ["camBusy", "camBusyFix"], TimeoutError: ["camBusy", "camBusyFix"],
};
const REFUSED = { grey: "camGrey", dark: "camDark", full: "camFull" };

/** The size, px, in which a picture of that size is used. */
export function shrunk(width, height) {
  const scale = Math.min(1, LONG / Math.max(width, height), SHORT / Math.min(width, height));
  return [width, height].map((side) => Math.max(2, Math.round(side * scale)));
}

/** `page`: engine(), begin(name), show(look), open(entry), redraw(). */
export class Webcam {
  #page;
  #engine = null;
  #stream = null;
  #video = null;
  #frame = document.createElement("canvas");
  #alerts = [];
  #colours = new Map();  // by signature
  #cross = null;         // px of the picture, of who has no pointer
  #says = null;

  constructor(page) {
    this.#page = page;
    byId("webcam").onclick = () => this.going ? this.end() : this.start();
    byId("webcam-end").onclick = () => this.end();
    byId("webcam-log").onclick = () => download("webcam.log", [this.#engine.log()], "text/plain");
    byId("webcam-save").onclick = () => download("colours.json", [this.#engine.colours()], "application/json");
    byId("webcam-forget").onclick = () => this.#begin();
    const canvas = byId("camera");
    canvas.addEventListener("click", (event) => {
      if (!this.going) return;
      const { left, top, width, height } = canvas.getBoundingClientRect();
      this.#train((event.clientX - left) / width * this.#frame.width, (event.clientY - top) / height * this.#frame.height);
    });
    canvas.addEventListener("keydown", (event) => { if (this.going) this.#type(event); });
    document.addEventListener("visibilitychange", () => { if (document.hidden) this.#lose("camLeft", "camAgain"); });
    window.addEventListener("pagehide", () => this.#halt());
    onLanguage(() => this.#says?.());
  }

  get going() { return this.#engine !== null; }
  /** The picture of now: { image, cross }; null: none. */
  get picture() { return this.going ? { image: this.#frame, cross: this.#cross } : null; }

  async start() {
    this.#complain();
    const cameras = navigator.mediaDevices;
    if (!cameras?.getUserMedia) return this.#complain("camPage", "camPageFix");
    byId("webcam").disabled = true;
    let stream = null;
    try {
      stream = await cameras.getUserMedia(WANTED);
      const video = make("video", { muted: true, playsInline: true });
      video.srcObject = stream;
      await within(STARTS, video.play());
      if (document.hidden) throw new DOMException("", "AbortError");
      this.#page.begin(t("webcam"));
      this.#watch(stream, video);
    } catch (error) {
      for (const track of stream?.getTracks() ?? []) track.stop();
      this.#complain(...ERRORS[error.name] ?? ["camOther", "camBusyFix"], `${error.name}: ${error.message}`);
    }
    byId("webcam").disabled = false;
    return undefined;
  }

  #watch(stream, video) {
    this.#stream = stream;
    this.#video = video;
    stream.getVideoTracks()[0].onended = () => this.#lose("camGone", "camAgain");
    [this.#frame.width, this.#frame.height] = shrunk(video.videoWidth, video.videoHeight);
    document.documentElement.dataset.mode = "webcam";
    byId("webcam").setAttribute("aria-pressed", "true");
    byId("watching").hidden = false;
    byId("camera").tabIndex = 0;
    byId("camera").setAttribute("aria-describedby", "webcam-hint");
    this.#begin();
    byId("camera").focus({ preventScroll: true });
  }

  /** Another run, without colours. */
  #begin() {
    this.#engine = this.#page.engine();
    this.#engine.watch(this.#frame.width, this.#frame.height);
    this.#alerts = [];
    this.#colours.clear();
    this.#list();
    this.#say(() => t("camLooks"));
    this.#run(this.#engine);
  }

  #run(engine) {
    const video = this.#video;
    let shown = -1;
    let idle = 0;
    const watch = setInterval(() => {
      if (engine !== this.#engine) clearInterval(watch);
      else if (++idle >= SILENT) this.#lose("camSilent", "camAgain");
    }, LOOKS);
    const next = () => {
      if (video.requestVideoFrameCallback) video.requestVideoFrameCallback(look);
      else requestAnimationFrame(look);
    };
    const look = () => {
      if (engine !== this.#engine) return;
      next();
      if (!video.requestVideoFrameCallback && video.currentTime === shown) return;
      shown = video.currentTime;
      idle = 0;
      this.#look();
    };
    next();
  }

  #look() {
    const engine = this.#engine;
    const { width, height } = this.#frame;
    const g = this.#frame.getContext("2d", { willReadFrequently: true });
    g.drawImage(this.#video, 0, 0, width, height);
    if (!engine.look(g.getImageData(0, 0, width, height).data, performance.now() / 1000)) return void this.end();
    const result = engine.driven();
    this.#alerts.push(...result.alerts);
    result.alerts = this.#alerts;
    this.#page.show({ result, page: engine.page(), path: engine.path(), time: engine.time });
  }

  #train(u, v) {
    const made = this.#engine.train(Math.floor(u), Math.floor(v));
    if (made.refused) return this.#say(() => t(REFUSED[made.refused]));
    this.#colours.set(made.signature, made);
    this.#list();
    return this.#say(() => [t("camTrained", { name: made.name }), made.patchy ? t("camPatchy") : "", made.elsewhere ? t("camElsewhere") : ""].filter(Boolean).join(" "));
  }

  // The cross goes by arrow keys, and Enter is a click.
  #type(event) {
    const step = STEP[event.key];
    if (event.ctrlKey || event.altKey || event.metaKey || !(step || event.key === "Enter" || event.key === " ")) return;
    event.preventDefault();
    const { width, height } = this.#frame;
    const [u, v] = this.#cross ?? [width >> 1, height >> 1];
    if (!step) return void this.#train(u, v);
    const far = event.shiftKey ? 1 : FAR;
    this.#cross = [Math.min(width - 1, Math.max(0, u + far * step[0])), Math.min(height - 1, Math.max(0, v + far * step[1]))];
    this.#page.redraw();
  }

  #list() {
    byId("webcam-colours").replaceChildren(...[...this.#colours.values()].map((colour) => make("li", {}, keyOf(colour, theme()), plain(colour.name))));
    byId("webcam-save").disabled = byId("webcam-forget").disabled = this.#colours.size === 0;
  }

  #say(words) {
    this.#says = () => { byId("webcam-said").textContent = plain(words()); };
    this.#says();
  }

  #complain(says = null, fix = null, detail = null) {
    byId("webcam-error").replaceChildren(...(says ? [make("b", {}, t(says)), ` ${t(fix)}`, detail ? ` (${plain(detail)})` : ""] : []));
  }

  #halt() {
    for (const track of this.#stream?.getTracks() ?? []) track.stop();
    this.#stream = this.#video = this.#engine = this.#cross = this.#says = null;
    delete document.documentElement.dataset.mode;
    byId("webcam").setAttribute("aria-pressed", "false");
    byId("watching").hidden = true;
    byId("camera").removeAttribute("tabindex");
    byId("camera").removeAttribute("aria-describedby");
  }

  #lose(says, fix) {
    if (!this.going) return;
    this.end();
    this.#complain(says, fix);
  }

  /** Another log is shown. */
  leave() { if (this.going) this.#halt(); }

  /** The run becomes a log like any other. */
  end() {
    if (!this.going) return null;
    this.#engine.endDrive();
    const bytes = this.#engine.log();
    this.#halt();
    return this.#page.open({ name: "webcam.log", bytes, truth: [] });
  }
}
