// usage: node drive_bench.mjs PAGE CLI NPM SHARE: pictures a second of a drive among twenty things, from above and in 3-D.
// The time of the page's thread counts. What other programs run on this machine hardly matters to it; drive_test.mjs holds the counts that it comes from.
// Last, how many pictures came in a second of real time: without a graphics card the painting is this machine's, too.
import { Browser, POLLED, Tools, frameClock, frames } from "./harness.mjs";
import { twentyThings } from "./twenty_things.mjs";

const FRAMES = 200;
const SECONDS = 4;
const tools = new Tools(process.argv.slice(2));
const browser = await Browser.start(tools);

async function begin(options) {
  const page = await browser.open(options);
  await page.click("#drive");
  await page.locator("#room-file").setInputFiles({ name: "twenty.json", mimeType: "", buffer: Buffer.from(JSON.stringify(twentyThings())) });
  await page.waitForFunction(() => document.getElementById("rooms").value === "", null, POLLED);
  await page.keyboard.down("ArrowUp");
  await page.keyboard.down("ArrowRight");
  return page;
}

const page = await begin({ before: { run: frameClock } });
const client = await page.context().newCDPSession(page);
await client.send("Performance.enable", { timeDomain: "threadTicks" });
const busy = async () => (await client.send("Performance.getMetrics")).metrics.find(({ name }) => name === "TaskDuration").value;
for (const view of ["top", "solid", "behind", "eye"]) {
  await page.click(`#${view}`);
  await frames(page, 40, 50);
  const before = await busy();
  await frames(page, FRAMES, 50);
  const cost = (await busy() - before) / FRAMES;
  console.log(`${view}: ${(1000 * cost).toFixed(1)} ms of the page's thread for a picture: ${(1 / cost).toFixed(0)} a second at most`);
}
await page.context().close();

const real = await begin({});
await real.click("#behind");
const count = await real.evaluate((seconds) => new Promise((done) => {
  let pictures = 0;
  const until = performance.now() + 1000 * seconds;
  const tick = (now) => { ++pictures; if (now < until) requestAnimationFrame(tick); else done(pictures); };
  requestAnimationFrame(tick);
}), SECONDS);
console.log(`behind, in real time: ${(count / SECONDS).toFixed(0)} pictures a second, painted by ${await real.evaluate(() => {
  const gl = document.createElement("canvas").getContext("webgl");
  return gl ? gl.getParameter(gl.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL ?? gl.RENDERER) : "this machine's processor";
})}`);
await browser.close();
