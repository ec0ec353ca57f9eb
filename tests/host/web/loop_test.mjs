// usage: node loop_test.mjs PAGE CLI NPM SHARE SOURCE. Compares the loop in the page with the command line, byte by
// byte, for each bundled recording and profile. Its copies of memory serve to go to a time, which is compared as well.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { readFileSync, readdirSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { Tools, run } from "./harness.mjs";

const tools = new Tools(process.argv.slice(2));
const { Engine, PROFILES } = await import(pathToFileURL(join(process.argv[6], "engine.js")));
const { Player } = await import(pathToFileURL(join(process.argv[6], "player.js")));

const bundle = JSON.parse(/id="bundle">([^<]*)/.exec(readFileSync(tools.page, "utf8"))[1]);
const engine = await Engine.create(execFileSync("gzip", ["-dc"], { input: Buffer.from(bundle.wasm, "base64"), maxBuffer: 1 << 28 }));
const logs = readdirSync(join(tools.shared, "recordings")).filter((name) => name.endsWith(".log")).map((name) => join(tools.shared, "recordings", name));

function replayed(bytes, profile, portion = Infinity) {
  engine.open(profile);
  for (let at = 0; at < bytes.length && !engine.ended;) at += engine.feed(bytes.subarray(0, at + portion), at);
  engine.finish();
  return engine.resultText();
}

await run({
  async "gives the command line's result, byte by byte"() {
    assert.ok(logs.length > 5);
    for (const log of logs) {
      for (const profile of [1, 2, 3]) assert.equal(replayed(readFileSync(log), profile), tools.result(log, "--profile", PROFILES[profile]), `${log} ${PROFILES[profile]}`);
    }
  },
  async "gives the same in portions of a few bytes"() {
    const bytes = readFileSync(tools.log("noisy_arc"));
    assert.equal(replayed(bytes, 0, 7), replayed(bytes, 0));
  },
  async "a changed digit gives another digest"() {
    const text = readFileSync(tools.log("noisy_arc"), "latin1");
    const line = /\$FPFRM,[^\r]*/g.exec(text.slice(5000))[0];
    assert.notEqual(JSON.parse(replayed(Buffer.from(text.replace(line, "x"), "latin1"), 0)).digest, JSON.parse(replayed(Buffer.from(text, "latin1"), 0)).digest);
  },
  async "goes to a time as the command line does with --to, from either side"() {
    const log = tools.log("wro_lap");
    const player = new Player(engine);
    await player.load(readFileSync(log), 0);
    for (const t of [12.34, 3.21, 18.7, 3.21, 0.5, 20.1]) {
      const look = await player.seek(t);
      assert.ok(look.time >= t && look.time < t + 0.1);
      assert.equal(look.result.digest, tools.digest(log, "--to", String(look.time + 1e-4)), `at ${t}`);
    }
    assert.equal((await player.seek(1e9)).result.digest, tools.digest(log));
  },
}, process.argv[7]);
