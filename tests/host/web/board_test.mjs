// usage: node board_test.mjs PAGE CLI NPM SHARE [PART]
// A board's file from the page is that of `fencepost configure`. The page writes it to a board, and asks the robot.
// FENCEPOST_IMAGES: a folder of real images, BOARD/fencepost.bin.
import assert from "node:assert/strict";
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { gunzipSync } from "node:zlib";
import { Engine } from "../../../host/web/src/engine.js";
import { IMAGES, withImages } from "./board_images.mjs";
import { Browser, POLLED, Tools, hurry, run, text } from "./harness.mjs";
import { standInDaplink } from "./stand_in_daplink.mjs";
import { standInDfu } from "./stand_in_dfu.mjs";
import { standInUsb } from "./stand_in_usb.mjs";

const tools = new Tools(process.argv.slice(2));
const folder = mkdtempSync(join(tmpdir(), "fencepost-board-"));
const page = readFileSync(tools.page, "utf8");
const bundle = JSON.parse(/id="bundle">(.*?)<\/script>/s.exec(page)[1]);
const engine = await Engine.create(gunzipSync(Buffer.from(bundle.wasm, "base64")));

let files = 0;
/** The file that the desk's program writes. */
function desk(image, format, robot, settings) {
  const [input, wishes, output] = ["image.bin", "robot.json", `mine-${++files}.${format}`].map((name) => join(folder, name));
  writeFileSync(input, image);
  writeFileSync(wishes, robot);
  const named = settings.flatMap(([key, value]) => ["camera", "lens", "odometry"].includes(key) ? [`--${key}`, value] : ["--set", `${key}=${value}`]);
  tools.says("configure", input, "--robot", wishes, ...named, "-o", output);
  return readFileSync(output);
}

const mount = (z, x = 0) => ({ camera: { mount: { x, y: 0, z, yaw: 0, pitch: 0 } } });
function wishesOf({ cameras }) {
  const first = cameras[0];
  const last = cameras.at(-1);
  const wheels = last.odometries.at(-1);
  return [
    [{}, []],
    [{ ...(last.delivered ? mount(0.153, 0.02) : {}), robot: { width: 0.18 } }, [["camera", last.name], ["odometry", wheels]]],
    [{ ...(first.delivered ? mount(0.12) : {}), settings: { "alert.stop": 0.3 }, signatures: [{ id: 1, name: "red", rgb: "d02020" }] },
      [["camera", first.name], ["wheel.diameter", "61.5"], ["wheel.track", "155"], ["alert.warn", "0.8"]]],
  ];
}

function expectSameAsDesk(image) {
  const about = engine.board(image);
  for (const [robot, settings] of wishesOf(about)) {
    for (const format of about.formats) {
      const wish = JSON.stringify(robot);
      const { file, said } = engine.configure(image, { format, robot: wish, settings });
      assert.equal(said.board, about.board);
      assert.ok(Buffer.from(file).equals(desk(image, format, wish, settings)), `${about.board}, .${format}: ${JSON.stringify(settings)}`);
    }
  }
  return about;
}

const PAGE = withImages(tools.page, join(folder, "boards.html"));

/** A robot's console on a serial port: it answers `get KEY` and `status` by what window.robot has. */
function standInConsole() {
  window.robot = {};
  const port = {
    async open() {
      if (port.readable) throw new DOMException("open already", "InvalidStateError");
      let say;
      port.readable = new ReadableStream({ start(controller) { say = (line) => controller.enqueue(new TextEncoder().encode(`${line}\r\n`)); } });
      port.writable = new WritableStream({ write(bytes) {
        if (window.robot.deaf) return new Promise(() => {});
        for (const line of new TextDecoder().decode(bytes).split(/[\r\n]+/)) {
          const { robot } = window;
          const key = /^get (.*)/.exec(line)?.[1];
          if (robot.mute) continue;
          if (key) say(key in robot ? `${key} = ${robot[key]} (0..9), some help` : `error: unknown setting '${key}'`);
          if (line === "mode log" && robot.mount) say(`$FPHDR,1,fencepost*0000\r\n$FPCAM,${robot.camera},316,208,273.60,273.60,157.50,103.50,0.0000,${robot.mount},0.0000,0.0000,0.0500*0000`);
          if (line === "mode text") window.robot.mode = "text";
          if (line === "status") say(`profile small, mode text\r\ncamera link ok, pixy2.1 316x208; odometry link silent\r\ncamera ${robot.camera} at 115200 baud (GP4 sends, GP5 receives), lens 80 deg; odometry ${robot.odometry} (GP10 and 11)\r\nobjects 0`);
        }
      } });
    },
    async close() {
      if (port.readable.locked || port.writable.locked) throw new TypeError("locked");
      port.readable = port.writable = null;
    },
  };
  Object.defineProperty(navigator, "serial", { value: { requestPort: async () => port }, configurable: true });
}

const browser = await Browser.start(tools);
const open = async ({ usb = [{ run: standInUsb, with: {} }], ...options } = {}) => {
  const opened = await browser.open({ file: PAGE, before: [...usb, { run: standInConsole }, { run: hurry }], ...options });
  await opened.click("#board-open");
  return opened;
};
const settled = (opened, what) => opened.waitForFunction((name) => document.getElementById("board-lines").textContent.includes(name), what, POLLED);
async function choose(opened, name) {
  await opened.selectOption("#board-image", { index: 1 + Object.keys(IMAGES).indexOf(name) });
  await opened.waitForFunction((board) => document.getElementById("board-download").textContent.includes(`my-${board}.`), name, POLLED);
}
async function downloaded(opened) {
  const download = opened.waitForEvent("download");
  await opened.click("#board-download");
  const file = await download;
  const path = join(folder, `page-${++files}`);
  await file.saveAs(path);
  return { name: file.suggestedFilename(), bytes: readFileSync(path) };
}
const asked = (opened, button) => opened.click(button).then(() => opened.waitForFunction((id) => !document.querySelector(id).disabled, button, POLLED));

await run({
  async "the file of every board is the desk's, byte for byte, whatever is chosen"() {
    const known = [...readFileSync(join(tools.shared, "doc/boards.md"), "utf8").matchAll(/^## `(\w+)`/gm)].map(([, board]) => board);
    assert.deepEqual(Object.keys(IMAGES).sort(), known.sort());
    for (const [board, image] of Object.entries(IMAGES)) assert.equal(expectSameAsDesk(image).board, board);
    const real = process.env.FENCEPOST_IMAGES;
    if (!real) return;
    const found = known.map((board) => join(real, board, "fencepost.bin")).filter((file) => existsSync(file));
    assert.notEqual(found.length, 0, `no image in ${real}`);
    for (const file of found) expectSameAsDesk(readFileSync(file));
  },

  async "what cannot be is said as at the desk"() {
    const refused = (settings, robot = "") => { try { engine.configure(IMAGES.pico, { format: "uf2", robot, settings }); } catch (error) { return error.message; } return "taken"; };
    assert.match(refused([["camera", "pixy3"]]), /has no camera "pixy3"; did you mean pixy2\?/);
    assert.match(refused([["lens", "500"]]), /lens=500 is not possible; it takes 0 to 150 deg/);
    assert.match(refused([["camera", "pixy2"], ["odometry", "create2"]]), /would share the board's one serial line/);
    assert.match(refused([], '{"camera": {"mount": {"z": "a"}}}'), /^robot\.json: \/camera\/mount\/z: must be a number/);
    assert.throws(() => engine.board(new Uint8Array(300)), /this is no image of Fencepost/);
    assert.equal(refused([]), "taken", "and the next one is done as if nothing had been");
  },

  async "camera, lens, height and wheels are chosen; the file is downloaded; a drawing and steps say where it goes"() {
    const opened = await open();
    await choose(opened, "pico");
    await opened.selectOption("#board-camera", "pixy2.1");
    await opened.fill("#board-height", "15.3");
    await opened.fill("#board-ahead", "2");
    await opened.selectOption("#board-odometry", "encoders");
    await opened.fill("#board-diameter", "61.5");
    await settled(opened, "wheel.diameter,61.5");
    const { name, bytes } = await downloaded(opened);
    assert.equal(name, "my-pico.uf2");
    const robot = JSON.stringify({ ...mount(0.153, 0.02), robot: { width: 0.2 } });
    const settings = [["camera", "pixy2.1"], ["odometry", "encoders"], ["wheel.diameter", "61.5"], ["wheel.counts", "1440"], ["wheel.track", "130"]];
    assert.ok(bytes.equals(desk(IMAGES.pico, "uf2", robot, settings)));
    assert.match(await text(opened, "#board-steps"), /Hold BOOTSEL.*Drag my-pico\.uf2 onto the drive RPI-RP2/);
    assert.match(await opened.locator("#board-drawing").textContent(), /my-pico\.uf2RPI-RP2USB.*hold BOOTSEL/);
    await opened.selectOption("#board-format", "hex");
    assert.equal((await downloaded(opened)).name, "my-pico.hex");
    await opened.selectOption("#board-camera", "console");
    assert.ok(await opened.locator("#board-mount").isHidden());
    for (const [board, file, said] of [["microbit", "my-microbit.hex", /MICROBIT/], ["pyboard", "my-pyboard.dfu", /DFU \(BOOT0\) and 3V3.*dfu-util .* my-pyboard\.dfu/], ["gba", "my-gba.sav", /beside fencepost-0\.1\.0-gba\.gba/]]) {
      await choose(opened, board);
      assert.equal((await downloaded(opened)).name, file);
      assert.match(await text(opened, "#board-steps"), said);
      assert.equal(await opened.locator("#board-usb").isHidden(), board === "gba", "a cartridge has no USB");
    }
    await opened.context().close();
  },

  async "a program file is opened or dropped; one that is none is refused; without programs inside the page asks for one"() {
    const opened = await open({ file: tools.page });
    assert.ok(await opened.locator("#board-none").isVisible());
    assert.ok(await opened.locator("#board-form").isHidden());
    const uf2 = desk(IMAGES.xrp, "uf2", "{}", []);
    await opened.locator("#board-file").setInputFiles({ name: "fencepost-xrp.uf2", mimeType: "", buffer: uf2 });
    await opened.waitForFunction(() => document.getElementById("board-said").textContent.startsWith("XRP"), null, POLLED);
    await opened.locator("#board-file").setInputFiles({ name: "other.bin", mimeType: "", buffer: Buffer.from("not an image at all") });
    await opened.waitForFunction(() => document.getElementById("board-error").textContent, null, POLLED);
    assert.match(await text(opened, "#board-error"), /^other\.bin: this is no image of Fencepost/);
    const data = await opened.evaluateHandle((base64) => {
      const transfer = new DataTransfer();
      transfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], "again.uf2"));
      return transfer;
    }, uf2.toString("base64"));
    await opened.dispatchEvent("body", "drop", { dataTransfer: data });
    await opened.waitForFunction(() => document.getElementById("board-error").textContent === "", null, POLLED);
    await opened.fill("#board-lens", "500");
    assert.match(await text(opened, "#board-error"), /lens=500 is not possible; it takes 0 to 150 deg/);
    assert.ok(await opened.locator("#board-download").isDisabled());
    await opened.context().close();
  },

  async "an RP2040 is erased, written, compared and started; what goes wrong is said"() {
    const opened = await open();
    await choose(opened, "pico");
    await asked(opened, "#board-write");
    assert.match(await text(opened, "#board-state"), /^Written and compared: \d+ bytes/, await text(opened, "#board-error"));
    const { bytes } = await downloaded(opened);
    const chip = await opened.evaluate(() => ({ ...window.chip, flash: [...window.chip.flash.subarray(0, 16384)], kept: [...window.chip.flash.subarray(0x1fe000)] }));
    const wanted = new Map();
    for (let at = 0; at < bytes.length; at += 512) wanted.set(bytes.readUInt32LE(at + 12) - 0x10000000, bytes.subarray(at + 32, at + 288));
    for (const [at, part] of wanted) assert.deepEqual((at < 16384 ? chip.flash.slice(at, at + 256) : chip.kept.slice(at - 0x1fe000, at - 0x1fe000 + 256)), [...part], `at ${at}`);
    assert.equal(chip.flash[16383], 0x5a, "what the file does not have stays");
    assert.ok(chip.exclusive && chip.closed);
    assert.deepEqual(chip.started, [0, 0, 500]);
    assert.equal(chip.commands.at(-1), 2);
    for (const [fault, says] of [["none", /No board was chosen/], ["bits", /differs at address 0x10001007/], ["old", /differs at address 0x10000009/]]) {
      await opened.evaluate((what) => { Object.assign(window, { usbFault: what }); window.chip.started = null; }, fault);
      await asked(opened, "#board-write");
      assert.match(await text(opened, "#board-error"), says);
      assert.equal(await opened.evaluate(() => window.chip.started), null, "what is not right is not started");
    }
    await opened.evaluate(() => { Object.assign(window, { usbFault: "gone" }); });
    await asked(opened, "#board-write");
    assert.match(await text(opened, "#board-error"), /did not answer \(The device was disconnected/);
    await opened.context().close();
  },

  async "an RP2350 has a command of its own to start"() {
    const opened = await open({ usb: [{ run: standInUsb, with: { rp2350: true } }] });
    await choose(opened, "pico2");
    await asked(opened, "#board-write");
    assert.match(await text(opened, "#board-state"), /^Written and compared: \d+ bytes/, await text(opened, "#board-error"));
    const { bytes } = await downloaded(opened);
    const chip = await opened.evaluate(() => ({ started: window.chip.started, flash: [...window.chip.flash.subarray(0, 256)] }));
    assert.deepEqual(chip.started, [0, 500, 0, 0]);
    assert.deepEqual(chip.flash, [...bytes.subarray(32, 288)]);
    await choose(opened, "pico");
    await asked(opened, "#board-write");
    assert.match(await text(opened, "#board-error"), /No board was chosen.*2e8a:0003/, "an RP2040's program is not for it");
    await opened.context().close();
  },

  async "an STM32 in its boot loader is erased, written, compared and started; what goes wrong is said"() {
    const opened = await open({ usb: [{ run: standInUsb, with: {} }, { run: standInDfu }] });
    await choose(opened, "pyboard");
    await opened.selectOption("#board-format", "dfu");
    await asked(opened, "#board-write");
    assert.match(await text(opened, "#board-state"), /^Written and compared: \d+ bytes/, await text(opened, "#board-error"));
    const { bytes } = await downloaded(opened);
    const size = bytes.readUInt32LE(11 + 274 + 4);
    const found = await opened.evaluate((length) => ({ ...window.stm32, flash: [...window.stm32.flash.subarray(0, length + 1)], far: window.stm32.flash[(1 << 20) - 1] }), size);
    assert.deepEqual(found.flash.slice(0, size), [...bytes.subarray(11 + 274 + 8, 11 + 274 + 8 + size)]);
    assert.equal(found.far, 0x5a, "sectors that the file does not have stay");
    assert.equal(found.started, 0x08000000);
    assert.ok(found.closed && new Set(found.erased).size === found.erased.length && found.erased[0] === 0x08000000);
    for (const [fault, says] of [["none", /No board was chosen.*0483:df11/], ["bits", /differs at address 0x8000807/], ["old", /differs at address 0x8000009/], ["protected", /refused erase: it is read-protected/], ["stuck", /refused erase: it is busy without an end/]]) {
      await opened.evaluate((what) => { Object.assign(window, { usbFault: what }); window.stm32.started = null; }, fault);
      await asked(opened, "#board-write");
      assert.match(await text(opened, "#board-error"), says);
      assert.equal(await opened.evaluate(() => window.stm32.started), null, "what is not right is not started");
      assert.ok(await opened.evaluate(() => window.stm32.closed));
    }
    await opened.evaluate(() => { Object.assign(window, { usbFault: "gone" }); });
    await asked(opened, "#board-write");
    assert.match(await text(opened, "#board-error"), /did not answer \(The device was disconnected/);
    await opened.context().close();
  },

  async "a micro:bit's debug chip is handed the file, by reports or by bulk; what goes wrong is said"() {
    for (const [board, bulk] of [["microbit", false], ["microbit_v2", true]]) {
      const opened = await open({ usb: [{ run: standInUsb, with: {} }, { run: standInDaplink, with: { bulk } }] });
      await choose(opened, board);
      await asked(opened, "#board-write");
      assert.match(await text(opened, "#board-state"), /^Handed over: \d+ bytes of the file.*Nothing was read back/, await text(opened, "#board-error"));
      const bin = await opened.selectOption("#board-format", "bin").then(() => downloaded(opened));
      const found = await opened.evaluate(() => ({ flash: [...window.microbit.flash], started: window.microbit.started, closed: window.microbit.closed }));
      assert.ok(found.flash.length > 9000 && found.closed);
      assert.deepEqual(found.flash.filter(([at, byte]) => bin.bytes[at] !== byte), [], "each byte is where the .bin has it");
      assert.equal(found.started, 1);
      assert.ok(await opened.locator("#board-usb").isHidden(), "it takes no .bin");
      await opened.selectOption("#board-format", "hex");
      for (const [fault, says] of [["sum", /refused write: DAPLink 12/], ["none", /No board was chosen.*0d28:0204/], ["gone", /did not answer \(The device was disconnected/]]) {
        await opened.evaluate((what) => { Object.assign(window, { usbFault: what }); window.microbit.packets = 0; }, fault);
        await asked(opened, "#board-write");
        assert.match(await text(opened, "#board-error"), says);
        assert.equal(await opened.evaluate(() => window.microbit.started), 1, "what is not right is not started");
      }
      await opened.context().close();
    }
  },

  async "a board that answers nothing ends with an error, is closed, and can be tried again"() {
    for (const [board, format, more, closed] of [["pico", "uf2", [], "chip"], ["pyboard", "dfu", [{ run: standInDfu }], "stm32"], ["microbit", "hex", [{ run: standInDaplink, with: { bulk: false } }], "microbit"],
      ["microbit_v2", "hex", [{ run: standInDaplink, with: { bulk: true } }], "microbit"]]) {
      const opened = await open({ usb: [{ run: standInUsb, with: {} }, ...more] });
      await choose(opened, board);
      await opened.selectOption("#board-format", format);
      await opened.evaluate(() => { window.usbFault = "mute"; window.hurried = true; });
      await asked(opened, "#board-write");
      assert.match(await text(opened, "#board-error"), /did not answer \(no answer within 10 s\)/, board);
      assert.ok(await opened.evaluate((name) => window[name].closed, closed));
      if (board === "pico") {
        await opened.evaluate(() => { window.usbFault = null; window.hurried = false; });
        await asked(opened, "#board-write");
        assert.match(await text(opened, "#board-state"), /^Written/, await text(opened, "#board-error"));
      }
      await opened.context().close();
    }
  },

  async "the robot is asked, and what it says is compared with what was chosen"() {
    const opened = await open();
    await choose(opened, "pico");
    await opened.selectOption("#board-camera", "pixy2.1");
    await opened.selectOption("#board-odometry", "encoders");
    await opened.fill("#board-width", "18");
    await settled(opened, "robot.width,0.18");
    const robot = { camera: "pixy2.1", odometry: "encoders", "wheel.diameter": "65.0 mm", "wheel.counts": "1440.0", "wheel.track": "130.0 mm", "robot.width": "0.18 m", mount: "0.0000,0.0000,0.1200" };
    await opened.evaluate((now) => { window.robot = now; }, robot);
    await asked(opened, "#board-check");
    assert.match(await text(opened, "#board-state"), /^The robot has what you chose: 8 settings compared\.$/, await text(opened, "#board-error"));
    await opened.evaluate((now) => { window.robot = now; }, { ...robot, camera: "pixy2", "robot.width": "0.20 m" });
    await asked(opened, "#board-check");
    assert.equal(await opened.evaluate(() => window.robot.mode), "text", "its console is left as people read it");
    assert.equal(await text(opened, "#board-error"), "camera: you chose pixy2.1, the robot says pixy2. robot.width: you chose 0.18, the robot says 0.20.");
    await opened.evaluate((now) => { window.robot = now; }, { ...robot, mount: "0.0200,0.0000,0.1530" });
    await asked(opened, "#board-check");
    assert.equal(await text(opened, "#board-error"), "Lens above the floor, cm: you chose 12, the robot says 15.3. Lens ahead of the axle, cm: you chose 0, the robot says 2.");
    await opened.evaluate(() => { window.robot = { mute: true }; });
    await asked(opened, "#board-check");
    assert.match(await text(opened, "#board-error"), /did not answer/);
    await opened.evaluate(() => { window.robot = { deaf: true }; window.hurried = true; });
    await asked(opened, "#board-check");
    assert.match(await text(opened, "#board-error"), /could not be used: no answer within 4 s/, "it takes nothing");
    await opened.evaluate((now) => { window.robot = now; window.hurried = false; }, robot);
    await asked(opened, "#board-check");
    assert.match(await text(opened, "#board-state"), /^The robot has what you chose/, "the port is free again");
    await opened.context().close();
  },

  async "nothing is cut off, axe has no complaint"() {
    for (const [width, colorScheme, board] of [[1280, "light", "pico"], [400, "dark", "pyboard"]]) {
      const opened = await open({ viewport: { width, height: 800 }, colorScheme });
      await choose(opened, board);
      assert.equal(await opened.evaluate(() => document.documentElement.scrollWidth), width);
      assert.deepEqual(await browser.complaints(opened), []);
      await opened.screenshot({ path: join(tools.npm, `board-${width}.png`), fullPage: true });
      await opened.context().close();
    }
  },

  async "nothing was asked of a network, and nothing failed"() {
    assert.deepEqual(browser.requests, []);
    assert.deepEqual(browser.errors, []);
  },
}, process.argv[6]);
await browser.close();
rmSync(folder, { recursive: true });
