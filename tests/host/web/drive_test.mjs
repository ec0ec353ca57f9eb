// usage: node drive_test.mjs PAGE CLI NPM SHARE [PART]: a robot driven on the page in headless Chromium, and its log at the desk.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser, Tools, drop, frameClock, frames, run, text } from "./harness.mjs";

const tools = new Tools(process.argv.slice(2));
const browser = await Browser.start(tools);
const folder = mkdtempSync(join(tmpdir(), "fencepost-drive-"));
const FRAME = 50;  // ms between two frames of the test's clock
const PICTURES = 20;  // a second, on a processor
const SLOWER = 4;     // times slower than this one

/** The page with a drive begun in it; its clock is the test's. */
async function driving(options) {
  const page = await browser.open({ before: { run: frameClock }, ...options });
  await page.click("#drive");
  await frames(page, 2, FRAME);
  return page;
}

/** The keys held for `seconds` of the drive. */
async function hold(page, seconds, ...keys) {
  for (const key of keys) await page.keyboard.down(key);
  await frames(page, Math.round(1000 * seconds / FRAME), FRAME);
  for (const key of keys) await page.keyboard.up(key);
}

async function saved(page, button, name) {
  const download = page.waitForEvent("download");
  await page.click(button);
  const file = join(folder, name);
  await (await download).saveAs(file);
  return file;
}

const number = async (page, selector) => Number.parseFloat(await text(page, selector));
const banner = (page) => text(page, "#banner");
/** Where things stand on the map, px of the page, by what they are called. */
const placeOf = (page, x, y) => page.locator("#map").evaluate((map, [mapX, mapY]) => {
  const { left, top } = map.getBoundingClientRect();
  const [u, v] = map.toPage([mapX, mapY]);
  return [left + u, top + v];
}, [x, y]);

async function drag(page, from, to) {
  await page.mouse.move(...await placeOf(page, ...from));
  await page.mouse.down();
  await page.mouse.move(...await placeOf(page, ...to), { steps: 4 });
  await page.mouse.up();
  await frames(page, 3, FRAME);
}

const set = (page, id, value) => page.locator(id).evaluate((input, to) => {
  input.value = to;
  input.dispatchEvent(new Event("input", { bubbles: true }));
}, value);

await run({
  async "the arrow keys drive it; it stops before the box, and says so; its log replays at the desk to the page's digest"() {
    const page = await driving();
    assert.equal(await banner(page), "No alert");
    await hold(page, 6, "ArrowUp");
    assert.match(await banner(page), /^STOP: \d+ red, 0\.\d\d m ahead/);
    assert.match(await text(page, "#held"), /It stops/);
    assert.equal(await text(page, "#bumps"), "0");
    assert.ok(await number(page, "#driven") > 0.6);
    await hold(page, 1, "ArrowDown");
    await hold(page, 1.2, "a");
    await hold(page, 2, "w", "ArrowRight");
    assert.notEqual(await banner(page), "No alert");
    const log = await saved(page, "#drive-log", "on-the-way.log");
    await page.click("#drive-end");
    await page.waitForSelector("#digest");
    const shown = await text(page, "#digest");
    const whole = await saved(page, "#save-log", "drive.log");
    assert.equal(shown, tools.digest(whole));
    assert.ok(readFileSync(whole, "latin1").startsWith(readFileSync(log, "latin1")));
    const result = JSON.parse(tools.result(whole));
    assert.ok(result.objects.length >= 4 && result.log.frames > 150 && result.alerts.some(({ level }) => level === "stop"));
    assert.deepEqual(await browser.complaints(page), []);
    await page.context().close();
  },

  async "one that does not obey bumps into the box"() {
    const page = await driving();
    await page.click("#obey");
    await hold(page, 6, "ArrowUp");
    assert.match(await banner(page), /^(STOP|BLIND)/);
    assert.equal(await text(page, "#bumps"), "1");
    assert.equal(await text(page, "#held"), "");
    await page.context().close();
  },

  async "the pad and a gamepad drive it, too"() {
    const page = await driving({ hasTouch: true });
    const { x, y, width, height } = await page.locator("#pad").boundingBox();
    await page.mouse.move(x + width / 2, y + height / 2);
    await page.mouse.down();
    await page.mouse.move(x + width / 2, y + 4);
    await frames(page, 50, FRAME);
    await page.mouse.up();
    const by = await number(page, "#driven");
    assert.ok(by > 0.1, `${by} m`);
    await frames(page, 30, FRAME);
    const rest = await number(page, "#driven");
    await frames(page, 30, FRAME);
    assert.equal(await number(page, "#driven"), rest, "it stands when nothing is pressed");
    await page.evaluate(() => { navigator.getGamepads = () => [{ connected: true, axes: [0, 1], buttons: [] }]; });
    await frames(page, 50, FRAME);
    assert.ok(await number(page, "#driven") > rest + 0.1);
    await page.context().close();
  },

  async "things are dragged, added and removed; a place that is taken is refused; the room is saved and loaded as a scene"() {
    const page = await driving();
    await drag(page, [1.45, 0.05], [1.45, 1.0]);
    await hold(page, 4, "ArrowUp");
    assert.equal(await banner(page).then((said) => /^STOP/.test(said)), false, "the way is free now");
    await page.click("#add-can");
    await frames(page, 3, FRAME);
    await page.click("#add-wall");
    await frames(page, 3, FRAME);
    await page.click("#remove");
    await frames(page, 3, FRAME);
    await drag(page, [1.9, -0.7], [2.75, -0.75]);
    assert.match(await text(page, "#drive-said"), /"green box" overlaps "green can"|"green can" overlaps "green box"/);
    const file = await saved(page, "#drive-scene", "room.json");
    const scene = JSON.parse(readFileSync(file));
    assert.equal(scene.objects.length, 11);
    assert.equal(scene.objects.at(-1).name, "green can");
    const middle = scene.objects[0].footprint.coordinates[0].slice(1).reduce(([x, y], p) => [x + p[0] / 4, y + p[1] / 4], [0, 0]);
    assert.ok(Math.abs(middle[0] - 1.45) < 0.02 && Math.abs(middle[1] - 1.0) < 0.02, middle.join());
    assert.deepEqual(scene.objects[2].footprint.circle, [1.9, -0.7, 0.05], "what was refused went back");
    // At the desk the scene is the drive's truth.
    const log = await saved(page, "#drive-log", "dragged.log");
    assert.match(tools.says("evaluate", log, "--scene", file), /red/);
    await page.locator("#room-file").setInputFiles(file);
    await frames(page, 10, FRAME);
    assert.equal(await text(page, "#drive-said"), "");
    const again = JSON.parse(readFileSync(await saved(page, "#drive-scene", "again.json")));
    assert.deepEqual(again.objects, scene.objects);
    scene.objects[0].signatur = 1;
    writeFileSync(file, JSON.stringify(scene));
    await page.locator("#room-file").setInputFiles(file);
    await page.waitForFunction(() => document.getElementById("drive-said").textContent !== "");
    assert.match(await text(page, "#drive-said"), /room\.json: .*\/objects\/0\/signatur.*did you mean "signature"\?/);
    await page.context().close();
  },

  async "switches: by a higher lens the box seems nearer, by a tilted camera farther; wheels that slip report more than they drive"() {
    const seen = {};
    for (const [id, value] of [["", 0], ["#lens", 0.05], ["#tilt", 0.07]]) {
      const page = await driving();
      if (id) await set(page, id, value);
      await hold(page, 2, "ArrowUp");
      await frames(page, 6, FRAME);
      const [, distance] = /([\d.]+) m ahead/.exec(await banner(page)) ?? [];
      seen[id] = Number(distance);
      await page.context().close();
    }
    assert.ok(seen["#lens"] < seen[""] - 0.02 && seen["#tilt"] > seen[""] + 0.02, JSON.stringify(seen));
    const page = await driving();
    await set(page, "#slip", 0.3);
    await set(page, "#noise", 3);
    await hold(page, 2, "ArrowUp");
    const log = readFileSync(await saved(page, "#drive-log", "slip.log"), "latin1");
    const last = log.split("\n").filter((line) => line.startsWith("$FPODO")).at(-1).split(",");
    assert.ok(Number(last[2]) > 1.2 * await number(page, "#driven"), "the wheels report more than was driven");
    await page.context().close();
  },

  async "what really stands there can be hidden"() {
    const page = await driving();
    await frames(page, 3, FRAME);
    const shown = await page.locator("#map").evaluate((canvas) => canvas.toDataURL());
    await page.click("#reveal");
    await frames(page, 3, FRAME);
    assert.notEqual(await page.locator("#map").evaluate((canvas) => canvas.toDataURL()), shown);
    const legend = await page.locator("#legend li:visible").allTextContents();
    assert.ok(!legend.some((line) => /really/.test(line)), legend.join());
    await page.context().close();
  },

  async "a room can be driven through that belongs to a recording; a dropped log ends the drive"() {
    const page = await driving();
    await page.selectOption("#rooms", { label: "go_around" });
    await hold(page, 1, "ArrowUp");
    assert.ok(await number(page, "#driven") > 0.1);
    await drop(page, tools.log("approach_stop"));
    assert.ok(await page.locator("#driving").isHidden());
    assert.equal(await text(page, "#digest"), tools.digest(tools.log("approach_stop")));
    await page.context().close();
  },

  async "first screen, phone and night: nothing is cut off, axe has no complaint"() {
    for (const [width, height, colorScheme] of [[1280, 800, "light"], [1920, 1080, "dark"], [400, 800, "light"]]) {
      const page = await driving({ viewport: { width, height }, colorScheme });
      await hold(page, 1, "ArrowUp");
      assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width);
      for (const part of width > 900 ? ["#map", "#banner", "#pad", "#camera", "#recklessness", "#obey", "#slip", "#remove", "#drive-scene"] : ["#banner", "#map", "#pad"]) {
        const box = await page.locator(part).boundingBox();
        assert.ok(box.y >= 0 && box.y + box.height <= height, `${part} at ${width} x ${height}: ${box.y} to ${box.y + box.height}`);
      }
      assert.deepEqual(await browser.complaints(page), []);
      await page.screenshot({ path: join(tools.npm, `drive-${width}.png`) });
      await page.context().close();
    }
  },

  async "twenty pictures a second on a processor that is four times slower"() {
    // Time of the page's thread, four times: by the clock, other programs on this machine would make it slower, too.
    const page = await driving();
    const client = await page.context().newCDPSession(page);
    await client.send("Performance.enable", { timeDomain: "threadTicks" });
    const busy = async () => Object.fromEntries((await client.send("Performance.getMetrics")).metrics.map(({ name, value }) => [name, value])).TaskDuration;
    await page.keyboard.down("ArrowUp");
    await page.keyboard.down("ArrowRight");
    await frames(page, 40, 1000 / PICTURES);
    const costOf = async (action) => {
      const before = await busy();
      for (let i = 0; i < 60; ++i) await action();
      return (await busy() - before) / 60;
    };
    const asked = await costOf(() => page.evaluate(() => 0));
    const cost = await costOf(() => frames(page, 1, 1000 / PICTURES)) - asked;
    console.log(`     ${(1000 * cost).toFixed(1)} ms a picture`);
    assert.ok(SLOWER * cost < 1 / PICTURES, `${1000 * cost} ms`);
    await page.context().close();
  },

  async "nothing was asked of a network, and nothing failed"() {
    assert.deepEqual(browser.requests, []);
    assert.deepEqual(browser.errors, []);
  },
}, process.argv[6]);
await browser.close();
rmSync(folder, { recursive: true });
