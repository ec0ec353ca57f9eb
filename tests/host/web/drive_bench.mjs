// usage: node drive_bench.mjs PAGE CLI NPM SHARE: pictures a second of a drive, by the time of the page's thread. What other programs
// run on this machine hardly matters to it; drive_test.mjs holds the counts that it comes from.
import { Browser, Tools, frameClock, frames } from "./harness.mjs";

const FRAMES = 200;
const browser = await Browser.start(new Tools(process.argv.slice(2)));
const page = await browser.open({ before: { run: frameClock } });
const client = await page.context().newCDPSession(page);
await client.send("Performance.enable", { timeDomain: "threadTicks" });
const busy = async () => (await client.send("Performance.getMetrics")).metrics.find(({ name }) => name === "TaskDuration").value;
await page.click("#drive");
await page.keyboard.down("ArrowUp");
await page.keyboard.down("ArrowRight");
await frames(page, 40, 50);
const before = await busy();
await frames(page, FRAMES, 50);
const cost = (await busy() - before) / FRAMES;
console.log(`${(1000 * cost).toFixed(1)} ms of the page's thread for a picture: ${(1 / cost).toFixed(0)} a second at most`);
await browser.close();
