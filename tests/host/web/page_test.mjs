// usage: node page_test.mjs PAGE CLI NPM SHARE [PART]: the page in headless Chromium, opened from disk.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { randomBytes } from "node:crypto";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser, POLLED, Tools, drop, frameClock, frames, goTo, hurry, record, run, settled, text } from "./harness.mjs";
import { standIn } from "./stand_in_serial.mjs";

const tools = new Tools(process.argv.slice(2));
const browser = await Browser.start(tools);
const FIRST = "go_around";  // the recording that the page opens with
const BRAKES = 0.6;  // s: so long after a stop it stands
const HOSTILE = '<img src=x onerror=hacked=1>';
const escaped = (name) => [...name].map((c) => /[\w =.]/.test(c) ? c : `%${c.charCodeAt(0).toString(16).toUpperCase().padStart(2, "0")}`).join("");

const picture = (page, selector = "#map") => page.locator(selector).evaluate((canvas) => canvas.toDataURL());

const shown = (page) => page.evaluate(() => document.documentElement.dataset.shown);

/** All that is said beside the pointer, anywhere on the map. */
const tipsOn = async (page) => new Set(await page.locator("#map").evaluate((map) => {
  const { left, top, width, height } = map.getBoundingClientRect();
  const tips = [];
  for (let u = width; u > 0; u -= 9) {
    for (let v = 0; v < height; v += 9) {
      map.dispatchEvent(new PointerEvent("pointermove", { clientX: left + u, clientY: top + v }));
      tips.push(document.getElementById("tip").textContent);
    }
  }
  return tips;
}));

const complaints = (of) => browser.complaints(of);

let page = await browser.open();

await run({
  async "shows a bundled log first, with the command line's digest"() {
    assert.equal(await text(page, "#digest"), tools.digest(tools.log(FIRST)));
    assert.equal(await page.locator("#objects tbody tr").count(), 3);
    assert.ok(await page.locator("#alerts tbody tr").count() > 5);
  },

  async "a dropped log has the command line's digest"() {
    for (const name of ["stop_pixy2", "noisy_arc"]) {
      await drop(page, tools.log(name), tools.scene(name));
      assert.equal(await text(page, "#digest"), tools.digest(tools.log(name)));
    }
    await drop(page, { name: "packed.log.gz", bytes: execFileSync("gzip", ["-c", tools.log("corridor")]) });
    assert.equal(await text(page, "#digest"), tools.digest(tools.log("corridor")));
  },

  async "the slider goes to a time and back"() {
    await drop(page, tools.log("approach_stop"), tools.scene("approach_stop"));
    await settled(page);
    const end = await picture(page);
    await goTo(page, 5);
    await settled(page);
    const digest = await text(page, "#digest-now");
    assert.equal(digest, tools.digest(tools.log("approach_stop"), "--to", "5.001"));
    assert.notEqual(await picture(page), end);
    assert.match(await text(page, "#clock"), /^5\.00 s$/);
    await goTo(page, 2);
    assert.notEqual(await text(page, "#digest-now"), digest);
    await goTo(page, 5);
    assert.equal(await text(page, "#digest-now"), digest);
    await page.locator("#alerts button").last().click();
    await page.waitForFunction(() => Number.parseFloat(document.getElementById("clock").textContent) > 7);
  },

  async "plays its own recording from the start on opening, where motion is welcome"() {
    const playing = await browser.open({ before: { run: frameClock }, reducedMotion: "no-preference" });
    assert.equal(await text(playing, "#title"), `${FIRST}.log`);
    assert.equal(await shown(playing), "0.00", "before its first frame it shows the beginning");
    assert.equal(await text(playing, "#banner"), "No alert");
    assert.ok(await playing.locator("#objects tbody tr").count() < 3, "objects of the end are not shown at the beginning");
    await frames(playing, 20, 50);
    await frames(playing, 1, 0);  // a frame later it is drawn
    assert.equal(await text(playing, "#clock"), "1.00 s");
    assert.ok(Number(await shown(playing)) > 0.9);
    assert.equal(await playing.getAttribute("#play", "aria-label"), "Pause");
    await playing.selectOption("#recordings", { label: "wro_lap.log" });
    await playing.waitForFunction(() => document.getElementById("play").getAttribute("aria-label") === "Pause" && document.title.startsWith("wro_lap"), null, POLLED);
    await frames(playing, 10, 50);
    await frames(playing, 1, 0);
    assert.equal(await text(playing, "#clock"), "0.50 s");
    await drop(playing, tools.log("corridor"));
    assert.equal(await playing.getAttribute("#play", "aria-label"), "Play", "a log of one's own is shown whole");
    await playing.context().close();
    const still = await browser.open({ before: { run: frameClock } });
    await frames(still, 20, 50);
    assert.equal(await still.getAttribute("#play", "aria-label"), "Play");
    assert.equal(await shown(still), Number(await still.getAttribute("#slider", "max")).toFixed(2));
    await still.context().close();
  },

  async "in the recording that opens first, STOP means stop: the robot stands, turns away, goes around and on"() {
    const { alerts } = JSON.parse(tools.result(tools.log(FIRST)));
    const poses = readFileSync(tools.log(FIRST), "latin1").split("\n").filter((line) => line.startsWith("$FPODO")).map((line) => line.split("*")[0].split(",").slice(1).map(Number));
    const levels = alerts.map(({ level }) => level).filter((level, i, all) => level !== all[i - 1]);
    assert.deepEqual(levels, ["notice", "warn", "stop", "notice", "clear", "notice", "warn", "stop"]);
    let driven = 0;
    let after = 0;
    poses.slice(1).forEach(([t, x, y, heading], i) => {
      const [, x0, y0, h0] = poses[i];
      const middle = (heading + h0) / 2;
      const [ahead, aside] = [(x - x0) * Math.cos(middle) + (y - y0) * Math.sin(middle), (y - y0) * Math.cos(middle) - (x - x0) * Math.sin(middle)];
      assert.ok(Math.abs(aside) < 0.001, `sideways at ${t} s`);
      driven += Math.abs(ahead);
      const stops = new Map();  // by object: when the stop in force began
      for (const alert of alerts.filter((one) => one.t <= t)) {
        if (alert.level !== "stop") stops.delete(alert.id); else if (!stops.has(alert.id)) stops.set(alert.id, alert.t);
      }
      if ([...stops.values()].some((began) => began < t - BRAKES)) assert.ok(Math.abs(ahead) < 0.001, `it drives at ${t} s, ${BRAKES} s after a stop`);
      if (t > alerts.find(({ level }) => level === "stop").t + BRAKES) after += Math.abs(ahead);
    });
    assert.ok(after > 2 && driven > 3, `${after} m after the first stop, ${driven} m in all`);
  },

  async "plays by the space bar, and stops; arrows step"() {
    const stepped = await browser.open({ before: { run: frameClock } });
    await stepped.focus("#map");
    await stepped.keyboard.press("Home");
    await frames(stepped, 1, 50);
    assert.equal(await text(stepped, "#clock"), "0.00 s");
    await stepped.keyboard.press(" ");
    await frames(stepped, 10, 50);
    await stepped.keyboard.press(" ");
    for (let i = 0; i < 2; ++i) {
      await frames(stepped, 10, 50);
      assert.equal(await text(stepped, "#clock"), "0.50 s");
      assert.equal(await shown(stepped), "0.50");
    }
    for (const [key, then] of [["Shift+ArrowRight", "1.50"], ["ArrowLeft", "1.40"], ["End", Number(await stepped.getAttribute("#slider", "max")).toFixed(2)]]) {
      await stepped.keyboard.press(key);
      await frames(stepped, 1, 50);
      assert.equal(await text(stepped, "#clock"), `${then} s`);
      assert.equal(await shown(stepped), then);
    }
    await stepped.context().close();
  },

  async "stops where its clock is, however long the way to what it shows takes"() {
    const slow = await browser.open({ before: { run: frameClock } });
    await goTo(slow, 15);
    await slow.evaluate(() => { window.slow = 20; });  // each look at the clock ends the page's turn of work
    await slow.keyboard.press(" ");
    await frames(slow, 10, 50);
    await slow.keyboard.press(" ");
    await frames(slow, 1, 50);
    const there = await text(slow, "#clock");
    await slow.waitForFunction((t) => document.documentElement.dataset.shown === t, Number.parseFloat(there).toFixed(2), POLLED);
    await frames(slow, 1, 50);
    assert.equal(await text(slow, "#clock"), there);
    await slow.context().close();
  },

  async "the alert in force is in view in the list, from the first"() {
    const seen = (page) => page.evaluate(() => {
      const row = document.querySelector("#alerts tr.lit");
      const [box, head] = [row.closest(".scroll"), row.closest("table").tHead].map((element) => element.getBoundingClientRect());
      const { top, bottom } = row.getBoundingClientRect();
      return top >= head.bottom - 1 && bottom <= box.bottom + 1;
    });
    for (const viewport of [{ width: 1280, height: 800 }, { width: 1280, height: 900 }, { width: 400, height: 800 }]) {
      const opened = await browser.open({ viewport });
      for (const log of [FIRST, "wro_lap"]) {
        if (log !== FIRST) await drop(opened, tools.log(log));
        await settled(opened);
        assert.ok(await seen(opened), `${log} at ${viewport.width} x ${viewport.height}`);
        await goTo(opened, 12);
        await settled(opened);
        assert.ok(await seen(opened), `${log} at ${viewport.width} x ${viewport.height}, 12 s`);
      }
      await opened.context().close();
    }
  },

  async "says what it is, and what its map's signs are; the first screen has all that one plays with"() {
    const opened = await browser.open({ viewport: { width: 1280, height: 800 } });
    assert.match(await text(opened, "#about"), /^See what a small robot knows of the obstacles around it, .* STOP\.$/);
    for (const part of ["#about", "#banner", "#map", "#legend", "#play", "#slider", "#camera", "#alerts tr.lit", "#objects tbody tr:first-child"]) {
      const { y, height } = await opened.locator(part).boundingBox();
      assert.ok(y >= 0 && y + height <= 800, `${part}: ${y} to ${y + height}`);
    }
    const legend = () => opened.locator("#legend li").evaluateAll((lines) => lines.filter((line) => !line.hidden).map((line) => line.textContent.replace(/\s+/g, " ").trim()));
    assert.deepEqual(await legend(), ["floor ahead: what stands here raises notice, warn, stop", "in the camera's view",
      "an obstacle as the robot knows it: the fainter, the less sure; ? hardly", "a side that it has not seen", "what really stands there", "driven to come"]);
    await opened.click("#layers summary");
    assert.ok(!await opened.getByLabel("guard's points", { exact: true }).isChecked());
    await opened.getByLabel("guard's points", { exact: true }).click();
    await opened.getByLabel("camera", { exact: true }).click();
    await settled(opened);
    assert.deepEqual((await legend()).filter((line) => /guard|camera/.test(line)), ["× a foot that the guard remembers"]);
    await drop(opened, tools.log("approach_stop"));
    await settled(opened);
    assert.ok(!(await legend()).includes("what really stands there"), "there is no truth");
    await opened.context().close();
  },

  async "names of the truth are said under the pointer alone"() {
    await drop(page, tools.log("approach_stop"), tools.scene("approach_stop"));
    await settled(page);
    const labels = await page.locator("#map").evaluate((canvas) => canvas.placed.map(({ text }) => text));
    assert.deepEqual(labels, ["1 red", "2 yellow"]);
    const tips = await tipsOn(page);
    assert.ok([...tips].some((tip) => tip.endsWith("truth: box in the way")), [...tips].join("\n\n"));
  },

  async "the worst alert stands above the map in words; a tour goes through the page and ends at the wheel"() {
    const toured = await browser.open();
    await toured.click("#tour");
    await toured.waitForSelector("#tour-card:not([hidden])");
    const seen = new Set();
    for (let step = 1; step <= 5; ++step) {
      assert.equal(await text(toured, "#tour-step"), `${step} of 5`);
      seen.add(await text(toured, "#tour-text"));
      assert.equal(await toured.locator(".toured").count(), 1);
      if (step === 4) await toured.waitForFunction(() => document.documentElement.dataset.shown === "6.00", null, POLLED);
      if (step === 4) assert.match(await text(toured, "#banner"), /^STOP: 1 red, 0\.\d\d m (ahead|away)/);
      if (step === 2) assert.deepEqual(await complaints(toured), []);
      await toured.click("#tour-next");
    }
    assert.equal(seen.size, 5);
    assert.ok(await toured.locator("#tour-card").isHidden());
    assert.ok(await toured.locator("#driving").isVisible());
    await toured.context().close();
  },

  async "sound is heard on request alone"() {
    const heard = await browser.open({ reducedMotion: "no-preference", before: { run: () => {
      window.beeps = [];
      window.AudioContext = class { currentTime = 0; destination = null; close() {} };
      window.OscillatorNode = class { constructor(_, { frequency }) { window.beeps.push([document.querySelector("#banner").className.split(" ")[1], frequency]); } connect() { return this; } start() {} stop() {} };
      window.GainNode = class { gain = { setTargetAtTime() {} }; connect() { return this; } };
    } } });
    await goTo(heard, 5.5);
    await heard.keyboard.press(" ");
    await heard.waitForFunction(() => Number(document.documentElement.dataset.shown) > 5.7, null, POLLED);
    assert.deepEqual(await heard.evaluate(() => window.beeps), []);
    await heard.click("#sound");
    await heard.waitForFunction(() => window.beeps.length > 0, null, POLLED);
    const hertz = { notice: 440, warn: 660, stop: 880, blind: 330 };
    // Which alert is in force when the sound comes on depends on how fast the machine plays.
    for (const [level, frequency] of await heard.evaluate(() => window.beeps)) assert.equal(frequency, hertz[level], level);
    await heard.context().close();
  },

  async "layers, models, 3-D, zoom and colours change the picture"() {
    const seen = new Set([await picture(page)]);
    const other = async (what) => {
      await settled(page);
      const now = await picture(page);
      assert.ok(!seen.has(now), what);
      seen.add(now);
    };
    await page.click("#layers summary");
    for (const layer of ["truth", "alert zones", "camera", "names", "carve", "hybrid"]) {
      await page.getByLabel(layer, { exact: true }).click();
      await other(layer);
    }
    await page.click("#layers summary");
    await page.click("#zoom-in");
    await other("zoom");
    await page.mouse.move(300, 300);
    await page.mouse.down();
    await page.mouse.move(340, 330, { steps: 3 });
    await page.mouse.up();
    await other("pan");
    await page.click("#solid");
    await other("3-D");
    await page.click("#theme");
    await other("colours");
    await page.click("#theme");
    await page.click("#top");
  },

  async "a tooltip has the object's numbers"() {
    await drop(page, tools.log("approach_stop"));
    await page.click("#fit");
    await settled(page);
    const found = [...await tipsOn(page)].find((tip) => tip.startsWith("1 red"));
    assert.match(found, /1 red\nconfirmed, \d+ views.*\nx \d/s);
  },

  async "the result that it saves is the command line's"() {
    await drop(page, tools.log("approach_stop"));
    await goTo(page, 3);
    const saved = page.waitForEvent("download");
    await page.click("#save-result");
    assert.equal(readFileSync(await (await saved).path(), "utf8"), tools.result(tools.log("approach_stop")));
    await goTo(page, 5);
    assert.equal(await text(page, "#digest-now"), tools.digest(tools.log("approach_stop"), "--to", "5.001"));
  },

  async "names are text, whatever is in them"() {
    const lines = readFileSync(tools.log("approach_stop"), "latin1").replace(/\$FPSIG[^\n]*\n/g, record(`FPSIG,1,d02020,${escaped(HOSTILE)}`));
    const scene = JSON.parse(readFileSync(tools.scene("approach_stop")));
    for (const object of scene.objects) object.name = HOSTILE;
    await drop(page, { name: `${HOSTILE}.log`, bytes: Buffer.from(lines, "latin1") }, { name: `${HOSTILE}.json`, bytes: Buffer.from(JSON.stringify(scene)) });
    assert.equal(await text(page, "#title"), `${HOSTILE}.log`);
    assert.match(await text(page, "#objects"), /<img src=x/);
    assert.equal(await page.locator("img").count(), 0);
    assert.equal(await page.evaluate(() => window.hacked), undefined);
  },

  async "says what is wrong with a corrupt log, by line"() {
    const lines = readFileSync(tools.log("approach_stop"), "latin1").split("\n");
    lines[41] = lines[41].replace(/\d/, "x");
    lines[99] = "$FPODO,1";
    await drop(page, { name: "corrupt.log", bytes: Buffer.from(lines.join("\n").slice(0, -20), "latin1") });
    const rows = await page.locator("#problems tbody tr").allTextContents();
    assert.equal(rows.length, 3);
    assert.match(rows[0], /^42crc/);
    assert.match(rows[1], /^100crc\$FPODO,1/);
    assert.match(rows[2], /truncated/);
    assert.match(await text(page, "#problems"), /2 lines not used, crc: damaged on its way/);
    assert.deepEqual(await complaints(page), []);
    await page.screenshot({ path: join(tools.npm, "corrupt.png") });
  },

  async "says why a file is no log"() {
    for (const [bytes, why] of [["", /empty/], ["hello\nworld\n", /no record in 2 lines/], [record("FPHDR,9,a,b,c,full"), /stream format 9/],
      [record("FPODO,0.0000,0.0000,0.0000,0.0000"), /no frame record/]]) {
      await drop(page, { name: `bad${bytes.length}.log`, bytes: Buffer.from(bytes) });
      assert.match(await text(page, "#problems"), why);
      assert.match(await text(page, "#summary"), /cannot be replayed/);
    }
    await drop(page, tools.log("stop_nxtcam"));
    assert.ok(await page.locator("#problems").isHidden());
  },

  async "many logs stand side by side"() {
    await drop(page, ...["stop_pixy2", "stop_nxtcam", "stop_cmucam2"].map((name) => tools.log(name)));
    await page.waitForFunction(() => document.querySelectorAll(".card").length === 3);
    const digests = await page.locator(".card code").allTextContents();
    assert.deepEqual(digests, ["stop_pixy2", "stop_nxtcam", "stop_cmucam2"].map((name) => tools.digest(tools.log(name))));
    const rows = () => page.locator("#all-table tbody tr").evaluateAll((all) => all.map((row) => [...row.cells].map((cell) => cell.textContent)));
    const logs = ["stop_pixy2", "stop_nxtcam", "stop_cmucam2"];
    assert.deepEqual((await rows()).map(([name]) => name), logs.map((name) => `${name}.log`));
    for (const [name, driven, , stops, first, objects, reckless, paranoid, errors] of await rows()) {
      assert.deepEqual([reckless, paranoid], ["–", "–"], "no truth came along");
      const { path, alerts, objects: all } = JSON.parse(tools.result(tools.log(name.replace(/\.log$/, ""))));
      const way = path.slice(1).reduce((sum, [, x, y], i) => sum + Math.hypot(x - path[i][1], y - path[i][2]), 0);
      assert.ok(Math.abs(Number(driven) - way) < 0.02, `${name}: ${driven} of ${way} m`);
      const levels = alerts.filter(({ level }, i) => level === "stop" && alerts.slice(0, i).findLast(({ id }) => id === alerts[i].id)?.level !== "stop");
      assert.equal(Number(stops), levels.length);
      assert.equal(first, levels.length ? levels[0].t.toFixed(2) : "–");
      assert.equal(Number(objects), all.filter(({ state }) => state !== "tentative").length);
      assert.equal(errors, "0");
    }
    // With the room of each log: its share that is missed, and what is in vain, as `evaluate` has them for its one object.
    await drop(page, ...["stop_pixy2", "stop_nxtcam"].flatMap((name) => [tools.log(name), tools.scene(name)]));
    await page.waitForFunction(() => document.querySelectorAll(".card").length === 5);
    for (const [name, , , , , , reckless, paranoid] of (await rows()).slice(3)) {
      const own = name.replace(/\.log$/, "");
      const [, r, p] = /hybrid .* (\d+)\/(\d+)\/\d+$/m.exec(tools.says("evaluate", tools.log(own), "--scene", tools.scene(own)));
      assert.deepEqual([reckless, paranoid], [r, p], name);
    }
    // One scene that is of none by its name is the room of all.
    const room = { name: "room.json", bytes: readFileSync(tools.scene("stop_pixy2")) };
    await drop(page, tools.log("stop_pixy2"), tools.log("stop_cmucam2"), room);
    await page.waitForFunction(() => document.querySelectorAll(".card").length === 7);
    assert.ok((await rows()).slice(5).every(([, , , , , , reckless]) => /^\d+$/.test(reckless)));
    await page.getByRole("button", { name: "recklessness, %" }).click();
    const reckless = (await rows()).map((row) => row[6]);
    assert.deepEqual(reckless.slice(-3), ["–", "–", "–"], "sorted; what is not known is last");
    await page.getByRole("button", { name: "driven, m" }).click();
    const by = (await rows()).map((row) => Number(row[1]));
    assert.deepEqual(by, [...by].sort((a, b) => a - b), "sorted by its column");
    await page.getByRole("button", { name: "Open stop_cmucam2.log" }).first().click();
    await page.waitForFunction(() => document.title.startsWith("stop_cmucam2"));
    assert.deepEqual(await complaints(page), []);
  },

  async "a robot on a port: live map, recording, download"() {
    const log = readFileSync(tools.log("stop_pixy2"));
    const live = await browser.open({ before: { run: standIn, with: { base64: log.toString("base64"), portion: 997, every: 15 } } });
    await live.click("#connect");
    await live.click("#port-open");
    await live.waitForFunction(() => Number(/(\d+) records/.exec(document.getElementById("port-state").textContent)?.[1]) > 60);
    assert.equal(await text(live, "#title"), "Robot, live");
    assert.match(await live.evaluate(() => window.written), /mode log\rreset\r/);
    await live.waitForFunction((size) => document.getElementById("port-state").textContent.includes(`${size} bytes`), log.length);
    assert.equal(await live.locator("#objects tbody tr").count(), 1);
    const saved = live.waitForEvent("download");
    await live.click("#port-save");
    assert.deepEqual(readFileSync(await (await saved).path()), log);
    await live.click("#port-close");
    await live.waitForSelector("#digest");
    assert.equal(await text(live, "#digest"), tools.digest(tools.log("stop_pixy2")));
    await live.context().close();
  },

  async "a port's errors have a cause and a fix"() {
    const live = await browser.open({ before: [{ run: standIn, with: {} }, { run: hurry }] });
    await live.click("#connect");
    for (const [fault, says, fix] of [["NotFoundError", /No port was chosen/, /cable carries power only/], ["NetworkError", /could not be opened/, /dialout/],
      ["InvalidStateError", /open already/, /other tab/], ["noise", /no text/, /another speed/], ["chatter", /no record/, /mode log/], ["unplug", /unplugged/, /Close what/],
      ["never", /could not be opened/, /dialout/], ["deaf", /no record/, /mode log/], ["noise", /no text/, /another speed/]]) {
      await live.evaluate((name) => { window.fault = name; window.hurried = name === "never"; }, fault);
      await live.click("#port-open");
      await live.waitForFunction((words) => new RegExp(words).test(document.getElementById("port-error").textContent), says.source);
      assert.match(await text(live, "#port-error"), fix);
      if (await live.locator("#port-close").isEnabled()) await live.click("#port-close");
      await live.waitForFunction(() => !document.getElementById("port-open").disabled);
    }
    assert.deepEqual(await complaints(live), []);
    await live.context().close();
    const without = await browser.open({ before: { run: () => delete Navigator.prototype.serial } });
    await without.click("#connect");
    assert.match(await text(without, "#port-error"), /no Web Serial.*fencepost record/s);
    await without.context().close();
  },

  async "is 400 px wide without a sideways scroll, and accessible, by day and by night"() {
    for (const colorScheme of ["light", "dark"]) {
      const phone = await browser.open({ viewport: { width: 400, height: 800 }, colorScheme });
      assert.equal(await phone.evaluate(() => document.documentElement.scrollWidth), 400);
      assert.equal(await phone.evaluate(() => document.documentElement.dataset.theme), colorScheme);
      assert.deepEqual(await complaints(phone), []);
      await phone.context().close();
    }
    await page.click("#connect");
    for (let i = 0; i < 2; ++i) {
      assert.deepEqual(await complaints(page), []);
      await page.click("#theme");
    }
  },

  async "speaks the browser's language, or the chosen one; no English is left, and nothing is cut off"() {
    const page = await browser.open({ locale: "de-CH" });
    assert.equal(await page.locator("html").getAttribute("lang"), "de");
    assert.match(await text(page, "#summary"), /^20\.5 s, 205 Bilder, 3 Objekte \(3 bestätigt\), 43 Warnungen$/);
    await page.click("#connect");
    await page.click("#board-open");
    await page.click("#layers summary");
    for (const language of ["es", "fr", "zh"]) {
      await page.selectOption("#language", language);
      assert.equal(await page.locator("html").getAttribute("lang"), language);
      for (const width of [400, 1280]) {
        await page.setViewportSize({ width, height: 800 });
        assert.equal(await page.evaluate(() => document.documentElement.scrollWidth), width, `${language} at ${width}`);
      }
    }
    // In Chinese each word in Latin letters is the program's, a robot's or a log's.
    const program = /^(Fencepost|fencepost|BOOTSEL|drive|lost|mode|log|reset|full|small|micro|profile|stop|warn|notice|clear|blind|STOP|WARN|NOTICE|red|yellow|green|blue|pixy2|id|confirmed|tentative|hybrid|cylinder\w*|sheaf\w*|carve\w*|clip\w*|go_around|wro_lap|approach_stop|box|can|wall|grey|corridor|boards|html|replay|Shift|Home|End|JSON|PNG|json|Deutsch|English|Español|Français|Web|Serial)$/;
    await page.evaluate(() => { navigator.getGamepads = () => []; });
    await page.click("#drive");
    for (const part of ["shown", "driven"]) {
      if (part === "driven") await page.click("#drive-end");
      const texts = await page.evaluate(() => {
        const found = [];
        const walk = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT | NodeFilter.SHOW_ELEMENT);
        for (let node = walk.nextNode(); node; node = walk.nextNode()) {
          if (node.nodeType === Node.ELEMENT_NODE) found.push(...["aria-label", "aria-valuetext"].map((name) => node.getAttribute(name) ?? ""));
          else if (!node.parentElement.closest("script, style")) found.push(node.data);
        }
        return found;
      });
      const words = texts.flatMap((one) => one.match(/[A-Za-z][A-Za-zÀ-ÿ_0-9]{2,}/g) ?? []).filter((word) => !program.test(word) && !/^[0-9a-f]{6,}$/.test(word));
      assert.deepEqual([...new Set(words)], [], part);
    }
    await page.context().close();
  },

  async "axe finds what is planted"() {
    const planted = await browser.open();
    await planted.evaluate(() => { document.body.append(document.createElement("button")); });
    assert.match((await complaints(planted)).join(), /button-name/);
    await planted.context().close();
  },

  async "fencepost report writes the page with logs in it, strange names and corrupt ones too"() {
    const folder = mkdtempSync(join(tmpdir(), "fencepost-page-"));
    try {
      const log = join(folder, "<!--<script>.log");
      const corrupt = join(folder, "corrupt.log");
      const foreign = join(folder, "foreign.log");
      writeFileSync(log, readFileSync(tools.log("stop_nxtcam")));
      writeFileSync(corrupt, readFileSync(tools.log("stop_pixy2"), "latin1").replace(/FPODO,0/, "FPODO,x"));
      writeFileSync(foreign, "hello\n");
      const file = join(folder, "run.html");
      execFileSync(tools.cli, ["report", log, "--scene", tools.scene("stop_nxtcam"), "-o", file], { stdio: "ignore" });
      const report = await browser.open({ file });
      assert.equal(await text(report, "#title"), "<!--<script>.log");
      assert.equal(await text(report, "#digest"), tools.digest(log));
      await report.context().close();
      execFileSync(tools.cli, ["report", log, corrupt, foreign, "--profile", "small", "-o", file], { stdio: "ignore" });
      const several = await browser.open({ file });
      assert.deepEqual(await several.locator(".card b").allTextContents(), ["<!--<script>.log", "corrupt.log", "foreign.log"]);
      assert.equal(await text(several, "#digest"), tools.digest(log, "--profile", "small"));
      assert.match(await text(several, ".card:nth-child(3)"), /no record in 1 line/);
      await several.getByRole("button", { name: "Open corrupt.log" }).click();
      await several.waitForFunction(() => /1 line not used, crc/.test(document.getElementById("problems").textContent));
      assert.equal(await several.locator("script").count(), 3, "the bundle, what is given, and the page's own");
      await several.context().close();
    } finally {
      rmSync(folder, { recursive: true });
    }
  },

  async "of a log that is too long a report shows what was kept, says so, and goes to any time of it"() {
    const folder = mkdtempSync(join(tmpdir(), "fencepost-page-"));
    try {
      const log = join(folder, "long.log");
      const file = join(folder, "long.html");
      const noise = randomBytes(2_000_000).toString("base64").replace(/.{76}/g, "$&\n");  // which nothing packs
      writeFileSync(log, `${readFileSync(tools.log("wro_lap"), "latin1")}${noise}\n`);
      execFileSync(tools.cli, ["report", log, tools.log("corridor"), "--scene", tools.scene("wro_lap"), "--scene", tools.scene("corridor"), "-o", file], { stdio: "ignore" });
      assert.ok(statSync(file).size < 2_000_000);
      const report = await browser.open({ file });
      assert.match(await text(report, "#thinned"), /^Thinned to fit: \d+ of \d+ poses, all \d+ alerts, map and camera at \d+ times/);
      assert.equal(await text(report, "#digest"), tools.digest(log));
      assert.ok(await report.locator("#profile").isDisabled());
      assert.match(await text(report, ".card:first-child"), /7 objects, \d+ alerts/);
      const rows = () => report.locator("#objects tbody tr").count();
      assert.equal(await rows(), 7);
      await goTo(report, 2);
      const [early, frame] = [await rows(), await text(report, "#camera-note")];
      assert.ok(early > 0 && early < 7, `${early} objects at 2 s`);
      assert.ok(Math.abs(Number(/at ([\d.]+) s/.exec(frame)[1]) - 2) < 0.6, frame);
      await goTo(report, 15);
      assert.notEqual(await text(report, "#camera-note"), frame);
      assert.deepEqual(await complaints(report), []);
      await report.getByRole("button", { name: "Open corridor.log" }).click();
      await report.waitForFunction((wanted) => document.getElementById("digest").textContent === wanted, tools.digest(tools.log("corridor")));
      assert.ok(await report.locator("#thinned").isHidden());
      assert.ok(await report.locator("#profile").isEnabled());
      await report.context().close();
    } finally {
      rmSync(folder, { recursive: true });
    }
  },

  async "a log is replayed with the profile that is chosen"() {
    await drop(page, tools.log("wro_lap"));
    for (const profile of ["micro", "small", "full", "the log's own"]) {
      await page.selectOption("#profile", { label: profile });
      const digest = tools.digest(tools.log("wro_lap"), ...(profile.startsWith("the") ? [] : ["--profile", profile]));
      await page.waitForFunction((wanted) => document.getElementById("digest")?.textContent === wanted && document.getElementById("progress").hidden, digest);
    }
    assert.match(await text(page, "#facts"), /profilefull/);
  },

  async "nothing was asked of a network, and nothing failed"() {
    assert.deepEqual(browser.requests, []);
    assert.deepEqual(browser.errors, []);
    const refused = await page.evaluate(() => new Promise((resolve) => {
      document.addEventListener("securitypolicyviolation", (event) => resolve(event.effectiveDirective));
      fetch("https://example.org/").catch(() => {});
    }));
    assert.equal(refused, "connect-src");
    const planted = await page.evaluate(() => new Promise((resolve) => {
      document.addEventListener("securitypolicyviolation", (event) => resolve(event.effectiveDirective), { once: true });
      document.body.append(Object.assign(document.createElement("script"), { textContent: "window.hacked = 1" }));
    }));
    assert.match(planted, /script-src/);
    assert.equal(await page.evaluate(() => window.hacked), undefined);
  },
}, process.argv[6]);
await browser.close();
