// A robot on a serial port of this machine, by the browser's Web Serial.
import { within } from "./patience.js";
import { t } from "./words.js";

const ASK_EVERY = 3000;   // ms
const ASKS = 5;           // many boards restart when their port is opened
const SILENT = 4000;      // ms
const OPENS = 10_000;     // ms, at most: a port of a radio waits for its other end
const STRANGE = 0.2;      // share of bytes that no text has: a wrong speed

const ERRORS = {
  NotFoundError: ["errNotFound", "fixNotFound"], SecurityError: ["errSecurity", "fixSecurity"], InvalidStateError: ["errOpen", "fixOpen"],
  NetworkError: ["errNetwork", "fixNetwork"], TimeoutError: ["errNetwork", "fixNetwork"], NotReadableError: ["errRead", "fixRead"], FramingError: ["errFraming", "fixFraming"],
  ParityError: ["errParity", "fixParity"], BreakError: ["errBreak", "fixBreak"], BufferOverrunError: ["errOverrun", "fixOverrun"],
};

/** { says, fix, detail } for whatever a port throws. */
export function explain(error) {
  const [says, fix] = ERRORS[error?.name] ?? ["errPort", "fixPort"];
  return { says: t(says), fix: t(fix, { linux: t("linuxGroup") }), detail: error?.message ?? String(error) };
}

export const absent = () => ({ says: t("errNoSerial"), fix: t("fixNoSerial"), detail: "navigator.serial" });

/** The fault that the bytes up to now suggest; null: all is well. `quiet`: ms since the last one. */
export function diagnose({ bytes, strange, records, quiet }) {
  if (quiet > SILENT) {
    return { says: t(bytes ? "errStopped" : "errNothing"), detail: t("silentFor", { seconds: (quiet / 1000).toFixed(0) }), fix: t("fixSilent") };
  }
  if (bytes > 200 && strange / bytes > STRANGE) {
    return { says: t("errNoText"), fix: t("fixNoText"), detail: t("strangeBytes", { strange, bytes }) };
  }
  if (bytes > 2000 && records === 0) return { says: t("errNoRecord"), fix: t("fixNoRecord"), detail: t("someBytes", { bytes }) };
  return null;
}

/** The port that the user chooses, open. */
async function opened(serial, baudRate) {
  const port = await serial.requestPort();
  const opening = port.open({ baudRate, bufferSize: 65536 });
  try {
    await within(OPENS, opening);
  } catch (error) {
    opening.then(() => port.close()).catch(() => {});  // else it would stay open once it is there
    throw error;
  }
  return port;
}

// A robot that reads nothing would keep the port busy: what it did not take is thrown away. `typing.writer`: while it lasts.
async function type(port, text, typing = {}) {
  const writer = port.writable.getWriter();
  typing.writer = writer;
  try {
    await within(SILENT, writer.write(new TextEncoder().encode(text)));
  } catch (error) {
    writer.abort(error).catch(() => {});
    throw error;
  } finally {
    typing.writer = null;
    writer.releaseLock();
  }
}

/** Opens a port and passes on what comes, from the first byte. `heard(bytes)`, `failed(explanation)`, `ended()`. */
export class Robot {
  answered = false;
  bytes = 0;
  strange = 0;
  recording = [];
  #port = null;
  #reader = null;
  #last = 0;
  #closing = false;
  #typing = {};

  constructor(listeners) { this.listeners = listeners; }

  get open() { return this.#port !== null; }
  get quiet() { return performance.now() - this.#last; }

  async connect(serial, baudRate, asks) {
    this.#port = await opened(serial, baudRate);
    this.#closing = false;
    this.#last = performance.now();
    this.#read();
    if (asks) this.#askOften();
  }

  /** For a log from the beginning of a run, until a record has come (`answered`), a few times. */
  async #askOften() {
    for (let i = 0; i < ASKS && this.open && !this.answered; ++i) {
      await this.#ask("\rmode log\rreset\r");
      await new Promise((resolve) => setTimeout(resolve, ASK_EVERY));
    }
  }

  async #ask(text) {
    try { if (this.#port?.writable) await type(this.#port, text, this.#typing); } catch { /* reading says what is wrong */ }
  }

  async #read() {
    while (this.#port?.readable && !this.#closing) {
      this.#reader = this.#port.readable.getReader();
      try {
        for (;;) {
          const { value, done } = await this.#reader.read();
          if (done) break;
          this.#hear(value);
        }
      } catch (error) {
        if (!this.#closing) this.listeners.failed(explain(error));
      } finally {
        this.#reader.releaseLock();
      }
      if (!this.#port?.readable) break;
      await new Promise((resolve) => setTimeout(resolve, 50));
    }
    if (!this.#closing) await this.close();
  }

  #hear(value) {
    this.#last = performance.now();
    this.bytes += value.length;
    for (const byte of value) if (byte > 126 || (byte < 32 && byte !== 10 && byte !== 13 && byte !== 9)) ++this.strange;
    this.recording.push(value);
    this.listeners.heard(value);
  }

  async close() {
    if (!this.#port) return;
    this.#closing = true;
    const port = this.#port;
    this.#port = null;
    const { writer } = this.#typing;
    writer?.abort().catch(() => {});
    writer?.releaseLock();
    try {
      await within(SILENT, this.#reader?.cancel());
      await within(SILENT, port.close());
    } catch { /* it is gone */ }
    this.listeners.ended();
  }
}

/** A robot's answers to lines that are typed one after the other, until they are `whole`. It is in mode text then. */
export async function ask(serial, lines, whole, patience = SILENT) {
  const port = await opened(serial, 115200);
  const reader = port.readable.getReader();
  const decoder = new TextDecoder();
  let answer = "";
  const late = setTimeout(() => reader.cancel().catch(() => {}), patience);
  try {
    await type(port, lines.map((line) => `\r${line}\r`).join(""));
    while (!whole(answer)) {
      const { value, done } = await reader.read();
      if (done) break;
      answer += decoder.decode(value, { stream: true });
    }
    if (port.writable) await type(port, "\rmode text\r");
  } finally {
    clearTimeout(late);
    await reader.cancel().catch(() => {});
    reader.releaseLock();
    await within(SILENT, port.close()).catch(() => { /* it is gone */ });
  }
  return answer.replaceAll("\r", "");
}
