// usage: node pictures.mjs PAGE CLI NPM SHARE FOLDER [PART]: pictures of the page into FOLDER, to be looked at. First view, drive, webcam and a
// board at three sizes by day and night, further ones in German, and a film strip of a drive. PART: those whose names have it.
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { withImages } from "./board_images.mjs";
import { COMES, film } from "./film.mjs";
import { Browser, POLLED, Tools, frameClock, frames, goTo, settled } from "./harness.mjs";

const SIZES = [[1280, 800], [1920, 1080], [400, 800]];
const SCHEMES = ["light", "dark"];
const LANGUAGES = ["en", "de", "es", "fr", "zh"];
const AT = 5.2;           // s of the first recording: a STOP is near
const DRIVEN = [0, 1.5, 3, 4.5, 6, 7.5, 9, 10.5];  // s, of the film strip
const TURNS = { 6: "ArrowLeft", 9: "ArrowRight" };  // keys held from then on

const tools = new Tools(process.argv.slice(2));
const [folder, part = ""] = process.argv.slice(6);
mkdirSync(folder, { recursive: true });
const made = mkdtempSync(join(tmpdir(), "fencepost-pictures-"));
const capture = join(made, "comes.y4m");
writeFileSync(capture, film());
const boards = withImages(tools.page, join(made, "boards.html"));
const browser = await Browser.start(tools, ["--use-fake-ui-for-media-stream", "--use-fake-device-for-media-stream", `--use-file-for-fake-video-capture=${capture}`]);

const until = (page, condition, what) => page.waitForFunction(condition, what, POLLED);
/** How each view is come to. */
const VIEWS = {
  first: { async go(page) { await goTo(page, AT); } },
  solid: { async go(page) {
    await goTo(page, AT);
    await page.click("#behind");
  } },
  drive: { async go(page) {
    await page.click("#drive");
    await page.keyboard.down("ArrowUp");
    await until(page, () => document.getElementById("banner").textContent.startsWith("STOP"));
  } },
  webcam: { async go(page) {
    await page.click("#webcam");
    await page.waitForSelector("#watching:not([hidden])");
    await page.waitForTimeout(1500);
    await page.locator("#camera").evaluate((canvas) => {
      const { left, top, width, height } = canvas.getBoundingClientRect();
      canvas.dispatchEvent(new MouseEvent("click", { bubbles: true, clientX: left + width / 2, clientY: top + height * 0.52 }));
    });
    await page.waitForTimeout(1000 * COMES);
  } },
  board: { file: boards, async go(page) {
    await page.click("#board-open");
    await page.selectOption("#board-image", { label: "Raspberry Pi Pico, Pico W" });
    await page.selectOption("#board-odometry", "encoders");
  } },
  connect: { async go(page) { await page.click("#connect"); } },
  tour: { async go(page) {
    await page.click("#tour");
    await page.click("#tour-next");
    await page.click("#tour-next");
  } },
};

async function picture(view, [width, height], colorScheme, language = "en") {
  const name = `${view}-${width}-${colorScheme}-${language}`;
  if (!name.includes(part)) return;
  const { file, go } = VIEWS[view];
  const page = await browser.open({ ...(file ? { file } : {}), viewport: { width, height }, colorScheme, locale: language, ...(width < 800 ? { hasTouch: true, isMobile: true } : {}) });
  await go(page);
  await settled(page);
  await page.screenshot({ path: join(folder, `${name}.png`) });
  if (view !== "webcam") await page.screenshot({ path: join(folder, `${name}-whole.png`), fullPage: true });
  await page.context().close();
}

/** Moments of one drive, side by side. */
async function strip(colorScheme) {
  if (!`strip-${colorScheme}`.includes(part)) return;
  const page = await browser.open({ viewport: { width: 1280, height: 800 }, colorScheme, before: { run: frameClock } });
  await page.click("#drive");
  await page.keyboard.down("ArrowUp");
  const shots = [];
  let now = 0;
  for (const t of DRIVEN) {
    for (; now < t - 1e-9; now += 0.05) {
      for (const [from, key] of Object.entries(TURNS)) if (Math.abs(now - from) < 0.025) await page.keyboard.down(key);
      await frames(page, 1, 50);
    }
    shots.push((await page.locator(".map").screenshot()).toString("base64"));
  }
  const whole = await page.evaluate(async (all) => {
    const images = await Promise.all(all.map(async (base64) => {
      const image = new Image();
      image.src = `data:image/png;base64,${base64}`;
      await image.decode();
      return image;
    }));
    const [width, height] = [images[0].width / 2, images[0].height / 2];
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [4 * width, Math.ceil(images.length / 4) * height];
    const g = canvas.getContext("2d");
    g.imageSmoothingQuality = "high";
    images.forEach((image, i) => g.drawImage(image, i % 4 * width, Math.floor(i / 4) * height, width, height));
    return canvas.toDataURL().split(",")[1];
  }, shots);
  writeFileSync(join(folder, `strip-${colorScheme}.png`), Buffer.from(whole, "base64"));
  await page.context().close();
}

for (const scheme of SCHEMES) {
  for (const view of ["first", "drive", "webcam", "board"]) for (const size of SIZES) await picture(view, size, scheme);
  await strip(scheme);
}
for (const view of ["solid", "connect", "tour"]) for (const size of SIZES) await picture(view, size, "light");
for (const language of LANGUAGES.slice(1)) for (const view of ["first", "drive", "board"]) for (const size of [SIZES[0], SIZES[2]]) await picture(view, size, "light", language);
await browser.close();
rmSync(made, { recursive: true });
