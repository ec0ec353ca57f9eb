// usage: node open_bench.mjs PAGE CLI NPM SHARE: the size of the page, and its times: first picture, whole run, a jump.
// They are real time: measure on a machine that does nothing else.
import { statSync } from "node:fs";
import { Browser, Tools, goTo } from "./harness.mjs";

const OPENED = 7;
const JUMPS = 40;
const tools = new Tools(process.argv.slice(2));
const browser = await Browser.start(tools);
const median = (all) => [...all].sort((a, b) => a - b)[Math.floor(all.length / 2)];
const said = (all) => `median ${median(all).toFixed(0)} ms, ${Math.min(...all).toFixed(0)} to ${Math.max(...all).toFixed(0)}`;

const pictured = [];
const opened = [];
let page;
for (let i = 0; i < OPENED; ++i) {
  await page?.context().close();
  page = await browser.open();
  const at = (name) => page.locator("html").getAttribute(name).then(Number);
  opened.push(await at("data-ready"));
  pictured.push(await at("data-pictured"));
}
const end = Number(await page.locator("#slider").getAttribute("max"));
const jumps = [];
for (let i = 0; i < JUMPS; ++i) {
  const from = performance.now();
  await goTo(page, Math.round(100 * end * ((i * 0.618) % 1)) / 100);
  jumps.push(performance.now() - from);
}
console.log(`size: ${Math.round(statSync(tools.page).size / 1000)} KB\nfirst picture: ${said(pictured)}\npicture of the whole run: ${said(opened)}\na jump: ${said(jumps)}`);
await browser.close();
