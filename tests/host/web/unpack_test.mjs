// usage: node unpack_test.mjs SOURCES: what gzip packed comes out whole, or the page says why it does not.
import assert from "node:assert/strict";
import { resolve } from "node:path";
import { gzipSync } from "node:zlib";

const { entriesOf, unpacked } = await import(resolve(process.argv[2], "data.js"));
const text = new TextEncoder().encode("$FPODO,0.0000,0.0000,0.0000,0.0000\n".repeat(10_000));
const packed = new Uint8Array(gzipSync(text));

assert.deepEqual(await unpacked(text), text);
assert.deepEqual(await unpacked(packed), text);
assert.deepEqual(await unpacked(packed, text.length), text);
await assert.rejects(unpacked(packed, text.length - 1), /more than .* MB when it is unpacked/);

const damaged = packed.slice();
damaged[packed.length >> 1] ^= 0xff;
for (const bytes of [packed.slice(0, packed.length >> 1), packed.slice(0, packed.length - 1), packed.slice(0, 2), damaged]) {
  const { logs, complaints } = await entriesOf([{ name: "a.log.gz", arrayBuffer: async () => bytes }]);
  assert.equal(logs.length, 0);
  assert.match(complaints[0], /^a\.log\.gz: what gzip packed is damaged or cut off; /);
}
console.log("unpacked");
