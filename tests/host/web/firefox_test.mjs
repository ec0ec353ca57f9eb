// usage: FIREFOX=/usr/bin/firefox-esr node firefox_test.mjs PAGE CLI NPM SHARE [PART]: the page's main ways in Debian's Firefox.
// Playwright takes no downloads there. So what the page saves is caught in the page.
import assert from "node:assert/strict";
import { writeFileSync, mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser, POLLED, Tools, drop, goTo, run, settled, text } from "./harness.mjs";

const tools = new Tools(process.argv.slice(2));
const folder = mkdtempSync(join(tmpdir(), "fencepost-firefox-"));
const browser = await Browser.start(tools);
const page = await browser.open({ viewport: { width: 1280, height: 800 }, before: { run: catchSaved } });

/** Runs in the page, before it: files that are saved end in window.saved. */
function catchSaved() {
  const make = URL.createObjectURL;
  URL.createObjectURL = (blob) => { window.saved = blob; return make(blob); };
  HTMLAnchorElement.prototype.click = () => {};
}
const saved = async (button) => {
  await page.click(button);
  return Buffer.from(await page.evaluate(async () => btoa(Array.from(new Uint8Array(await window.saved.arrayBuffer()), (byte) => String.fromCharCode(byte)).join(""))), "base64");
};
/** Nothing failed up to now. Pictures and axe put styles of their own into the page, which its policy forbids. */
const noErrors = () => assert.deepEqual(browser.errors, []);
const picture = () => page.locator("#map").evaluate((canvas) => canvas.toDataURL());

await run({
  async "it is Firefox; its own recording and a dropped log have the command line's digest"() {
    assert.match(await page.evaluate(() => navigator.userAgent), /Firefox/);
    assert.equal(await text(page, "#digest"), tools.digest(tools.log("go_around")));
    await drop(page, tools.log("approach_stop"), tools.scene("approach_stop"));
    assert.equal(await text(page, "#digest"), tools.digest(tools.log("approach_stop")));
    assert.equal((await saved("#save-result")).toString(), tools.result(tools.log("approach_stop")));
  },

  async "it goes to any time, and each view is another picture"() {
    await goTo(page, 3);
    assert.equal(await text(page, "#clock"), "3.00 s");
    const seen = new Set();
    for (const view of ["top", "solid", "behind", "eye"]) {
      await page.click(`#${view}`);
      await settled(page);
      seen.add(await picture());
    }
    assert.equal(seen.size, 4);
    await page.click("#top");
  },

  async "a robot is driven up to a STOP; its log replays at the desk to the page's digest"() {
    await page.click("#drive");
    await page.keyboard.down("ArrowUp");
    await page.waitForFunction(() => document.getElementById("banner").textContent.startsWith("STOP") && document.getElementById("held").textContent, null, POLLED);
    await page.keyboard.up("ArrowUp");
    assert.equal(await text(page, "#bumps"), "0");
    noErrors();
    await page.screenshot({ path: join(tools.npm, "firefox-drive.png") });
    assert.deepEqual(await browser.complaints(page), []);
    const ofTools = browser.errors.splice(0);
    assert.ok(ofTools.every((error) => /blocked an inline style/.test(error)), ofTools.join());
    await page.click("#drive-end");
    await page.waitForSelector("#digest");
    const log = join(folder, "drive.log");
    writeFileSync(log, await saved("#save-log"));
    assert.equal(await text(page, "#digest"), tools.digest(log));
  },

  async "it speaks another language, is dark and 400 px wide, and axe has no complaint; it says that Web Serial is missing"() {
    await page.selectOption("#language", { label: "Deutsch" });
    assert.equal(await text(page, "#drive"), "Fahren");
    await page.click("#theme");
    await page.setViewportSize({ width: 400, height: 800 });
    await settled(page);
    await page.click("#connect");
    if (!await page.evaluate(() => navigator.serial)) assert.match(await text(page, "#port-error"), /Web Serial/);
    noErrors();
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= document.documentElement.clientWidth));
    assert.deepEqual(await browser.complaints(page), []);
    await page.screenshot({ path: join(tools.npm, "firefox-400.png"), fullPage: true });
  },

  async "nothing was asked of a network"() {
    assert.deepEqual(browser.requests, []);
  },
}, process.argv[6]);
await browser.close();
rmSync(folder, { recursive: true });
