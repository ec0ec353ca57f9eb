// usage: node layout_test.mjs PAGE CLI NPM SHARE [PART]. Finds names that read alike, labels over each other, and
// elements wider than the page, measured at 400 and 1280 px. It tests the page, and the report without a script.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser, Tools, drop, goTo, run, settled } from "./harness.mjs";
import { NAMES, hostileScene } from "./hostile_scene.mjs";

const tools = new Tools(process.argv.slice(2));
const browser = await Browser.start(tools);
const folder = mkdtempSync(join(tmpdir(), "fencepost-layout-"));
const log = join(folder, "crowd.log");
const scene = join(folder, "crowd.json");
writeFileSync(scene, JSON.stringify(hostileScene()));
execFileSync(tools.cli, ["simulate", scene, "-o", log], { stdio: "ignore" });
const found = JSON.parse(tools.result(log));
const WIDTHS = [400, 1280];

/** Elements wider than the page, or cut off without a way to see the rest. */
const tooWide = (page) => page.evaluate(() => {
  const wide = [];
  const width = document.documentElement.clientWidth;
  if (document.documentElement.scrollWidth > width) wide.push(`the page: ${document.documentElement.scrollWidth} of ${width}`);
  for (const element of document.body.querySelectorAll("*")) {
    const { left, right, width: own } = element.getBoundingClientRect();
    const style = getComputedStyle(element);
    const name = `${element.tagName} ${element.id} ${element.className}`;
    const scrolls = element.parentElement.closest(".scroll, .figure, svg") !== null;
    if (own > 0 && !scrolls && (right > width + 0.5 || left < -0.5)) wide.push(`${name}: ${left.toFixed(0)} to ${right.toFixed(0)}`);
    const hides = ["hidden", "clip"].includes(style.overflowX) && element.tagName !== "svg";
    if (hides && !element.matches(".aside") && element.childElementCount === 0 && element.scrollWidth > element.clientWidth) wide.push(`${name} is cut off`);
  }
  return wide;
});

const over = (a, b) => a[0] < b[2] - 0.5 && a[2] > b[0] + 0.5 && a[1] < b[3] - 0.5 && a[3] > b[1] + 0.5;

/** The faults of labels [{ key, text, box }] in [0, width] x [0, height]. */
function faults(labels, [width, height]) {
  const wrong = [];
  labels.forEach((a, i) => {
    if (a.box[0] < -0.5 || a.box[1] < -0.5 || a.box[2] > width + 0.5 || a.box[3] > height + 0.5) wrong.push(`${a.text} is beyond the edge`);
    for (const b of labels.slice(0, i)) {
      if (over(a.box, b.box)) wrong.push(`${a.text} is over ${b.text}`);
      if (a.text === b.text) wrong.push(`${a.text} stands for ${a.key} and ${b.key}`);
    }
  });
  return wrong;
}

/** The labels on a canvas, with room enough for their text. */
async function labelsOn(page, selector) {
  return page.locator(selector).evaluate((canvas) => {
    const g = canvas.getContext("2d");
    const labels = canvas.placed.map(({ key, text, box, font }) => {
      g.font = font;
      return { key, text, box, narrow: g.measureText(text).width > box[2] - box[0] };
    });
    return { labels, size: [canvas.clientWidth, canvas.clientHeight] };
  });
}

async function checkLabels(page, selector, least) {
  const { labels, size } = await labelsOn(page, selector);
  assert.ok(labels.length >= least, `${labels.length} of ${least} labels on ${selector}`);
  assert.deepEqual(faults(labels, size), [], selector);
  assert.deepEqual(labels.filter(({ narrow }) => narrow), []);
  return labels;
}

const nameIn = (object) => `${object.id} ${object.name}`;

await run({
  async "the scene is what it should be"() {
    assert.ok(found.objects.length >= 28, `${found.objects.length} objects`);
    assert.ok(found.objects.every((object) => NAMES.includes(object.name)));
    assert.ok(found.alerts.length > 20);
  },

  async "the checks find what is planted"() {
    assert.equal(faults([{ key: 1, text: "a", box: [0, 0, 20, 10] }, { key: 2, text: "b", box: [15, 5, 30, 15] }], [100, 100]).length, 1);
    assert.equal(faults([{ key: 1, text: "a", box: [0, 0, 20, 10] }, { key: 2, text: "a", box: [30, 5, 40, 15] }], [100, 100]).length, 1);
    assert.equal(faults([{ key: 1, text: "a", box: [90, 0, 110, 10] }], [100, 100]).length, 1);
    const page = await browser.open();
    await page.evaluate(() => {
      const planted = document.createElement("p");
      planted.textContent = "x".repeat(400);
      document.querySelector("main").append(planted);
    });
    assert.notDeepEqual(await tooWide(page), []);
    await page.context().close();
  },

  async "the page, crowded"() {
    for (const width of WIDTHS) {
      const page = await browser.open({ viewport: { width, height: 900 } });
      await drop(page, log, scene);
      assert.deepEqual(await tooWide(page), [], `at ${width}`);
      await settled(page);
      await page.screenshot({ path: join(tools.npm, `crowd-${width}.png`), fullPage: true });
      const onMap = await checkLabels(page, "#map", found.objects.length);
      for (const object of found.objects) {
        const { text } = onMap.find(({ key }) => key === object.id);
        assert.ok(text === String(object.id) || text.startsWith(`${object.id} `), text);
      }
      const cells = await page.locator("#objects td.name").allTextContents();
      assert.deepEqual(cells, found.objects.map((object) => object.name), "names in the table are whole");
      const rows = await page.locator("#timeline").evaluate((canvas) => canvas.shown);
      const alerted = new Set(found.alerts.filter((a) => a.level !== "clear" && a.id !== 0).map((a) => a.id));
      assert.equal(rows.filter((row) => row !== "guard" && row !== "camera").length, alerted.size);
      assert.equal(new Set(rows).size, rows.length, "rows of the timeline read apart");
      for (const t of [4, 9, 13]) {
        await goTo(page, t);
        await settled(page);
        await checkLabels(page, "#map", 5);
        await checkLabels(page, "#camera", 1);
      }
      await page.click("#solid");
      await settled(page);
      await checkLabels(page, "#map", 5);
      await page.screenshot({ path: join(tools.npm, `crowd-solid-${width}.png`) });
      assert.equal(await page.evaluate(() => window.hacked), undefined);
      await page.context().close();
    }
  },

  async "the page of each bundled log has every name in full beside its object"() {
    for (const width of WIDTHS) {
      const page = await browser.open({ viewport: { width, height: 900 } });
      for (const name of ["go_around", "wro_lap", "approach_stop", "corridor", "noisy_arc"]) {
        await drop(page, tools.log(name), tools.scene(name));
        await settled(page);
        assert.deepEqual(await tooWide(page), [], `${name} at ${width}`);
        const labels = await checkLabels(page, "#map", 1);
        for (const object of JSON.parse(tools.result(tools.log(name))).objects) {
          const mine = labels.find(({ key }) => key === object.id);
          if (object.state !== "tentative") assert.equal(mine?.text, nameIn(object), `${name} at ${width}`);
        }
      }
      await page.context().close();
    }
  },

  async "several logs side by side"() {
    for (const width of WIDTHS) {
      const page = await browser.open({ viewport: { width, height: 900 } });
      const bytes = readFileSync(log);
      await drop(page, { name: `${"long-".repeat(30)}one.log`, bytes }, { name: `${"long-".repeat(30)}two.log`, bytes });
      await page.waitForFunction(() => document.querySelectorAll(".card").length === 2 && document.getElementById("progress").hidden);
      assert.deepEqual(await tooWide(page), [], `at ${width}`);
      assert.deepEqual((await page.locator(".card b").allTextContents()).map((name) => name.slice(-7)), ["one.log", "two.log"]);
      await page.context().close();
    }
  },

  async "the report without a script"() {
    const file = join(folder, "crowd.html");
    execFileSync(tools.cli, ["report", "--static", log, "--scene", scene, "-o", file], { stdio: "ignore" });
    assert.doesNotMatch(readFileSync(file, "utf8"), /<script/i);
    for (const width of WIDTHS) {
      const context = await browser.browser.newContext({ viewport: { width, height: 900 } });
      const page = await context.newPage();
      await page.goto(`file://${file}`);
      assert.deepEqual(await tooWide(page), [], `at ${width}`);
      const { labels, size } = await page.evaluate(() => {
        const map = document.getElementById("map").getBoundingClientRect();
        const texts = [...document.querySelectorAll(".labels text, .layer-path text")];
        return { size: [map.width, map.height], labels: texts.map((text, key) => {
          const { left, top, right, bottom } = text.getBoundingClientRect();
          const inset = (bottom - top) * 0.15;  // of a line's box, above and below its letters
          return { key, text: text.textContent, box: [left - map.left, top - map.top + inset, right - map.left, bottom - map.top - inset] };
        }) };
      });
      assert.ok(labels.length >= found.objects.filter((object) => object.state !== "tentative").length, `${labels.length} labels`);
      assert.deepEqual(faults(labels, size), [], `at ${width}`);
      const cells = await page.locator("table").first().locator("tbody tr td:nth-child(2)").allTextContents();
      assert.deepEqual(cells, found.objects.map((object) => object.name));
      const beyond = await page.evaluate(() => [...document.querySelectorAll("svg text")].filter((text) => {
        const own = text.getBoundingClientRect();
        const sheet = text.ownerSVGElement.getBoundingClientRect();
        return own.left < sheet.left - 0.5 || own.right > sheet.right + 0.5;
      }).map((text) => text.textContent));
      assert.deepEqual(beyond, []);
      await page.screenshot({ path: join(tools.npm, `static-${width}.png`), fullPage: true });
      await context.close();
    }
  },
}, process.argv[6]);
await browser.close();
rmSync(folder, { recursive: true });
