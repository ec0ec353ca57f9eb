// A board from the page: choices become a board's file by `configure`, compiled into the page's loop.
import { Daplink } from "./daplink.js";
import { fromBase64, unpacked } from "./data.js";
import { Dfuse } from "./dfuse.js";
import { byId, download, make, plain } from "./dom.js";
import { drawBoard } from "./drawing.js";
import { Picoboot, RP2040, RP2350 } from "./picoboot.js";
import { ask } from "./serial.js";
import { Differs, Refused } from "./usb.js";
import { onLanguage, t } from "./words.js";

// As they are called by their images; what to press and where the file goes (host/share/doc/boards.md).
const BOARDS = {
  netduino_plus_2: { name: "Netduino Plus 2", usb: "stm32", button: true, steps: ["stepButton", "stepDfu", "stepUnplug"] },
  pyboard: { name: "pyboard 1.0, 1.1", usb: "stm32", wire: ["DFU (BOOT0)", "3V3"], steps: ["stepWire", "stepDfu", "stepUnwire"] },
  feather_f405: { name: "Feather STM32F405", usb: "stm32", wire: ["B0 (BOOT0)", "3.3V"], steps: ["stepWire", "stepDfu", "stepUnwire"] },
  pico: { name: "Raspberry Pi Pico, Pico W", usb: "rp2040", drive: "RPI-RP2", button: "BOOTSEL", steps: ["stepBootsel", "stepDrag"] },
  xrp: { name: "XRP (2023)", usb: "rp2040", drive: "RPI-RP2", button: "BOOTSEL", steps: ["stepXrp", "stepDrag"] },
  pico2: { name: "Raspberry Pi Pico 2, Pico 2 W", usb: "rp2350", drive: "RP2350", button: "BOOTSEL", steps: ["stepBootsel", "stepDrag"] },
  xrp2: { name: "XRP (2024)", usb: "rp2350", drive: "RP2350", button: "BOOTSEL", steps: ["stepXrp", "stepDrag"] },
  microbit: { name: "micro:bit v1", usb: "daplink", drive: "MICROBIT", steps: ["stepMicrobit", "stepDrag"] },
  microbit_v2: { name: "micro:bit v2", usb: "daplink", drive: "MICROBIT", steps: ["stepMicrobit", "stepDrag"] },
  gba: { name: "Game Boy Advance", card: true, steps: ["stepCartridge"] },
};
// Writers by WebUSB: the file that each takes, its class, and the device's number for Linux.
const WRITERS = {
  rp2040: { format: "uf2", choose: (usb) => Picoboot.choose(usb, RP2040), device: "2e8a:0003" },
  rp2350: { format: "uf2", choose: (usb) => Picoboot.choose(usb, RP2350), device: "2e8a:000f" },
  stm32: { format: "dfu", choose: (usb) => Dfuse.choose(usb), device: "0483:df11" },
  daplink: { format: "hex", choose: (usb) => Daplink.choose(usb), device: "0d28:0204", unread: true },
};
const WHEELS = { console: "wheelsConsole", encoders: "wheelsEncoders", create1: "wheelsCreate1", create2: "wheelsCreate2" };
const SIZES = { "board-diameter": "wheel.diameter", "board-counts": "wheel.counts", "board-track": "wheel.track" };
const TYPES = { uf2: "application/octet-stream", dfu: "application/octet-stream", hex: "text/plain", bin: "application/octet-stream", sav: "application/octet-stream" };

export const isImage = (name) => /\.(uf2|hex|bin|gba)$/i.test(name);

const value = (id) => byId(id).value;
const metres = (id) => Math.round(100 * Number(value(id))) / 10_000;

const centimetres = (length) => String(Math.round(10_000 * length) / 100);

/** The form as the arguments of `fencepost configure`. */
function requestOf(about) {
  const camera = about.cameras.find(({ name }) => name === value("board-camera"));
  const settings = [["camera", camera.name]];
  if (Number(value("board-lens"))) settings.push(["lens", value("board-lens")]);
  settings.push(["odometry", value("board-odometry")]);
  if (value("board-odometry") === "encoders") for (const [id, key] of Object.entries(SIZES)) settings.push([key, value(id)]);
  const mount = { x: metres("board-ahead"), y: 0, z: metres("board-height"), yaw: 0, pitch: 0 };
  const robot = { ...(camera.delivered ? { camera: { mount } } : {}), robot: { width: metres("board-width") } };
  return { robot: JSON.stringify(robot), settings };
}

/** `$FPCFG` lines that a robot keeps: [[key, value]]. */
const keptBy = (lines) => lines.map((line) => /^\$FPCFG,([^,]*),([^*]*)\*/.exec(line)).filter(Boolean).map(([, key, wanted]) => [key, wanted]);

// In the answer of `status`, the line of settings: the one of links has both words, too.
const ANSWERED = /^camera (?!link )(\S+)[^\n]*; odometry (\w+)[^\n]*\n/m;
const CALIBRATED = /^\$FPCAM,[^\n]*\n/m;  // with where it is mounted

/** Settings that the robot says otherwise than was chosen: [{ key, wanted, found }]; null if it answered nothing. */
export function differences(answer, chosen) {
  const said = new Map([...answer.matchAll(/^([\w.]+) = (\S+)/gm)].map(([, key, found]) => [key, found.replace(/;$/, "")]));
  const status = ANSWERED.exec(answer);
  if (!status) return null;
  const [, x, , z] = /^\$FPCAM,(?:[^,]*,){8}([^,]*),([^,]*),([^,]*),/m.exec(answer) ?? [];
  const facts = new Map([...said, ["camera", status[1].replace(/,$/, "")], ["odometry", status[2]],
    ...z === undefined ? [] : [[t("boardAhead"), centimetres(x)], [t("boardHeight"), centimetres(z)]]]);
  const same = (a, b) => a === b || (a !== undefined && a !== "" && Number(a) === Number(b));
  return chosen.filter(([key, wanted]) => !same(facts.get(key), wanted)).map(([key, wanted]) => ({ key, wanted, found: facts.get(key) ?? t("checkNothing") }));
}

/** `images`: [{ board, image }] of this copy of the page; `engine()`: another loop. */
export class BoardPanel {
  #engine;
  #images;
  #image = null;   // bytes
  #about = null;
  #made = null;    // { file, said, name, request }

  constructor(engine, images) {
    this.#engine = engine;
    this.#images = images;
    byId("board-open").onclick = () => this.show(byId("board").hidden);
    byId("board-image").onchange = () => this.#choose();
    byId("board-file").onchange = async (event) => {
      const [file] = event.target.files;
      event.target.value = "";
      if (file) await this.load(file.name, new Uint8Array(await file.arrayBuffer()));
    };
    for (const element of document.querySelectorAll("#board-form input, #board-form select")) element.oninput = () => this.#make();
    byId("board-camera").oninput = byId("board-odometry").oninput = () => { this.#offer(); this.#make(); };
    byId("board-format").oninput = () => this.#make();
    byId("board-download").onclick = () => download(this.#made.name, [this.#made.file], TYPES[value("board-format")]);
    byId("board-write").onclick = () => this.#write();
    byId("board-check").onclick = () => this.#check();
    onLanguage(() => this.#name());
    this.#name();
  }

  show(on = true) {
    byId("board").hidden = !on;
    byId("board-open").setAttribute("aria-pressed", String(on));
    if (on) byId("board").scrollIntoView({ block: "nearest" });
  }

  // The board's list, and all that is put together of words.
  #name() {
    const chosen = value("board-image");
    byId("board-image").replaceChildren(make("option", { value: "" }, t("choose")),
      ...this.#images.map(({ board }, i) => make("option", { value: i }, BOARDS[board]?.name ?? board)));
    byId("board-image").value = chosen;
    byId("board-which").hidden = !this.#images.length;
    byId("board-none").hidden = Boolean(this.#images.length);
    if (!this.#about) return;
    this.#offer();
    this.#make();
  }

  async #choose() {
    const one = this.#images[Number(value("board-image"))];
    if (value("board-image") !== "") await this.load(`${one.board}.bin`, await unpacked(fromBase64(one.image)));
  }

  /** A board's image. */
  async load(name, bytes) {
    this.show();
    this.#about = this.#made = null;
    try {
      this.#about = this.#engine().board(bytes);
      this.#image = bytes;
      this.#complain("");
      const { initial, cameras, formats, board } = this.#about;
      const own = this.#images.findIndex((one) => one.board === board);
      byId("board-image").value = own >= 0 ? String(own) : "";
      byId("board-camera").replaceChildren(...cameras.map((camera) => make("option", {}, camera.name)));
      byId("board-camera").value = initial.camera;
      byId("board-format").replaceChildren(...formats.map((format) => make("option", { value: format }, `.${format}`)));
      for (const [id, key] of Object.entries(SIZES)) byId(id).value = Number(initial[key]);
      byId("board-lens").value = initial.lens;
      this.#offer(initial.odometry);
      this.#make();
    } catch (error) {
      this.#complain(`${plain(name)}: ${error.message}`);
    }
    byId("board-form").hidden = byId("board-result").hidden = !this.#about;
  }

  // Offers only what the board can have beside the chosen camera.
  #offer(odometry = value("board-odometry")) {
    const camera = this.#about.cameras.find(({ name }) => name === value("board-camera"));
    byId("board-odometry").replaceChildren(...camera.odometries.map((name) => make("option", { value: name }, t(WHEELS[name]))));
    byId("board-odometry").value = camera.odometries.includes(odometry) ? odometry : camera.odometries[0];
    byId("board-mount").hidden = !camera.delivered;
    byId("board-no-mount").hidden = camera.delivered;
    byId("board-sizes").hidden = value("board-odometry") !== "encoders";
    if (!camera.delivered) byId("board-lens").value = 0;
  }

  #make() {
    const format = value("board-format");
    const { board: target, version } = this.#about;
    const board = BOARDS[target] ?? { name: target, steps: ["stepUnknown"] };
    const name = `my-${target}.${format}`;
    try {
      const request = { format, ...requestOf(this.#about) };
      this.#made = { ...this.#engine().configure(this.#image, request), name, request };
      this.#complain("");
    } catch (error) {
      this.#made = null;
      this.#complain(error.message);
    }
    const made = this.#made;
    const pressed = made !== null;
    for (const id of ["board-download", "board-write", "board-check"]) byId(id).disabled = !pressed;
    byId("board-download").textContent = t("boardDownload", { file: name });
    byId("board-usb").hidden = !(navigator.usb && WRITERS[board.usb]?.format === format);
    byId("board-check").hidden = !navigator.serial;
    if (!pressed) return;
    const { lines, used, room } = made.said;
    byId("board-said").textContent = t("boardSaid", { board: board.name, version, used, room });
    byId("board-lines").textContent = lines.join("\n");
    const values = { file: name, drive: board.drive, from: board.wire?.[0], to: board.wire?.[1], version,
      command: `dfu-util -d 0483:df11 -a 0 -s :leave -D my-${target}.dfu` };
    byId("board-steps").replaceChildren(...board.steps.map((step) => make("li", {}, t(step, values))));
    drawBoard(byId("board-drawing"), board, name);
  }

  #complain(text) { byId("board-error").textContent = plain(text); }
  #tell(text) { byId("board-state").textContent = plain(text); }

  async #write() {
    const button = byId("board-write");
    const writer = WRITERS[BOARDS[this.#about.board].usb];
    this.#complain("");
    button.disabled = true;
    try {
      const board = await writer.choose(navigator.usb);
      const bytes = await board.flash(this.#made.file, (step, share) => this.#tell(t(step, { percent: Math.round(100 * share) })));
      this.#tell(t(writer.unread ? "usbHanded" : "usbDone", { bytes }));
    } catch (error) {
      this.#tell("");
      this.#complain(error instanceof Refused ? t("usbRefused", error)
        : error instanceof Differs ? t("usbDiffers", { address: `0x${error.address.toString(16)}` })
          : error.name === "NotFoundError" ? t("usbNotChosen", writer) : t("usbFailed", { detail: error.message }));
    }
    button.disabled = false;
  }

  async #check() {
    const button = byId("board-check");
    const settings = [...new Map([...this.#made.request.settings, ...keptBy(this.#made.said.lines)])];
    const mounted = this.#about.cameras.some(({ name, delivered }) => delivered && name === value("board-camera"));
    const chosen = [...settings, ...mounted ? [[t("boardHeight"), centimetres(metres("board-height"))], [t("boardAhead"), centimetres(metres("board-ahead"))]] : []];
    this.#complain("");
    this.#tell(t("checkAsking"));
    button.disabled = true;
    try {
      const answer = await ask(navigator.serial, ["mode text", ...settings.map(([key]) => `get ${key}`), "status", ...mounted ? ["mode log"] : []],
        (said) => ANSWERED.test(said) && (!mounted || CALIBRATED.test(said)));
      const wrong = differences(answer, chosen);
      this.#tell(wrong?.length === 0 ? t("checkSame", { count: chosen.length }) : "");
      if (!wrong) this.#complain(t("checkSilent"));
      else this.#complain(wrong.map((one) => t("checkDiffers", one)).join(" "));
    } catch (error) {
      this.#tell("");
      this.#complain(t("checkPort", { detail: error.message }));
    }
    button.disabled = false;
  }
}
