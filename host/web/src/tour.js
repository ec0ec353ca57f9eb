// Five steps through the page, by the recording that it opens with.
import { byId } from "./dom.js";
import { onLanguage, t } from "./words.js";

const STEPS = [
  { at: "camera", t: 1.5, words: "tourCamera" },
  { at: "map", t: 3, words: "tourMap" },
  { at: "map", t: 4.2, words: "tourZones" },
  { at: "banner", t: 6, words: "tourBanner" },
  { at: "drive", t: 6, words: "tourDrive" },
];

/** `page`: begin() opens the recording; goTo(t). */
export function bindTour(page) {
  const card = byId("tour-card");
  let step = -1;
  const mark = (on) => { if (step >= 0) byId(STEPS[step].at).classList.toggle("toured", on); };
  const say = () => {
    if (step < 0) return;
    byId("tour-text").textContent = t(STEPS[step].words);
    byId("tour-step").textContent = t("tourStep", { step: step + 1, steps: STEPS.length });
    byId("tour-next").textContent = t(step + 1 === STEPS.length ? "drive" : "next");
  };
  onLanguage(say);
  const close = () => {
    mark(false);
    step = -1;
    card.hidden = true;
    byId("tour").focus();
  };
  const show = (next) => {
    mark(false);
    step = next;
    const { at, t: time } = STEPS[step];
    mark(true);
    page.goTo(time);
    say();
    byId("tour-back").disabled = step === 0;
    byId(at).scrollIntoView({ block: "nearest" });
  };
  byId("tour").onclick = async () => {
    await page.begin();
    card.hidden = false;
    show(0);
    byId("tour-next").focus();
  };
  byId("tour-back").onclick = () => show(step - 1);
  byId("tour-next").onclick = () => {
    if (step + 1 < STEPS.length) return show(step + 1);
    close();
    return byId("drive").click();
  };
  byId("tour-close").onclick = close;
  card.addEventListener("keydown", (event) => { if (event.key === "Escape") close(); });
}
