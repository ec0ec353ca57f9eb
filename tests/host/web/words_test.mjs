// usage: node words_test.mjs SRC: the page's words are whole. Each key has each language, is used, and fills in the same values; the page's
// HTML and script have no words of their own.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { run } from "./harness.mjs";

const folder = resolve(process.argv[2]);
const load = (name) => import(pathToFileURL(join(folder, name)));
const { WORDS } = await load("wordlist.js");
const { LANGUAGES, preferred } = await load("words.js");
const html = readFileSync(join(folder, "index.html"), "utf8");
const scripts = new Map(readdirSync(folder).filter((name) => name.endsWith(".js") && name !== "wordlist.js").map((name) => [name, readFileSync(join(folder, name), "utf8")]));
const valuesOf = (text) => [...text.matchAll(/\{(\w+)\}/g)].map(([, name]) => name).sort();
const PROGRAMS = new Set(["Fencepost", "fencepost", "mode", "log", "reset", "full", "small", "micro"]);  // words that are typed or named so anywhere
const COMMANDS = /fencepost record PORT[^，]*|sudo usermod -aG dialout \$USER|fencepost[ -]\S+( --\w+)?|[\w./-]+\.(html|hex|gba|log)|gzip -t|mode log|status|"objects"|STM32CubeProgrammer|Download/g;

await run({
  "each text is there in each language, with the same values filled in"() {
    for (const [key, texts] of Object.entries(WORDS)) {
      assert.deepEqual(Object.keys(texts), Object.keys(LANGUAGES), key);
      for (const [language, text] of Object.entries(texts)) {
        assert.ok(text.trim(), `${key} in ${language}`);
        assert.deepEqual(valuesOf(text), valuesOf(texts.en), `${key} in ${language}`);
        const words = text.match(/[a-z]{2,}/gi) ?? [];
        if (language !== "en" && words.length > 3) assert.notEqual(text, texts.en, `${key} in ${language} is the English one`);
      }
      if (/[a-z]{3,} [a-z]{2,}/.test(texts.en.replace(COMMANDS, "")) && !/iRobot/.test(texts.en)) assert.match(texts.zh, /\p{Script=Han}/u, `${key} in Chinese`);
    }
  },

  "each text is used, and each that is used is there"() {
    const all = [html, ...scripts.values()].join("\n");
    const named = new Set([...all.matchAll(/["'`](\w+)["'`]/g)].map(([, name]) => name));
    for (const key of Object.keys(WORDS)) assert.ok(named.has(key), `${key} is not used`);
    const used = [...all.matchAll(/\bdata-t(?:-label)?="(\w+)"|\b(?:t|words)\("(\w+)"/g)].map(([, a, b]) => a ?? b);
    assert.ok(used.length > 150);
    for (const key of used) assert.ok(key in WORDS, `no words for ${key}`);
  },

  "the page's HTML has no words of its own"() {
    const body = html.slice(html.indexOf("<body")).replace(/<!--.*?-->/gs, "").replace(/\{\{[\w-]+\}\}/g, "");
    const texts = body.replace(/<[^>]*>/g, "\n").match(/\p{L}{2,}/gu).filter((word) => !PROGRAMS.has(word));
    assert.deepEqual(texts, []);
    assert.deepEqual(body.match(/\b(?:aria-label|title|placeholder|alt)="/g), null);
  },

  "the page's script has no sentences of its own"() {
    for (const [name, text] of scripts) {
      const code = text.replace(/\/\*[\s\S]*?\*\/|(^|[^:"'`])\/\/.*$/gm, "$1");
      for (const [, , said] of code.matchAll(/(textContent = |complain\(|tell\(|says: |fix: |"aria-label": |new Error\()(["`][^"`]*[a-z]{3,} [^"`]*["`])/g)) {
        assert.ok(/no words for|it has no PICOBOOT interface|the loop stopped by itself/.test(said), `${name}: ${said}`);
      }
    }
  },

  "the browser's first language that the page has is chosen, else English"() {
    assert.equal(preferred(["de-CH", "en"]), "de");
    assert.equal(preferred(["pt-BR", "fr-CA", "en"]), "fr");
    assert.equal(preferred(["zh-Hant-TW"]), "zh");
    assert.equal(preferred(["ja"]), "en");
    assert.equal(preferred([]), "en");
  },
});
