// Data in the page (the loop, recordings, and the logs that `fencepost report` puts there) and files.
import { byId } from "./dom.js";
import { truthOf } from "./scene.js";
import { t } from "./words.js";

export function fromBase64(text) {
  const characters = atob(text);
  const bytes = new Uint8Array(characters.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = characters.charCodeAt(i);  // Uint8Array.from takes 0.1 s for the loop
  return bytes;
}

const MAX_UNPACKED = 512e6; // bytes; a log of fifty hours, and what a browser holds beside its copies

/** Unpacks gzip, and leaves other bytes as they are. Throws a sentence where it is damaged, cut off or too long. */
export async function unpacked(bytes, most = MAX_UNPACKED) {
  if (bytes[0] !== 0x1f || bytes[1] !== 0x8b) return bytes;
  const { readable, writable } = new DecompressionStream("gzip");
  const writer = writable.getWriter();
  for (const end of [writer.write(bytes), writer.close()]) end.catch(() => {});  // the reader has the same fault
  const reader = readable.getReader();
  const parts = [];
  let size = 0;
  try {
    for (let part = await reader.read(); !part.done && size <= most; part = await reader.read()) {
      parts.push(part.value);
      size += part.value.length;
    }
  } catch {
    throw new Error(t("badGzip"));
  }
  if (size > most) {
    await reader.cancel();
    throw new Error(t("tooLong", { megabytes: most / 1e6 }));
  }
  const whole = new Uint8Array(size);
  let at = 0;
  for (const part of parts) {
    whole.set(part, at);
    at += part.length;
  }
  return whole;
}

const read = (id) => JSON.parse(byId(id)?.textContent || "null");

export async function bundled() {
  const { wasm, recordings } = read("bundle");
  return { wasm: await unpacked(fromBase64(wasm)), recordings };
}

/** { name, bytes, truth, scene: its text or null } of a recording as it is in the page. Of one that was too long for it { kept } instead of bytes. */
export async function entryOf({ name, log, thinned, scene }) {
  const bytes = await unpacked(fromBase64(log ?? thinned));
  if (log !== undefined) return { name, bytes, truth: truthOf(scene), scene: scene ? JSON.stringify(scene) : null };
  return { name, bytes: new Uint8Array(), kept: JSON.parse(new TextDecoder().decode(bytes)), truth: truthOf(scene) };
}

/** The boards' programs in this copy of the page: [{ board, image }], packed. */
export const boardImages = () => read("images") ?? [];

/** The logs that this copy of the page was written for: { logs, profile }. Of a run that goes on: { stream: { name, path } }.
 * Else null. */
export const given = () => read("given");

const stem = (name) => name.replace(/(\.(log|txt|json|gz))+$/i, "");

/** Logs with the scenes among `files` that belong to them: by name, or one of all. `scenes` left over come back. */
export async function entriesOf(files) {
  const scenes = [];
  const logs = [];
  const complaints = [];
  for (const file of files) {
    try {
      if (!/\.json$/i.test(file.name)) {
        logs.push({ name: file.name, bytes: await unpacked(new Uint8Array(await file.arrayBuffer())), truth: [], scene: null });
        continue;
      }
      const text = await file.text();
      const scene = JSON.parse(text);
      if (!Array.isArray(scene?.objects)) throw new Error(t("noScene"));
      scenes.push({ name: file.name, text, truth: truthOf(scene) });
    } catch (error) {
      complaints.push(`${file.name}: ${error.message}`);
    }
  }
  // One that is of none by its name is the room of all: a class has one.
  const ofAll = scenes.length === 1 && !logs.some(({ name }) => stem(name) === stem(scenes[0].name)) ? scenes[0] : null;
  for (const log of logs) {
    const scene = scenes.find((s) => stem(s.name) === stem(log.name)) ?? ofAll;
    if (scene) Object.assign(log, { truth: scene.truth, scene: scene.text });
  }
  return { logs, scenes, complaints };
}
