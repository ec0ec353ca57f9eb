// usage: node picture_test.mjs PAGE CLI NPM SHARE [--write]: the README's picture is the page as it looks at the first stop of its
// first recording. Letters differ from machine to machine, so squares of it are compared. --write makes it anew.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { Browser, Tools, goTo, run, settled } from "./harness.mjs";

const tools = new Tools(process.argv.slice(2));
const picture = join(tools.shared, "doc/page.webp");
const [WIDTH, HEIGHT] = [1280, 784];
const AFTER = 0.4;       // s after the stop began
const SQUARE = 16;       // px
const DIFFERENT = 24;    // of 255: a square that looks different
const MOST = 0.01;       // share of the squares that may
const MOST_BYTES = 60_000;
const QUALITY = 0.75;    // of 1, as it is kept

const browser = await Browser.start(tools);
const page = await browser.open({ viewport: { width: WIDTH, height: HEIGHT } });

async function looksAt(t) {
  await goTo(page, t);
  await settled(page);
  return page.screenshot();
}

/** Small enough for a page that everybody loads. */
const packed = (png) => page.evaluate(async ([base64, quality]) => {
  const image = new Image();
  image.src = `data:image/png;base64,${base64}`;
  await image.decode();
  const canvas = new OffscreenCanvas(image.width, image.height);
  canvas.getContext("2d").drawImage(image, 0, 0);
  const bytes = new Uint8Array(await (await canvas.convertToBlob({ type: "image/webp", quality })).arrayBuffer());
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
}, [png.toString("base64"), QUALITY]);

/** Which share of the squares of two pictures looks different. */
const difference = (a, b) => page.evaluate(async ([first, second, width, height, square, different]) => {
  const colours = async (base64) => {
    const image = new Image();
    image.src = `data:;base64,${base64}`;
    await image.decode();
    const canvas = new OffscreenCanvas(width / square, height / square);
    const g = canvas.getContext("2d");
    g.imageSmoothingQuality = "high";
    g.drawImage(image, 0, 0, canvas.width, canvas.height);
    return g.getImageData(0, 0, canvas.width, canvas.height).data;
  };
  const [one, other] = [await colours(first), await colours(second)];
  let count = 0;
  for (let i = 0; i < one.length; i += 4) if ([0, 1, 2].some((c) => Math.abs(one[i + c] - other[i + c]) > different)) ++count;
  return count / (one.length / 4);
}, [a.toString("base64"), b.toString("base64"), WIDTH, HEIGHT, SQUARE, DIFFERENT]);

await run({
  async "the README's picture is the page at the first stop"() {
    const stop = JSON.parse(tools.result(tools.log("go_around"))).alerts.find(({ level }) => level === "stop").t;
    const now = await looksAt(stop + AFTER);
    if (process.argv[6] === "--write") writeFileSync(picture, Buffer.from(await packed(now), "base64"));
    const shown = readFileSync(picture);
    assert.ok(shown.length < MOST_BYTES, `${shown.length} bytes`);
    const share = await difference(shown, now);
    assert.ok(share <= MOST, `${(100 * share).toFixed(1)} % of the picture looks different: node tests/host/web/picture_test.mjs ... --write`);
    assert.ok(await difference(shown, await looksAt(stop - 1.5)) > 2 * MOST, "another time is found");
    assert.match(readFileSync(join(tools.shared, "../../README.md"), "utf8"), /\]\(host\/share\/doc\/page\.webp\)/);
  },
});
await browser.close();
