// usage: node teacher_test.mjs PAGE CLI NPM SHARE [PART]: a teacher's way. Board, camera, lens height and wheels are chosen on the page. The file is
// downloaded and put onto the drive of an emulated Pico. The page asks the robot by its USB port, shows its map, and a STOP. The pin falls.
// FENCEPOST_IMAGES: a folder with pico/fencepost.bin. FENCEPOST_PICO: emulate.mjs, beside its packages. FENCEPOST_PART_CLOCK: the library.
import assert from "node:assert/strict";
import { copyFileSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { withImages } from "./board_images.mjs";
import { EmulatedPico } from "./emulated_pico.mjs";
import { Browser, POLLED, Tools, run, text } from "./harness.mjs";

const STANDS = 5;    // s of the camera's scene, until the robot sets off
const DRIVES = 5;    // s
const WAY = 0.6;     // m
const TIN = 0.85;    // m ahead of where it stands
const DIAMETER = 0.065;  // m, and counts of a turn: what the page offers at first
const COUNTS = 1440;
const ANSWERS = 20;  // s of the part's time, at most, until the robot has answered; a camera that is found late among them
const tools = new Tools(process.argv.slice(2));
const folder = mkdtempSync(join(tmpdir(), "fencepost-teacher-"));
const drive = join(folder, "RPI-RP2");
const scene = {
  format: 1, seed: 1,
  camera: { model: "pixy2.1", width: 316, height: 208, fx: 188.3, fy: 188.3, cx: 157.5, cy: 103.5, k1: 0, mount: { x: 0, y: 0, z: 0.12, yaw: 0, pitch: 0 }, latency: 0.033, rate: 25, max_blobs: 16 },
  robot: { width: 0.2 }, signatures: [{ id: 1, name: "red", rgb: "d02020" }],
  objects: [{ name: "red tin", signature: 1, height: 0.1, footprint: { circle: [TIN, 0, 0.05] } }],
  path: { type: "poses", poses: [[0, 0], [STANDS, 0], [STANDS + DRIVES, WAY], [STANDS + 60, WAY]].map(([t, x]) => ({ t, x, y: 0, heading: 0 })) },
};
const at = (t) => WAY * Math.min(1, Math.max(0, (t - STANDS) / DRIVES));

/** Runs in the page: navigator.serial with the port of the robot, which the test has. Its time is slower than the page's: what the page waits
 * for it lasts longer. */
function port() {
  const wait = window.setTimeout;
  window.setTimeout = (what, ms, ...more) => wait(what, ms >= 1000 ? 100 * ms : ms, ...more);
  let come = null;
  window.fromRobot = (said) => come?.enqueue(new TextEncoder().encode(said));
  const one = {
    async open() {
      one.readable = new ReadableStream({ start(controller) { come = controller; }, cancel() { come = null; } });
      one.writable = new WritableStream({ write: (bytes) => window.toRobot(new TextDecoder().decode(bytes)) });
    },
    async close() { one.readable = one.writable = null; },
  };
  Object.defineProperty(navigator, "serial", { value: { requestPort: async () => one }, configurable: true });
}

const browser = await Browser.start(tools);
let page;
let pico = null;
const said = [];
const begun = Date.now();
const step = (name) => console.log(`     ${((Date.now() - begun) / 1000).toFixed(0)} s, ${pico?.seconds.toFixed(1) ?? "0"} s of the robot's: ${name}`);
/** Hands the robot's words to the page; the page's answer to `question`. */
async function onPage(question) {
  const words = Buffer.concat(said.splice(0)).toString("latin1");
  return page.evaluate(([more, ask]) => {
    if (more) window.fromRobot(more);
    return document.querySelector(ask.of)?.[ask.is];
  }, [words, question]);
}
const says = (of) => onPage({ of, is: "textContent" });

await run({
  async "board, camera, lens and wheels are chosen; the file goes onto the drive of the Pico"() {
    const file = withImages(tools.page, join(folder, "boards.html"), { pico: readFileSync(join(process.env.FENCEPOST_IMAGES, "pico/fencepost.bin")) });
    page = await browser.open({ file, offline: true, before: { run: port } });
    await page.exposeFunction("toRobot", (words) => pico.send(Buffer.from(words, "latin1")));
    await page.click("#board-open");
    await page.selectOption("#board-image", { label: "Raspberry Pi Pico, Pico W" });
    await page.selectOption("#board-camera", "pixy2.1");
    await page.selectOption("#board-odometry", "encoders");
    await page.fill("#board-height", "12");
    await page.waitForFunction(() => document.getElementById("board-lines").textContent.includes("FPCFG,odometry,encoders"), null, POLLED);
    const download = page.waitForEvent("download");
    await page.click("#board-download");
    const configured = join(folder, (await download).suggestedFilename());
    await (await download).saveAs(configured);
    mkdirSync(drive);
    copyFileSync(configured, join(drive, "my-pico.uf2"));
    step("the file is on the drive");
  },

  async "the robot starts; it has what was chosen"() {
    const [uf2] = readdirSync(drive);
    writeFileSync(join(folder, "scene.json"), JSON.stringify(scene));
    pico = await EmulatedPico.start({ uf2: join(drive, uf2), folder, emulator: process.env.FENCEPOST_PICO, partClock: process.env.FENCEPOST_PART_CLOCK, cli: tools.cli,
      camera: "pixy2.1", scene: { file: join(folder, "scene.json"), at }, countsPerMetre: COUNTS / (Math.PI * DIAMETER), heard: (bytes) => said.push(bytes) });
    let all = "";
    await pico.run(() => { all += Buffer.concat(said.splice(0)); return all.includes("camera works"); }, ANSWERS);
    step("the camera works");
    await page.click("#board-check");
    await pico.run(async () => await says("#board-state") !== "Asking …" && (await says("#board-state") || await says("#board-error")), ANSWERS);
    assert.match(await says("#board-state"), /^The robot has what you chose: \d+ settings compared\.$/, await says("#board-error"));
    step("it has what was chosen");
  },

  async "its map grows on the page; a STOP comes, and the pin falls"() {
    await page.click("#connect");
    await page.click("#port-open");
    await pico.run(async () => Number(/(\d+) records/.exec(await says("#port-state"))?.[1]) > 10, ANSWERS);
    await pico.run(async () => JSON.parse(await pico.ask("stop")).at(-1)?.[1] === 1, ANSWERS);  // it may drive
    assert.match(await text(page, "#banner"), /^(No alert|NOTICE)/);
    step("the page shows the robot");
    await pico.run(async () => (await says("#banner")).startsWith("STOP"), STANDS + DRIVES);
    step(await says("#banner"));
    assert.match(await says("#banner"), /^STOP: (1|something), 0\.\d+ m ahead/);
    await pico.run(async () => (await says("#alerts")).includes("stop"), 2);
    const pin = JSON.parse(await pico.ask("stop"));
    assert.deepEqual(pin.slice(-2).map(([, level]) => level), [1, 0], `it rose, and fell: ${JSON.stringify(pin)}`);
    step(`the pin fell at ${(pin.at(-1)[0] * 1e-6).toFixed(2)} s`);
  },

  async "what was recorded has the same digest here and at the desk, and the robot's own alerts"() {
    const download = page.waitForEvent("download");
    await page.click("#port-save");
    const log = join(folder, "robot.log");
    await (await download).saveAs(log);
    await page.click("#port-close");
    await page.waitForSelector("#digest");
    assert.equal(await text(page, "#digest"), tools.digest(log));
    assert.match(await text(page, "#facts"), /agrees in all \d+ records compared/);
  },

  async "nothing was asked of a network, and nothing failed"() {
    assert.deepEqual(browser.requests, []);
    assert.deepEqual(browser.errors, []);
  },
}, process.argv[6]);
pico?.end();
await browser.close();
rmSync(folder, { recursive: true });
