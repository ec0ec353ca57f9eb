// usage: node drive_test.mjs PAGE CLI NPM SHARE [PART]: a robot driven on the page in headless Chromium, and its log at the desk.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser, POLLED, Tools, drop, frameClock, frames, run, text } from "./harness.mjs";

const tools = new Tools(process.argv.slice(2));
const browser = await Browser.start(tools);
const folder = mkdtempSync(join(tmpdir(), "fencepost-drive-"));
const FRAME = 100;  // ms between two frames of the test's clock: the page lets no more pass at once

// One page for all of them, whose clock is the test's: to open it, it replays a log.
const page = await browser.open({ before: [{ run: frameClock }, { run: counters, with: ["result", "state", "alerts", "page", "driven", "truth", "score"] }] });

/** Runs in the page, before it: counts pictures by canvas, and texts of the loop by their names in the order of `write`. */
function counters(names) {
  window.counted = {};
  const count = (all, name) => { all[name] = (all[name] ?? 0) + 1; };
  const { clearRect } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.clearRect = function clear(...area) {
    count(window.counted, this.canvas.id);
    return clearRect.apply(this, area);
  };
  const { Instance } = WebAssembly;
  WebAssembly.Instance = function instance(...given) {
    const { exports } = new Instance(...given);
    return { exports: { ...exports, write: (what) => { count(window.counted.texts ??= {}, names[what]); return exports.write(what); } } };
  };
}

/** A drive begins anew, through the page's own room, with every switch as it is at first. */
async function begin() {
  if (await page.locator("#driving").isHidden()) await page.click("#drive");
  for (const id of ["#obey", "#reveal"]) await page.setChecked(id, true);
  await page.selectOption("#rooms", "a room");
  await frames(page, 1, FRAME);
}

/** The keys held for `seconds` of the drive. */
async function hold(seconds, ...keys) {
  for (const key of keys) await page.keyboard.down(key);
  await frames(page, Math.round(1000 * seconds / FRAME), FRAME);
  for (const key of keys) await page.keyboard.up(key);
}

async function saved(button, name) {
  const download = page.waitForEvent("download");
  await page.click(button);
  const file = join(folder, name);
  await (await download).saveAs(file);
  return file;
}

const number = async (selector) => Number.parseFloat(await text(page, selector));
const banner = () => text(page, "#banner");
/** Where things stand on the map, px of the page, by what they are called. */
const placeOf = (x, y) => page.locator("#map").evaluate((map, [mapX, mapY]) => {
  const { left, top } = map.getBoundingClientRect();
  const [u, v] = map.toPage([mapX, mapY]);
  return [left + u, top + v];
}, [x, y]);

async function drag(from, to) {
  await page.mouse.move(...await placeOf(...from));
  await page.mouse.down();
  await page.mouse.move(...await placeOf(...to), { steps: 4 });
  await page.mouse.up();
  await frames(page, 2, FRAME);
}

const set = (id, value) => page.locator(id).evaluate((input, to) => {
  input.value = to;
  input.dispatchEvent(new Event("input", { bubbles: true }));
}, value);

await run({
  async "the arrow keys drive it; it stops before the box, and says so; its log replays at the desk to the page's digest"() {
    await begin();
    assert.equal(await banner(), "No alert");
    await hold(6, "ArrowUp");
    assert.match(await banner(), /^STOP: \d+ red, 0\.\d\d m (ahead|away)/);
    assert.match(await text(page, "#held"), /It stops/);
    assert.equal(await text(page, "#bumps"), "0");
    assert.ok(await number("#driven") > 0.6);
    await hold(1, "ArrowDown");
    await hold(1.2, "a");
    await hold(2, "w", "ArrowRight");
    assert.notEqual(await banner(), "No alert");
    const log = await saved("#drive-log", "on-the-way.log");
    await page.click("#drive-end");
    await page.waitForSelector("#digest");
    const shown = await text(page, "#digest");
    const whole = await saved("#save-log", "drive.log");
    assert.equal(shown, tools.digest(whole));
    assert.ok(readFileSync(whole, "latin1").startsWith(readFileSync(log, "latin1")));
    const result = JSON.parse(tools.result(whole));
    assert.ok(result.objects.length >= 4 && result.log.frames > 150 && result.alerts.some(({ level }) => level === "stop"));
  },

  async "one that does not obey bumps into the box"() {
    await begin();
    await page.click("#obey");
    await hold(6, "ArrowUp");
    assert.match(await banner(), /^(STOP|BLIND)/);
    assert.equal(await text(page, "#bumps"), "1");
    assert.equal(await text(page, "#held"), "");
  },

  async "the pad and a gamepad drive it, too"() {
    await begin();
    const { x, y, width, height } = await page.locator("#pad").boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2, y + 4);
    await frames(page, 25, FRAME);
    await page.mouse.up();
    const by = await number("#driven");
    assert.ok(by > 0.1, `${by} m`);
    await frames(page, 15, FRAME);
    const rest = await number("#driven");
    await frames(page, 15, FRAME);
    assert.equal(await number("#driven"), rest, "it stands when nothing is pressed");
    await page.evaluate(() => { navigator.getGamepads = () => [{ connected: true, axes: [0, 1], buttons: [] }]; });
    await frames(page, 25, FRAME);
    assert.ok(await number("#driven") > rest + 0.1);
    await page.evaluate(() => { delete navigator.getGamepads; });
  },

  async "things are dragged, added and removed; a place that is taken is refused; the room is saved and loaded as a scene"() {
    await begin();
    await drag([1.45, 0.05], [1.45, 1.0]);
    await hold(4, "ArrowUp");
    assert.equal(await banner().then((said) => /^STOP/.test(said)), false, "the way is free now");
    await page.click("#add-can");
    await frames(page, 2, FRAME);
    await page.click("#add-wall");
    await frames(page, 2, FRAME);
    await page.click("#remove");
    await frames(page, 2, FRAME);
    await drag([1.9, -0.7], [2.75, -0.75]);
    assert.match(await text(page, "#drive-said"), /"green box" overlaps "green can"|"green can" overlaps "green box"/);
    const file = await saved("#drive-scene", "room.json");
    const scene = JSON.parse(readFileSync(file));
    assert.equal(scene.objects.length, 11);
    assert.equal(scene.objects.at(-1).name, "green can");
    const middle = scene.objects[0].footprint.coordinates[0].slice(1).reduce(([x, y], p) => [x + p[0] / 4, y + p[1] / 4], [0, 0]);
    assert.ok(Math.abs(middle[0] - 1.45) < 0.02 && Math.abs(middle[1] - 1.0) < 0.02, middle.join());
    assert.deepEqual(scene.objects[2].footprint.circle, [1.9, -0.7, 0.05], "what was refused went back");
    // At the desk the scene is the drive's truth.
    const log = await saved("#drive-log", "dragged.log");
    assert.match(tools.says("evaluate", log, "--scene", file), /red/);
    await page.locator("#room-file").setInputFiles(file);
    await page.waitForFunction(() => document.getElementById("drive-said").textContent === "", null, POLLED);
    const again = JSON.parse(readFileSync(await saved("#drive-scene", "again.json")));
    assert.deepEqual(again.objects, scene.objects);
    scene.objects[0].signatur = 1;
    writeFileSync(file, JSON.stringify(scene));
    await page.locator("#room-file").setInputFiles(file);
    await page.waitForFunction(() => document.getElementById("drive-said").textContent !== "", null, POLLED);
    assert.match(await text(page, "#drive-said"), /room\.json: .*\/objects\/0\/signatur.*did you mean "signature"\?/);
  },

  async "things are chosen, moved, turned, placed and removed by the keyboard alone, and what happened is said"() {
    await begin();
    const press = async (id, times = 1) => {
      await page.focus(id);
      for (let i = 0; i < times; ++i) await page.keyboard.press("Enter");
      await frames(page, 2, FRAME);
    };
    const place = () => text(page, "#thing-place");
    await press("#thing-left");
    assert.match(await text(page, "#drive-said"), /^Choose a thing first/);
    await page.focus("#thing");
    await page.keyboard.press("ArrowDown");
    await frames(page, 2, FRAME);
    assert.equal(await place(), "x 1.45 m, y 0.05 m");
    assert.equal(await number("#driven"), 0, "the list has the arrow keys");
    await page.keyboard.press("Tab");
    assert.equal(await page.evaluate(() => document.activeElement.id), "thing-left");
    await press("#thing-up", 3);
    await press("#thing-right");
    assert.equal(await place(), "x 1.50 m, y 0.20 m");
    await press("#thing-turn", 2);
    await press("#thing-back");
    const scene = JSON.parse(readFileSync(await saved("#drive-scene", "keys.json")));
    const [first, second] = scene.objects[0].footprint.coordinates[0];
    const before = 0.1 + Math.PI / 12;  // it stood turned by 0.1 rad
    assert.ok(Math.abs(Math.atan2(second[1] - first[1], second[0] - first[0]) - before) < 0.002);
    assert.ok(Math.abs(Math.hypot(second[0] - first[0], second[1] - first[1]) - 0.16) < 3e-4, "as large as before");
    await press("#add-box");
    assert.equal(await page.locator("#thing option:checked").textContent(), "11: blue box".replace("blue", scene.signatures[scene.objects.length % 4].name));
    await press("#thing-right", 30);
    assert.match(await text(page, "#drive-said"), /"red box" overlaps|overlaps "red box"/);
    assert.match(await place(), /^x 1\.[23]\d m, y 0\.00 m$/, "it stands before the red box, as far as it could go");
    await press("#remove");
    assert.equal(await page.locator("#thing option").count(), 1 + scene.objects.length);
    assert.equal(await place(), "");
    await page.setChecked("#reveal", false);
    assert.ok(await page.locator("#thing").isDisabled(), "what is hidden is not in a list either");
  },

  async "switches: by a higher lens the box seems nearer, by a tilted camera farther; wheels that slip report more than they drive"() {
    const seen = {};
    for (const [id, value] of [["#lens", 0], ["#lens", 0.05], ["#tilt", 0.02]]) {
      await begin();
      await set(id, value);
      await hold(2, "ArrowUp");
      seen[value] = Number(/1 red, ([\d.]+) m (?:ahead|away)/.exec(await banner())?.[1]);
    }
    assert.ok(seen[0.05] < seen[0] - 0.1 && seen[0.02] > seen[0] + 0.04, JSON.stringify(seen));
    await begin();
    await set("#slip", 0.3);
    await set("#noise", 3);
    await hold(2, "ArrowUp");
    const log = readFileSync(await saved("#drive-log", "slip.log"), "latin1");
    const last = log.split("\n").filter((line) => line.startsWith("$FPODO")).at(-1).split(",");
    assert.ok(Number(last[2]) > 1.2 * await number("#driven"), "the wheels report more than was driven");
  },

  async "what really stands there can be hidden"() {
    await begin();
    await frames(page, 2, FRAME);
    const shown = await page.locator("#map").evaluate((canvas) => canvas.toDataURL());
    await page.click("#reveal");
    await frames(page, 2, FRAME);
    assert.notEqual(await page.locator("#map").evaluate((canvas) => canvas.toDataURL()), shown);
    const legend = await page.locator("#legend li:visible").allTextContents();
    assert.ok(!legend.some((line) => /really/.test(line)), legend.join());
  },

  async "a room can be driven through that belongs to a recording; a dropped log ends the drive"() {
    await begin();
    await page.selectOption("#rooms", { label: "go_around" });
    await hold(1, "ArrowUp");
    assert.ok(await number("#driven") > 0.1);
    await drop(page, tools.log("approach_stop"));
    assert.ok(await page.locator("#driving").isHidden());
    assert.equal(await text(page, "#digest"), tools.digest(tools.log("approach_stop")));
  },

  async "first screen, phone and night: nothing is cut off, axe has no complaint"() {
    await begin();
    await hold(1, "ArrowUp");
    for (const [width, height, colorScheme] of [[1280, 800, "light"], [1920, 1080, "dark"], [400, 800, "light"]]) {
      await page.setViewportSize({ width, height });
      if (await page.locator("html").getAttribute("data-theme") !== colorScheme) await page.click("#theme");
      await frames(page, 2, FRAME);
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
      for (const part of width > 900 ? ["#map", "#banner", "#pad", "#camera", "#recklessness", "#obey", "#slip", "#remove", "#drive-scene"] : ["#banner", "#map", "#pad"]) {
        const box = await page.locator(part).boundingBox();
        assert.ok(box.y >= 0 && box.y + box.height <= height, `${part} at ${width} x ${height}: ${box.y} to ${box.y + box.height}`);
      }
      assert.deepEqual(await browser.complaints(page), []);
      await page.screenshot({ path: join(tools.npm, `drive-${width}.png`) });
    }
    await page.setViewportSize({ width: 1280, height: 900 });
  },

  async "a picture a frame; what costs more than a picture is done seldom"() {
    // Counts, not times: drive_bench.mjs measures those. Texts of the loop by their number in engine.js.
    await begin();
    await page.keyboard.down("ArrowUp");
    await page.keyboard.down("ArrowRight");
    await frames(page, 20, FRAME);
    await page.evaluate(() => { window.counted = {}; });
    await frames(page, 40, 50);
    const { map, camera, timeline, texts } = await page.evaluate(() => window.counted);
    await page.keyboard.up("ArrowUp");
    await page.keyboard.up("ArrowRight");
    assert.deepEqual({ map, texts }, { map: 40, texts: { driven: 40, truth: 40, page: 40, score: 4 } });
    assert.ok(camera <= 40 && timeline <= 3, `${camera} pictures of the camera, ${timeline} of the timeline`);
  },

  async "nothing was asked of a network, and nothing failed"() {
    assert.deepEqual(browser.requests, []);
    assert.deepEqual(browser.errors, []);
  },
}, process.argv[6]);
await browser.close();
rmSync(folder, { recursive: true });
