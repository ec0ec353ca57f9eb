// The log of a run on this machine, as `fencepost run --view` sends it while it grows.
import { make, byId, plain } from "./dom.js";
import { Live } from "./player.js";
import { t } from "./words.js";

const AGAIN = 2000;  // ms
const pause = (ms) => new Promise((resolve) => setTimeout(resolve, ms));

function say(text, bad = false) {
  byId("port").hidden = !text;
  byId("port-row").hidden = true;
  byId("port-state").textContent = bad ? "" : text;
  byId("port-error").replaceChildren(...(bad ? [make("p", {}, plain(text))] : []));
}

/** All that came, to its end; `whole`: the sender said that it was the end. Null: there is nobody. */
async function receive(path, heard) {
  const parts = [];
  let answer;
  try {
    answer = await fetch(path, { cache: "no-store" });
  } catch {
    return null;
  }
  if (!answer.ok) throw new Error(await answer.text());
  const reader = answer.body.getReader();
  try {
    for (;;) {
      const { value, done } = await reader.read();
      if (done) return { parts, whole: true };
      parts.push(value);
      heard(value);
    }
  } catch {
    return { parts, whole: false };
  }
}

async function feed(live, page, more) {
  while (more()) {
    const started = performance.now();
    if (await live.work()) page.show(live.look());
    await pause(Math.max(150, 2 * (performance.now() - started)));
  }
}

/** Shows the run until it ends, then all of it as a log. `page`: engine(), open(entry), begin(name), show(look). */
export async function follow({ name, path }, page) {
  let parts = [];
  for (;;) {
    const live = new Live(page.engine());
    let going = true;
    page.begin(name);
    say("");
    const shown = feed(live, page, () => going);
    const came = await receive(path, (bytes) => live.push(bytes));
    going = false;
    live.stop();
    await shown;
    if (came) parts = came.parts;
    if (came?.whole) say(t("runEnded"));
    else if (came) say(t("runCut"), true);
    else say(parts.length ? t("runGoneSent") : t("runGone"), true);
    if (came && !came.whole) {
      await pause(AGAIN);
      continue;
    }
    if (parts.length) await page.open({ name: name.replace(/, live$/, ""), bytes: new Uint8Array(await new Blob(parts).arrayBuffer()), truth: [] });
    return;
  }
}
