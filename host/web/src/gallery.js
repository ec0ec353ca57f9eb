// Many logs side by side: a small map and the numbers of each.
import { drawMap } from "./map2d.js";
import { Window, extentOf } from "./window.js";
import { inks, theme } from "./colours.js";
import { byId, make, plain } from "./dom.js";
import { countsOf } from "./tables.js";
import { t } from "./words.js";

/** One card; `open` shows the log in full. */
export function addCard(entry, look, open) {
  const canvas = make("canvas", { role: "img", "aria-label": t("mapAtEnd") });
  const { result, page } = look;
  const { alerts, stops } = countsOf(look);
  const rejected = Object.values(result.log.rejected).reduce((a, b) => a + b, 0);
  const words = page.unreadable ? plain(page.unreadable)
    : t("cardSays", { objects: result.objects.length, alerts, stops, frames: result.log.frames, time: look.time.toFixed(1) }) +
      (rejected ? t("cardBad", { count: rejected }) : "");
  byId("cards").append(make("div", { className: "card" }, canvas, make("b", {}, plain(entry.name)), make("p", {}, words),
    make("p", {}, make("code", {}, result.digest)), make("button", { type: "button", onclick: open, "aria-label": t("openLog", { name: plain(entry.name) }) }, t("open"))));
  byId("gallery").hidden = false;
  const draw = () => {
    const window = new Window();
    window.size(canvas.clientWidth, canvas.clientHeight);
    const view = { ...look, t: look.time, pose: look.result.pose, truth: entry.truth, models: ["hybrid"], layers: new Set(["truth", "path"]) };
    window.fit(extentOf(view), 14);
    drawMap(canvas, window, { view, whole: [], ink: inks(), theme: theme(), selected: null, bare: true });
  };
  draw();
  return draw;
}
