// An emulated Pico (tests/boards/pico) with an emulated camera at its serial line and a computer at its USB port. Its wheels turn as the camera's
// scene says. Its time passes only while it is run, and the camera's with it, however busy this machine is.
import { spawn } from "node:child_process";
import { openSync, readFileSync, writeSync } from "node:fs";
import { connect, createServer } from "node:net";
import { join } from "node:path";

const SLICE = 10_000;      // us of its time between two looks at its lines
const CAMERA_BEFORE = 3;   // s that the camera has had power when the part gets it
const PATIENCE = 300;      // s by the wall, until a program comes to rest
const HANDED_OVER = 1;     // ms until the kernel has handed what was written to its other end

const nap = (ms) => new Promise((done) => { setTimeout(done, ms); });
const wall = () => Number(process.hrtime.bigint()) * 1e-9;  // the monotonic clock

export class EmulatedPico {
  #children = [];
  #lines = {};
  #answers = [];
  #clock;
  #wheels;
  #camera;
  #begun = null;  // s of its time, when the camera's scene began
  #turned = 0;    // counts
  seconds = 0;

  /** `uf2`: the file that its drive was given. `emulator`, `partClock`, `cli`: programs. `scene`: what camera and wheels do, straight ahead;
   * `countsPerMetre` of a wheel. `heard(bytes)`: what comes from its USB port. */
  static async start({ uf2, folder, emulator, partClock, cli, camera, scene, countsPerMetre, heard }) {
    const pico = new EmulatedPico();
    pico.#wheels = (t) => Math.round(countsPerMetre * scene.at(t));
    pico.heard = heard;
    const clock = join(folder, "clock");
    pico.#clock = openSync(clock, "w+");
    pico.#tick();
    await pico.#attach(cli, camera, scene.file, { ...process.env, LD_PRELOAD: partClock, FENCEPOST_PART_CLOCK: clock });
    const names = ["console", "camera", "usb", "control"];
    const paths = names.map((name) => join(folder, `${name}.socket`));
    const coming = paths.map((path, i) => new Promise((done) => {
      const server = createServer((socket) => {
        pico.#lines[names[i]] = socket;
        server.close();
        done();
      }).listen(path);
    }));
    pico.#children.push(spawn(process.execPath, [emulator, uf2, ...paths], { stdio: ["ignore", "inherit", "inherit"] }));
    await Promise.all(coming);
    let said = "";
    pico.#lines.control.on("data", (bytes) => {
      said += bytes;
      for (let end = said.indexOf("\n"); end >= 0; end = said.indexOf("\n")) {
        pico.#answers.shift()(said.slice(0, end));
        said = said.slice(end + 1);
      }
    });
    pico.#lines.console.resume();
    pico.#lines.usb.on("data", (bytes) => pico.heard(bytes));
    pico.#lines.camera.on("data", (bytes) => { pico.#begun ??= pico.seconds; pico.#camera.write(bytes); });
    pico.#camera.on("data", (bytes) => pico.#lines.camera.write(bytes));
    pico.#tell("usb plug");
    return pico;
  }

  async #attach(cli, camera, scene, env) {
    const program = spawn(cli, ["emulate", camera, scene, "--listen", "0"], { env, stdio: ["ignore", "pipe", "inherit"] });
    this.#children.push(program);
    const place = await new Promise((done, fail) => {
      let said = "";
      program.stdout.on("data", (bytes) => {
        said += bytes;
        const [, port] = /127\.0\.0\.1:(\d+)/.exec(said) ?? [];
        if (port) done(port);
      });
      program.on("exit", () => fail(new Error(`the camera's emulator has ended: ${said}`)));
    });
    this.#camera = connect(Number(place), "127.0.0.1");
    await new Promise((done) => { this.#camera.once("connect", done); });
    for (let t = 0; t < CAMERA_BEFORE; t += SLICE * 1e-6) {
      this.#tick(t - CAMERA_BEFORE);
      await nap(HANDED_OVER);
    }
  }

  #tick(seconds = this.seconds) {
    const now = Buffer.alloc(16);
    now.writeDoubleLE(wall(), 0);
    now.writeDoubleLE(CAMERA_BEFORE + seconds, 8);
    writeSync(this.#clock, now, 0, 16, 0);
  }

  #tell(line) { this.#lines.control.write(`${line}\n`); }
  /** A question of emulate.mjs's, and its answer. */
  ask(line) {
    this.#tell(line);
    return new Promise((done) => { this.#answers.push(done); });
  }

  /** To its USB port. */
  send(bytes) { this.#lines.usb.write(bytes); }

  // Its time waits for a program that this machine has not let run yet.
  async #rest() {
    const { pid } = this.#children[0];
    for (const until = wall() + PATIENCE; ;) {
      await nap(HANDED_OVER);
      if (!/[RD]/.test(readFileSync(`/proc/${pid}/stat`, "utf8").split(")").at(-1).trim()[0])) return;
      if (wall() > until) throw new Error("the camera's emulator never comes to rest");
    }
  }

  async #slice() {
    await this.#rest();
    const counts = this.#begun === null ? 0 : this.#wheels(this.seconds - this.#begun) - this.#turned;
    this.#turned += counts;
    const each = Math.floor(SLICE / Math.max(1, counts));
    if (counts) this.#tell(`turn ${counts} ${counts} ${each}`);
    this.seconds = Number((await this.ask(`run ${counts ? SLICE - counts * each : SLICE}`)).split(" ")[1]) * 1e-6;
    this.#tick();
  }

  /** Until that is so, and it is looked at each 50 ms; throws after `most` seconds of the part's. */
  async run(what, most) {
    for (const end = this.seconds + most; this.seconds < end;) {
      for (let i = 0; i < 5; ++i) await this.#slice();
      if (await what()) return;
    }
    throw new Error(`not within ${most} s of the part's time: ${what}`);
  }

  end() {
    for (const child of this.#children) child.kill("SIGKILL");
    for (const socket of [this.#camera, ...Object.values(this.#lines)]) socket?.destroy();
  }
}
