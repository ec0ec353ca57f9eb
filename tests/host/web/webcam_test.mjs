// usage: node webcam_test.mjs PAGE CLI NPM SHARE [PART]: the page with a camera, in headless Chromium. The camera plays a film: an orange
// box stands, comes, and stands again. Black and white cells in the upper left corner are the number of each picture. Where it matters which
// pictures the page takes and when, the test shows them, one after the other, and the page's clock is the film's.
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { BITS, CELL, COMES, HEIGHT, LENGTH, RATE, SPEED, WIDTH, distanceAt, pictures, truthAt, y4m } from "./film.mjs";
import { Browser, POLLED, Tools, run, text } from "./harness.mjs";

const CLOSE = 3;  // px, between a box and the truth

const tools = new Tools(process.argv.slice(2));
const film = pictures();
const folder = mkdtempSync(join(tmpdir(), "fencepost-webcam-"));
const capture = join(folder, "comes.y4m");
writeFileSync(capture, y4m(film));
const browser = await Browser.start(tools, ["--use-fake-ui-for-media-stream", "--use-fake-device-for-media-stream", `--use-file-for-fake-video-capture=${capture}`]);

/** Runs in the page, before it: the number of each picture that the page takes, and the streams that it was given. With `paced` the page takes
 * those that are handed to window.project(), at their times, in the place of the camera's. `aside`: px that the page draws the camera's picture
 * beside where it belongs. */
function watch({ cell, bits, aside, paced }) {
  window.taken = [];
  window.streams = [];
  const { getImageData, drawImage } = CanvasRenderingContext2D.prototype;
  CanvasRenderingContext2D.prototype.getImageData = function data(...area) {
    const image = getImageData.apply(this, area);
    let number = 0;
    for (let i = 0; i < bits; ++i) if (image.data[4 * (cell / 2 * image.width + cell * i + cell / 2)] > 128) number += 1 << i;
    window.taken.push(number);
    return image;
  };
  CanvasRenderingContext2D.prototype.drawImage = function draw(image, x, ...rest) {
    return image instanceof HTMLVideoElement ? drawImage.call(this, window.shown ?? image, x + aside, ...rest) : drawImage.call(this, image, x, ...rest);
  };
  if (paced) {
    let look = null;
    HTMLVideoElement.prototype.requestVideoFrameCallback = (callback) => { look = callback; };
    const clock = performance.now.bind(performance);
    window.project = (base64, codedWidth, codedHeight, ms) => {
      const colorSpace = { matrix: "smpte170m", primaries: "bt709", transfer: "iec61966-2-1", fullRange: false };
      window.shown = new VideoFrame(Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)), { format: "I420", codedWidth, codedHeight, timestamp: 1000 * ms, colorSpace });
      performance.now = () => ms;
      look();
      performance.now = clock;
      window.shown.close();
    };
  }
  const devices = navigator.mediaDevices;
  const ask = devices.getUserMedia.bind(devices);
  devices.getUserMedia = async (...wanted) => {
    const stream = await ask(...wanted);
    window.streams.push(stream);
    return stream;
  };
}

/** Runs in the page, before it: the page waits as long as it takes. A second and more is over soon while window.hurried, else never; what comes
 * again and again comes when the test calls the last of window.looks. */
function patience() {
  window.hurried = false;
  window.looks = [];
  const wait = window.setTimeout.bind(window);
  window.setTimeout = (what, ms, ...more) => ms >= 1000 && !window.hurried ? 0 : wait(what, ms >= 1000 ? ms / 50 : ms, ...more);
  window.setInterval = (what) => window.looks.push(what);
}

const opened = (how = {}, more = {}) => browser.open({ before: [{ run: watch, with: { cell: CELL, bits: BITS, aside: 0, ...how } }, { run: patience }], ...more });
/** When the page has taken a picture of those. */
const taken = (page, from, to) => page.waitForFunction(([a, b]) => window.taken.at(-1) >= a && window.taken.at(-1) < b, [from, to], POLLED);
const live = (page) => page.evaluate(() => window.streams.flatMap((stream) => stream.getTracks()).filter(({ readyState }) => readyState === "live").length);

async function saved(page, button, name) {
  const download = page.waitForEvent("download");
  await page.click(button);
  const file = join(folder, name);
  await (await download).saveAs(file);
  return file;
}

/** The film from a click on the box to where it has come: what the page said, and its log, colours and pictures by number. */
async function follow(page, name, train) {
  await page.click("#webcam");
  await page.waitForSelector("#watching:not([hidden])");
  let number = 0;
  const play = async (to) => {
    for (; number < to; ++number) {
      await page.evaluate((picture) => window.project(...picture), [film[number].toString("base64"), WIDTH, HEIGHT, 1000 * number / RATE]);
    }
  };
  await play((COMES - 2) * RATE);
  assert.equal(await text(page, "#banner"), "No alert");
  await train(page);
  assert.equal(await text(page, "#webcam-said"), "Trained: orange.");
  await play(COMES * RATE);
  const before = await text(page, "#banner");
  while (number < film.length && !(await text(page, "#banner")).startsWith("STOP")) await play(number + 1);
  const seen = await page.evaluate(() => ({ banner: document.getElementById("banner").textContent, colours: document.getElementById("webcam-colours").textContent }));
  const colours = await saved(page, "#webcam-save", `${name}.json`);
  const half = await saved(page, "#webcam-log", `${name}-half.log`);
  const picture = process.env.FENCEPOST_PICTURES && await page.screenshot({ path: join(process.env.FENCEPOST_PICTURES, `${name}.png`) });
  await page.click("#webcam-end");
  await page.waitForFunction(() => document.getElementById("watching").hidden && document.getElementById("progress").hidden && document.getElementById("digest"), null, POLLED);
  const log = await saved(page, "#save-log", `${name}.log`);
  return { before, seen, colours, half, log, picture, digest: await text(page, "#digest"), numbers: await page.evaluate(() => window.taken) };
}

/** Frames of a log with the numbers of their pictures: [{ t, number, boxes }]. */
function framesOf(log, numbers) {
  const frames = readFileSync(log, "latin1").split("\r\n").filter((line) => line.startsWith("$FPFRM,")).map((line) => {
    const [, t, , count, ...rest] = line.slice(0, line.indexOf("*")).split(",");
    const each = rest.length / Math.max(1, Number(count));
    return { t: Number(t), boxes: Array.from({ length: Number(count) }, (_, i) => rest.slice(i * each, (i + 1) * each).map(Number)) };
  });
  assert.ok(numbers.length >= frames.length, "each frame is a picture");
  return frames.map((frame, i) => ({ ...frame, number: numbers[numbers.length - frames.length + i] }));
}

/** How far the boxes of those frames are from the truth, px, at most. */
function farthest(frames) {
  assert.ok(frames.length > 40, `${frames.length} frames`);
  return Math.max(...frames.map(({ number, boxes }) => {
    assert.equal(boxes.length, 1, `picture ${number}`);
    const [signature, ...edges] = boxes[0];
    assert.equal(signature, 1);
    return Math.max(...truthAt(number).map((edge, i) => Math.abs(edge - edges[i])));
  }));
}

const click = (page) => page.click("#camera");
const after = (frames) => frames.slice(frames.findIndex(({ boxes }) => boxes.length));

await run({
  async "a click trains a colour; its boxes are true, STOP comes in time, and the log replays at the desk to the page's digest"() {
    const page = await opened({ paced: true });
    const made = await follow(page, "clicked", click);
    assert.equal(made.before, "No alert", "what stands is no danger");
    assert.match(made.seen.banner, /^STOP: .* contact in /);
    assert.equal(made.seen.colours, "orange");
    assert.ok(readFileSync(made.log, "latin1").startsWith(readFileSync(made.half, "latin1")));
    assert.equal(made.digest, tools.digest(made.log));
    const result = JSON.parse(tools.result(made.log));
    const frames = framesOf(made.log, made.numbers);
    assert.equal(result.log.frames, frames.length);
    assert.ok(Object.values(result.log.rejected).every((count) => count === 0));
    const off = farthest(after(frames));
    const stop = result.alerts.find(({ level }) => level === "stop");
    const then = frames.findLast(({ t }) => t <= stop.t);
    const left = distanceAt(then.number);
    console.log(`${frames.length} frames, boxes at most ${off} px off, STOP at picture ${then.number}, ${left.toFixed(2)} m away`);
    assert.ok(off <= CLOSE, `${off} px`);
    assert.ok(then.number > COMES * RATE, "not while it stood");
    assert.ok(left > SPEED, `${left} m are less than a second`);
    // At the desk the same film with the page's colours.
    const desk = JSON.parse(readFileSync(made.colours));
    assert.deepEqual(desk.signatures.map(({ id, name }) => [id, name]), [[1, "orange"]]);
    assert.match(tools.says("doctor", "--camera", `video:${capture}`, "--colours", made.colours), /works: .* 1\.0 blobs each/);
    assert.equal(await live(page), 0, "the camera is off");
  },

  async "a picture that is drawn a little aside is noticed"() {
    const page = await opened({ paced: true, aside: CLOSE + 1 });
    const made = await follow(page, "aside", click);
    const off = farthest(after(framesOf(made.log, made.numbers)));
    assert.ok(off > CLOSE, `${off} px`);
  },

  async "by the keyboard alone; a screen reader has all words; colours are forgotten; the camera is off when the page is left"() {
    const page = await opened();
    await page.focus("#webcam");
    await page.keyboard.press("Enter");
    await page.waitForSelector("#watching:not([hidden])");
    await taken(page, 1, COMES * RATE);
    assert.equal(await page.evaluate(() => document.activeElement.id), "camera");
    assert.ok(await page.isDisabled("#webcam-save") && await page.isDisabled("#webcam-forget"));
    for (let i = 0; i < 5; ++i) await page.keyboard.press("ArrowUp");
    for (let i = 0; i < 15; ++i) await page.keyboard.press("ArrowRight");
    await page.keyboard.press("Enter");
    assert.match(await text(page, "#webcam-said"), /^White and grey are no colours here/);
    for (let i = 0; i < 15; ++i) await page.keyboard.press("ArrowLeft");
    for (let i = 0; i < 5; ++i) await page.keyboard.press("ArrowDown");
    await page.keyboard.press("Enter");
    assert.equal(await text(page, "#webcam-said"), "Trained: orange.");
    assert.deepEqual(await browser.complaints(page), []);
    for (const language of ["de", "zh"]) {
      await page.selectOption("#language", language);
      assert.doesNotMatch(await text(page, "#webcam-said"), /Trained/);
    }
    await page.selectOption("#language", "en");
    await page.click("#webcam-forget");
    assert.equal(await text(page, "#webcam-colours"), "");
    assert.ok(await page.isDisabled("#webcam-save"));
    assert.equal(await live(page), 1);
    await page.evaluate(() => {
      Object.defineProperty(document, "hidden", { value: true, configurable: true });
      document.dispatchEvent(new Event("visibilitychange"));
    });
    assert.equal(await live(page), 0);
    assert.match(await text(page, "#webcam-error"), /^The camera was stopped, because this page was left\./);
    assert.ok(await page.isHidden("#watching"));
    await page.evaluate(() => { delete document.hidden; });
  },

  async "another log or a drive ends it, and a camera that is pulled out is said"() {
    const page = await opened();
    const begin = async () => {
      await page.click("#webcam");
      await page.waitForSelector("#watching:not([hidden])");
    };
    await begin();
    await page.click("#drive");
    assert.equal(await live(page), 0);
    assert.ok(await page.isHidden("#watching"));
    await begin();
    assert.ok(await page.isHidden("#driving"));
    await page.selectOption("#recordings", "1");
    await page.waitForFunction(() => document.title.startsWith("wro_lap"), null, POLLED);
    assert.equal(await live(page), 0);
    await begin();
    await page.evaluate(() => window.streams.at(-1).getVideoTracks()[0].dispatchEvent(new Event("ended")));
    assert.match(await text(page, "#webcam-error"), /^The camera is gone\./);
    assert.equal(await live(page), 0);
  },

  async "no camera, none allowed, one in use, or a page that gets none: a sentence says what to do"() {
    const page = await opened();
    const cases = { NotAllowedError: /does not let this page.*Allow it/, NotFoundError: /No camera was found.*Plug one in/, NotReadableError: /does not start.*Close other/,
      SecurityError: /gives no camera.*localhost/, TypeError: /cannot be used.*TypeError: why/ };
    for (const [name, says] of Object.entries(cases)) {
      await page.evaluate((error) => { navigator.mediaDevices.getUserMedia = () => Promise.reject(new DOMException("why", error)); }, name);
      await page.click("#webcam");
      await page.waitForFunction(() => !document.getElementById("webcam").disabled && document.getElementById("webcam-error").textContent, null, POLLED);
      assert.match(await text(page, "#webcam-error"), says);
      assert.ok(await page.isHidden("#watching"));
    }
    assert.deepEqual(await browser.complaints(page), []);
    await page.evaluate(() => Object.defineProperty(navigator, "mediaDevices", { value: undefined, configurable: true }));
    await page.click("#webcam");
    assert.match(await text(page, "#webcam-error"), /gives no camera.*localhost/);
  },

  async "a camera that never begins, or sends nothing any more, is let go with a sentence, and can be tried again"() {
    const page = await opened();
    await page.evaluate(() => {
      window.hurried = true;
      window.play = HTMLMediaElement.prototype.play;
      HTMLMediaElement.prototype.play = () => new Promise(() => {});
    });
    await page.click("#webcam");
    await page.waitForFunction(() => !document.getElementById("webcam").disabled, null, POLLED);
    assert.match(await text(page, "#webcam-error"), /^The camera does not start\..*TimeoutError/);
    assert.equal(await live(page), 0);
    await page.evaluate(() => {
      window.hurried = false;
      HTMLMediaElement.prototype.play = window.play;
    });
    await page.click("#webcam");
    await page.waitForSelector("#watching:not([hidden])");
    assert.equal(await text(page, "#webcam-error"), "");
    await taken(page, 1, LENGTH * RATE);
    await page.evaluate(() => { for (let looks = 0; looks < 7; ++looks) window.looks.at(-1)(); });
    assert.equal(await text(page, "#webcam-error"), "", "a camera may pause");
    await page.evaluate(() => {
      HTMLVideoElement.prototype.requestVideoFrameCallback = () => 0;
      for (let looks = 0; looks < 8; ++looks) window.looks.at(-1)();
    });
    assert.match(await text(page, "#webcam-error"), /^The camera sends no pictures any more\. Below is what it recorded/);
    assert.equal(await live(page), 0);
    await page.context().close();
  },

  async "a phone has room for it, and nothing asked for the network"() {
    const page = await opened({}, { viewport: { width: 400, height: 800 } });
    await page.click("#webcam");
    await page.waitForSelector("#watching:not([hidden])");
    await taken(page, 1, LENGTH * RATE);
    await click(page);
    if (process.env.FENCEPOST_PICTURES) await page.screenshot({ path: join(process.env.FENCEPOST_PICTURES, "phone.png") });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= document.documentElement.clientWidth));
    assert.deepEqual(browser.requests, []);
    assert.deepEqual(browser.errors, []);
  },
}, process.argv[6]);

await browser.close();
rmSync(folder, { recursive: true });
