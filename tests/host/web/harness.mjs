// Shared by the tests of the page: the page in a browser, records with their check sums, the command line.
import { execFileSync } from "node:child_process";
import { readFileSync } from "node:fs";
import { createRequire } from "node:module";
import { basename, join, resolve } from "node:path";

export function crc16(text) {
  let crc = 0xffff;
  for (const c of text) {
    crc ^= c.charCodeAt(0) << 8;
    for (let i = 0; i < 8; ++i) crc = (crc & 0x8000 ? (crc << 1) ^ 0x1021 : crc << 1) & 0xffff;
  }
  return crc.toString(16).toUpperCase().padStart(4, "0");
}

/** A record as a line: "FPSIG,1,d02020,red". */
export const record = (body) => `$${body}*${crc16(body)}\r\n`;

/** Only a failing test waits so long, ms. */
const PATIENCE = 180_000;

/** How conditions are awaited: not by frames, whose clock may be the test's. */
export const POLLED = { polling: 20 };

export class Tools {
  constructor(args) { [this.page, this.cli, this.npm, this.shared] = args.map((path) => resolve(path)); }
  require(name) { return createRequire(join(this.npm, "package.json"))(name); }
  log(name) { return join(this.shared, "recordings", `${name}.log`); }
  scene(name) { return join(this.shared, "recordings", `${name}.json`); }
  result(log, ...options) { return execFileSync(this.cli, ["replay", "--json", ...options, log], { maxBuffer: 1 << 28, stdio: ["ignore", "pipe", "ignore"] }).toString(); }
  /** The output of a command. */
  says(...words) { return execFileSync(this.cli, words, { stdio: ["ignore", "pipe", "ignore"] }).toString(); }
  digest(log, ...options) { return JSON.parse(this.result(log, ...options)).digest; }
}

export class Browser {
  static async start(tools, more = []) {
    const { chromium, firefox } = tools.require("playwright-core");
    // Tests may run as root in a container, where the browser's own sandbox cannot be.
    const browser = process.env.FIREFOX ? await firefox.launch({ executablePath: process.env.FIREFOX, channel: "moz-firefox", firefoxUserPrefs: { "ui.prefersReducedMotion": 1 } })
      : await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: ["--no-sandbox", ...more] });
    return Object.assign(new Browser(), { browser, tools, requests: [], errors: [] });
  }

  async context(options) {
    const context = await this.browser.newContext({ viewport: { width: 1280, height: 900 }, ...options });
    context.setDefaultTimeout(PATIENCE);
    return context;
  }

  /** The page as it opens from disk, when it has shown its first log. Notes requests to anything else, and errors. It does
   * not play by itself without reducedMotion: "no-preference". */
  async open({ file = this.tools.page, before, ...options } = {}) {
    const context = await this.context({ reducedMotion: "reduce", ...options });
    const page = await context.newPage();
    page.setDefaultTimeout(0); // CTest ends what hangs; a busy machine only takes longer
    page.on("request", (request) => {
      const url = request.url();
      if (!url.startsWith(`file://${file}`) && !/^(data|blob):/.test(url)) this.requests.push(url);
    });
    page.on("pageerror", (error) => this.errors.push(String(error)));
    page.on("console", (message) => { if (message.type() === "error") this.errors.push(message.text()); });
    for (const one of [before ?? []].flat()) await page.addInitScript(one.run, one.with);
    await page.goto(`file://${file}`);
    await page.waitForFunction(() => document.documentElement.dataset.ready, null, POLLED);
    return page;
  }
  /** The faults of the page that axe finds. */
  async complaints(page) {
    await page.evaluate(this.tools.require("axe-core").source);
    const { violations } = await page.evaluate(() => axe.run(document, { resultTypes: ["violations"] }));
    return violations.map((v) => `${v.id}: ${v.nodes.map((n) => n.html).join(" | ")}`);
  }
  close() { return this.browser.close(); }
}

/** Files dropped on the page as a user does; waits until the digest of the last one is shown. */
export async function drop(page, ...files) {
  const given = files.map((file) => typeof file === "string" ? { name: basename(file), bytes: readFileSync(file) } : file)
    .map(({ name, bytes }) => ({ name, base64: Buffer.from(bytes).toString("base64") }));
  const data = await page.evaluateHandle((list) => {
    const transfer = new DataTransfer();
    for (const { name, base64 } of list) transfer.items.add(new File([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], name));
    return transfer;
  }, given);
  const log = given.find(({ name }) => !name.endsWith(".json"))?.name;
  // The log that is there may have the same name.
  if (log) await page.evaluate(() => { document.title = ""; });
  await page.dispatchEvent("body", "drop", { dataTransfer: data });
  if (log) await page.waitForFunction((name) => document.title.startsWith(name) && document.getElementById("progress").hidden, log, POLLED);
}

export const text = (page, selector) => page.locator(selector).textContent();

/** When what was asked for before has been drawn. */
export const settled = (page) => page.evaluate(() => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); }));

/** Runs in the page, before it: its animation has the test's clock. `slow` ms pass at each look at that clock. */
export function frameClock() {
  let now = 0;
  let waiting = [];
  window.slow = 0;
  performance.now = () => now += window.slow;
  window.requestAnimationFrame = (frame) => waiting.push(frame);
  window.nextFrame = (ms) => {
    now += ms;
    const due = waiting;
    waiting = [];
    for (const frame of due) frame(now);
  };
}

/** Runs in the page, before it: while window.hurried, waits of a second and more are over fifty times sooner. */
export function hurry() {
  window.hurried = false;
  for (const name of ["setTimeout", "setInterval"]) {
    const wait = window[name].bind(window);
    window[name] = (what, ms, ...more) => wait(what, window.hurried && ms >= 1000 ? ms / 50 : ms, ...more);
  }
}

/** So many frames of a page with that clock, `ms` apart. */
export const frames = (page, count, ms) => page.evaluate(([n, step]) => { for (let i = 0; i < n; ++i) window.nextFrame(step); }, [count, ms]);

export async function goTo(page, t) {
  await page.evaluate((time) => {
    const slider = document.getElementById("slider");
    slider.value = time;
    slider.dispatchEvent(new Event("input", { bubbles: true }));
  }, t);
  await page.waitForFunction((time) => document.documentElement.dataset.shown === time.toFixed(2), t, POLLED);
}

/** Runs `cases` one after the other, { name: async () => {} }; the process fails if one does. */
export async function run(cases, only) {
  let failed = 0;
  for (const [name, test] of Object.entries(cases)) {
    if (only && !name.includes(only)) continue;
    const started = Date.now();
    try {
      await test();
      console.log(`ok   ${name} (${Date.now() - started} ms)`);
    } catch (error) {
      ++failed;
      console.log(`FAIL ${name}: ${error.stack}`);
    }
  }
  process.exitCode = failed ? 1 : 0;
}
