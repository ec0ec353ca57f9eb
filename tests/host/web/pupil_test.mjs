// usage: node pupil_test.mjs PAGE CLI NPM SHARE [PART]: a pupil's way without a network, in real time. The page is opened, a robot driven up
// to a STOP, and the drive saved. Another browser opens what was saved, and a page with it is handed on. The time of each step is printed.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser, POLLED, Tools, drop, run, text } from "./harness.mjs";

const MOST = 10;  // minutes, of the way as a whole, for a browser that does the work of four on a busy machine
const tools = new Tools(process.argv.slice(2));
const folder = mkdtempSync(join(tmpdir(), "fencepost-pupil-"));
const browser = await Browser.start(tools);
const begun = Date.now();
const step = async (name, what) => {
  const from = Date.now();
  const result = await what();
  console.log(`     ${((Date.now() - from) / 1000).toFixed(1)} s: ${name}`);
  return result;
};
const save = async (page, button, name) => {
  const download = page.waitForEvent("download");
  await page.click(button);
  const file = join(folder, name);
  await (await download).saveAs(file);
  return file;
};

await run({
  async "open, drive, get a STOP, save, open again, hand on"() {
    const page = await step("the page is open", () => browser.open({ offline: true }));
    await step("it drives, and stops by itself", async () => {
      await page.click("#drive");
      await page.keyboard.down("ArrowUp");
      await page.waitForFunction(() => document.getElementById("banner").textContent.startsWith("STOP") && document.getElementById("held").textContent, null, POLLED);
      await page.keyboard.up("ArrowUp");
    });
    assert.equal(await text(page, "#bumps"), "0");
    const scene = await save(page, "#drive-scene", "room.json");
    const log = await step("it is saved", async () => {
      await page.click("#drive-end");
      await page.waitForSelector("#digest");
      return save(page, "#save-log", "drive.log");
    });
    const digest = await text(page, "#digest");
    await page.context().close();

    const other = await browser.open({ offline: true });
    await step("another browser shows it", () => drop(other, log, { name: "drive.json", bytes: readFileSync(scene) }));
    assert.equal(await text(other, "#digest"), digest);
    assert.ok((await other.locator("#alerts").textContent()).includes("stop"));
    assert.ok(await other.locator("#legend [data-layer=truth]").isVisible(), "the room came along");
    await other.context().close();

    const shared = join(folder, "drive.html");
    await step("a page with the drive in it is handed on", async () => {
      tools.says("report", log, "--scene", scene, "-o", shared);
      const reader = await browser.open({ offline: true, file: shared });
      await reader.waitForSelector("#digest");
      assert.equal(await text(reader, "#digest"), digest);
      assert.match(await text(reader, "#title"), /drive/);
      await reader.context().close();
    });
    assert.equal(tools.digest(log), digest);
    const minutes = (Date.now() - begun) / 60_000;
    console.log(`     ${minutes.toFixed(1)} min in all`);
    assert.ok(minutes < MOST, `${minutes} minutes`);
  },

  async "nothing was asked of a network, and nothing failed"() {
    assert.deepEqual(browser.requests.filter((url) => !url.startsWith(`file://${folder}`)), []);
    assert.deepEqual(browser.errors, []);
  },
}, process.argv[6]);
await browser.close();
rmSync(folder, { recursive: true });
