// usage: node build.mjs WASM NPM OUTPUT: the page, from the compiled loop and the packages installed in NPM. The same inputs
// give the same bytes; packed by gzip, which packs alike on every machine (zlib's versions do not).
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";

const [wasm, npm, output] = process.argv.slice(2).map((path) => resolve(path));
const here = import.meta.dirname ?? new URL(".", import.meta.url).pathname;
const source = (name) => readFileSync(join(here, "src", name), "utf8");
const { buildSync, transformSync } = createRequire(join(npm, "package.json"))("esbuild");

const packed = (bytes) => execFileSync("gzip", ["-9nc"], { input: bytes, maxBuffer: 1 << 28 }).toString("base64");
const hash = (text) => `sha256-${createHash("sha256").update(text).digest("base64")}`;

const RECORDINGS = ["go_around", "wro_lap", "approach_stop", "corridor"];  // wheels can drive all of them
const recordings = RECORDINGS.map((name) => {
  const file = (suffix) => readFileSync(join(here, "../share/recordings", name + suffix));
  return { name: `${name}.log`, log: packed(file(".log")), scene: JSON.parse(file(".json").toString()) };
});

const script = buildSync({ entryPoints: [join(here, "src/main.js")], bundle: true, minify: true, format: "iife", target: "es2022",
  charset: "utf8", write: false, legalComments: "none" }).outputFiles[0].text.trim();
const style = transformSync(source("style.css"), { loader: "css", minify: true, charset: "utf8" }).code.trim();
if (/<\/script|<!--/i.test(script)) throw new Error("the script would end its own element");
const version = /project\(fencepost VERSION (\S+)/.exec(readFileSync(join(here, "../../CMakeLists.txt"), "utf8"))[1];

const parts = {
  script, style, version, "script-hash": hash(script), "style-hash": hash(style),
  bundle: JSON.stringify({ wasm: packed(readFileSync(wasm)), recordings }).replaceAll("<", "\\u003c"),
};
writeFileSync(output, source("index.html").replace(/\{\{([a-z-]+)\}\}/g, (_, name) => parts[name]));
