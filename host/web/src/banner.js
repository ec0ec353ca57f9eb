// The worst alert in force in words, in its colour, and to be heard.
import { figure } from "./canvas.js";
import { LEVELS } from "./colours.js";
import { byId, plain } from "./dom.js";
import { t } from "./words.js";

/** The worst of `levels` (by id the alert in force), of equal ones the nearest; null where there is none. */
export function worstOf(levels) {
  const rank = (alert) => LEVELS.indexOf(alert.level);
  return [...levels.values()].filter(({ level }) => level !== "clear")
    .sort((a, b) => rank(b) - rank(a) || (a.distance ?? 0) - (b.distance ?? 0))[0] ?? null;
}

/** "STOP: 1 red, 0.27 m ahead, contact in 0.9 s" */
export function sentenceOf(alert, nameOf) {
  if (!alert) return t("noAlert");
  if (alert.level === "blind") return t("bannerBlind");
  const bearing = Math.round((alert.bearing ?? 0) * 180 / Math.PI);
  const way = Math.abs(bearing) < 5 ? "bannerAhead" : bearing < 0 ? "bannerRight" : "bannerLeft";
  const values = { level: alert.level.toUpperCase(), name: nameOf(alert.id), distance: figure(alert.distance, 2), degrees: Math.abs(bearing) };
  return t(way, values) + (alert.ttc == null ? "" : t("bannerContact", { seconds: figure(alert.ttc, 1) }));
}

const BEEPS = { notice: { hertz: 440, every: 1.2 }, warn: { hertz: 660, every: 0.5 }, stop: { hertz: 880, every: 0.22 }, blind: { hertz: 330, every: 0.7 } };

/** Beeps, the higher and the faster, the worse. Silent until it is switched on. */
class Sound {
  #context = null;
  #next = 0;

  get on() { return this.#context !== null; }
  toggle() {
    if (this.#context) {
      this.#context.close();
      this.#context = null;
    } else {
      this.#context = new AudioContext();
    }
    return this.on;
  }

  say(level) {
    const beep = BEEPS[level];
    if (!this.#context || !beep || this.#context.currentTime < this.#next) return;
    const now = this.#context.currentTime;
    this.#next = now + beep.every;
    const tone = new OscillatorNode(this.#context, { frequency: beep.hertz });
    const volume = new GainNode(this.#context, { gain: 0.12 });
    volume.gain.setTargetAtTime(0, now + 0.07, 0.015);
    tone.connect(volume).connect(this.#context.destination);
    tone.start(now);
    tone.stop(now + 0.15);
  }
}

const sound = new Sound();

export function bindSound() {
  byId("sound").onclick = () => byId("sound").setAttribute("aria-pressed", String(sound.toggle()));
}

const said = { key: "" };
/** `moves`: the robot drives now, and may be heard. */
export function showBanner({ levels, objects, moves }) {
  const alert = worstOf(levels);
  const nameOf = (id) => id === 0 ? t("something") : `${id} ${plain(objects.find((o) => o.id === id)?.name ?? "")}`.trim();
  const banner = byId("banner");
  const text = sentenceOf(alert, nameOf);
  if (banner.textContent !== text) banner.textContent = text;
  banner.classList.remove(...LEVELS);
  banner.classList.add(alert?.level ?? "clear");
  if (moves && alert) sound.say(alert.level);
  // Who listens to the page hears each level once, not each number.
  const key = `${alert?.level} ${alert?.id}`;
  if (key === said.key) return;
  said.key = key;
  byId("said").textContent = alert ? `${alert.level}, ${nameOf(alert.id)}` : t("noAlert");
}
