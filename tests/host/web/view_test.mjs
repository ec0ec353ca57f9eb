// usage: node view_test.mjs PAGE CLI NPM SHARE [PART]: `fencepost run --view` of an emulated robot, in headless Chromium.
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Browser, Tools, run, text } from "./harness.mjs";

const tools = new Tools(process.argv.slice(2));
const browser = await Browser.start(tools, ["--host-resolver-rules=MAP rebound.example 127.0.0.1"]);
const folder = mkdtempSync(join(tmpdir(), "fencepost-view-"));
const scene = tools.scene("stop_pixy2");
const started = [];

/** The program in the folder; what it says is awaited by `says`. */
function start(...words) {
  const child = spawn(tools.cli, words, { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  const program = { child, said: "", ended: new Promise((resolve) => child.on("exit", (code, signal) => resolve(code ?? signal))) };
  for (const stream of [child.stdout, child.stderr]) stream.on("data", (bytes) => { program.said += bytes; });
  program.says = async (pattern) => {
    for (let i = 0; i < 1800; ++i) {
      const match = pattern.exec(program.said);
      if (match) return match;
      await new Promise((resolve) => setTimeout(resolve, 100));
    }
    throw new Error(`${pattern} was not said:\n${program.said}`);
  };
  started.push(child);
  return program;
}

async function robot(name) {
  const devices = start("emulate", "pixy2", "create2", scene, "--link", `./camera-${name}`, "--link", `./wheels-${name}`);
  await devices.says(/create2 on /);
  const brain = start("run", "--camera", `pixy2:./camera-${name}`, "--odometry", `create2:./wheels-${name}`, "--robot", scene, "--log", `${name}.log`, "--view");
  const [, address] = await brain.says(/the run is shown at (http:\/\/127\.0\.0\.1:\d+\/):/);
  return { devices, brain, address };
}

async function visit(address) {
  const context = await browser.context();
  const page = await context.newPage();
  page.on("request", (request) => browser.requests.push(request.url()));
  page.on("pageerror", (error) => browser.errors.push(String(error)));
  await page.goto(address);
  await page.waitForSelector("html[data-ready]");
  return page;
}

const isLive = () => document.getElementById("title").textContent === "Run, live";
const hasStop = () => /stop/.test(document.getElementById("alerts").textContent);

await run({
  async "a run is shown while it goes on, to several, and then as its log"() {
    const { devices, brain, address } = await robot("whole");
    const first = await visit(address);
    await first.waitForFunction(() => document.querySelectorAll("#objects tbody button").length > 0 && /red/.test(document.getElementById("objects").textContent));
    assert.ok(await first.evaluate(isLive));
    const second = await visit(address);
    for (const page of [first, second]) await page.waitForFunction(hasStop);
    assert.ok(await second.evaluate(isLive), "the run still goes on");
    await first.screenshot({ path: join(tools.npm, "view.png") });
    assert.match(await text(first, "#reach"), /Nothing leaves this machine/);
    assert.equal(await devices.ended, 0);
    brain.child.kill("SIGINT");
    assert.equal(await brain.ended, 130);
    const [, digest] = await brain.says(/digest ([0-9a-f]{16})/);
    for (const page of [first, second]) {
      await page.waitForSelector("#digest");
      assert.equal(await text(page, "#digest"), digest);
      assert.match(await text(page, "#port-state"), /The run has ended/);
      assert.match(await text(page, "#facts"), /agrees in all \d+ records/);
    }
    execFileSync(tools.cli, ["replay", "--check", join(folder, "whole.log")], { stdio: "ignore" });
    assert.equal(tools.digest(join(folder, "whole.log")), digest);
    assert.deepEqual([...new Set(browser.requests)].sort(), [address, `${address}log`]);
    assert.deepEqual(browser.errors, []);
    await first.context().close();
    await second.context().close();
  },

  async "nobody else's page gets at it; one that is killed is said"() {
    const { brain, address } = await robot("killed");
    const page = await visit(address);
    await page.waitForFunction(() => /red/.test(document.getElementById("objects").textContent));
    const foreign = await (await browser.context()).newPage();
    const rebound = await foreign.goto(address.replace("127.0.0.1", "rebound.example"));
    assert.equal(rebound.status(), 403);
    assert.match(await foreign.content(), /on this machine alone/);
    await foreign.goto(`file://${tools.page}`);
    const framed = await foreign.evaluate(async (url) => {
      const seen = [];
      for (const mode of ["cors", "no-cors"]) await fetch(url, { mode }).then((answer) => answer.text(), () => "refused").then((got) => seen.push(got));
      return seen;
    }, `${address}log`);
    assert.deepEqual(framed, ["refused", "refused"]);
    const refused = await page.evaluate(() => new Promise((resolve) => {
      document.addEventListener("securitypolicyviolation", (event) => resolve(event.effectiveDirective));
      fetch("https://example.org/").catch(() => {});
    }));
    assert.equal(refused, "connect-src");
    brain.child.kill("SIGKILL");
    await page.waitForFunction(() => /The run is gone. This is what it sent/.test(document.getElementById("port-error").textContent));
    await page.waitForSelector("#digest");
    assert.match(await text(page, "#objects"), /red/);
  },
}, process.argv[6]);
for (const child of started) child.kill("SIGKILL");
await browser.close();
rmSync(folder, { recursive: true });
