// A robot on a serial port of this machine, by the browser's Web Serial.

const ASK_EVERY = 3000;   // ms
const ASKS = 5;           // many boards restart when their port is opened
const SILENT = 4000;      // ms
const STRANGE = 0.2;      // share of bytes that no text has: a wrong speed

const LINUX = "On Linux: sudo usermod -aG dialout $USER, then log in again.";
const ERRORS = {
  NotFoundError: ["No port was chosen.", "Plug the robot in and choose it in the list. An empty list: the cable carries power only, or the board's driver is missing."],
  SecurityError: ["The browser does not let this page use serial ports.", "Open the page itself, not inside another page, and allow serial ports in the browser's site settings; or record with: fencepost record PORT"],
  InvalidStateError: ["The port is open already.", "Close the other tab of this page that uses it, or unplug the robot and plug it in again."],
  NetworkError: ["The port could not be opened, or the robot was unplugged.", `Close what else uses it: an Arduino or Mu window, a terminal, fencepost record. ${LINUX}`],
  NotReadableError: ["The port cannot be read.", `Close what else uses it. ${LINUX}`],
  FramingError: ["Bytes come at another speed.", "Choose the robot's speed: 115200 for our images, 57600 for the Game Boy Advance."],
  ParityError: ["Bytes come with parity.", "Set the robot's port to 8N1."],
  BreakError: ["The line was held down.", "Check the wires: the robot's TX goes to the adapter's RX, and both share ground."],
  BufferOverrunError: ["The page was too slow and bytes were lost.", "Close other tabs, keep this one in front, and record again."],
};

/** { says, try } for whatever a port throws. */
export function explain(error) {
  const [says, fix] = ERRORS[error?.name] ?? ["The port failed.", "Unplug the robot, plug it in again and connect anew."];
  return { says, fix, detail: error?.message ?? String(error) };
}

export const ABSENT = {
  says: "This browser has no Web Serial.",
  fix: "Use Chrome, Edge or Opera on a desk computer; or record with: fencepost record PORT -o run.log, and drop the file here.",
  detail: "navigator.serial is missing",
};

/** What the bytes up to now suggest; null: all is well. `quiet`: ms since the last one. */
export function diagnose({ bytes, strange, records, quiet }) {
  if (quiet > SILENT) {
    return { says: bytes ? "The robot has stopped talking." : "The port is open, but nothing comes.", detail: `silent for ${(quiet / 1000).toFixed(0)} s`,
      fix: "Is the robot switched on? Is it the right port, and is TX wired to RX? Some cables carry power only." };
  }
  if (bytes > 200 && strange / bytes > STRANGE) {
    return { says: "What comes is no text.", fix: "Choose another speed: the robot's console has 115200 unless told otherwise.", detail: `${strange} of ${bytes} bytes` };
  }
  if (bytes > 2000 && records === 0) {
    return { says: "Text comes, but no record.", fix: "Tick 'ask for mode log' and connect again, or type mode log on the robot's console.", detail: `${bytes} bytes` };
  }
  return null;
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

  constructor(listeners) { this.listeners = listeners; }

  get open() { return this.#port !== null; }
  get quiet() { return performance.now() - this.#last; }

  async connect(serial, baudRate, asks) {
    const port = await serial.requestPort();
    await port.open({ baudRate, bufferSize: 65536 });
    this.#port = port;
    this.#closing = false;
    this.#last = performance.now();
    this.#read();
    if (asks) this.#askOften();
  }

  /** Until a record has come (`answered`), a few times. */
  async #askOften() {
    for (let i = 0; i < ASKS && this.open && !this.answered; ++i) {
      await this.#ask("\rmode log\r");
      await new Promise((resolve) => setTimeout(resolve, ASK_EVERY));
    }
  }

  async #ask(text) {
    const writer = this.#port?.writable?.getWriter();
    if (!writer) return;
    try { await writer.write(new TextEncoder().encode(text)); } catch { /* reading says what is wrong */ }
    writer.releaseLock();
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
    try {
      await this.#reader?.cancel();
      await port.close();
    } catch { /* it is gone */ }
    this.listeners.ended();
  }
}

/** A robot's answers to lines that are typed one after the other, until its `status` has come. */
export async function ask(serial, lines, patience = SILENT) {
  const port = await serial.requestPort();
  await port.open({ baudRate: 115200, bufferSize: 65536 });
  const reader = port.readable.getReader();
  const decoder = new TextDecoder();
  let answer = "";
  const late = setTimeout(() => reader.cancel().catch(() => {}), patience);
  try {
    const writer = port.writable.getWriter();
    await writer.write(new TextEncoder().encode(lines.map((line) => `\r${line}\r`).join("")));
    writer.releaseLock();
    while (!/^camera [^\n]*; odometry [^\n]*\n/m.test(answer)) {
      const { value, done } = await reader.read();
      if (done) break;
      answer += decoder.decode(value, { stream: true });
    }
  } finally {
    clearTimeout(late);
    await reader.cancel().catch(() => {});
    reader.releaseLock();
    await port.close();
  }
  return answer.replaceAll("\r", "");
}
