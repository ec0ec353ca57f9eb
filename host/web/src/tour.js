// Five steps through the page, by the recording that it opens with.
import { byId } from "./dom.js";

const STEPS = [
  { at: "camera", t: 1.5, text: "The camera reports coloured rectangles, and nothing else. The dashed ones are where the map expects them." },
  { at: "map", t: 3, text: "From rectangles and wheels the robot makes this map. An outline is an obstacle; the fainter it is, the less sure the robot is." },
  { at: "map", t: 4.2, text: "The coloured floor is what the robot is about to drive over. What stands in it raises NOTICE, WARN or STOP." },
  { at: "banner", t: 6, text: "The worst alert stands here in words. This robot obeys: it stops, turns away and goes around. The ♪ above makes alerts heard." },
  { at: "drive", t: 6, text: "Now you: Drive puts you at the wheel, in a room that you arrange. End and replay shows your own run like this one." },
];

/** `page`: begin() opens the recording; goTo(t). */
export function bindTour(page) {
  const card = byId("tour-card");
  let step = -1;
  const mark = (on) => { if (step >= 0) byId(STEPS[step].at).classList.toggle("toured", on); };
  const close = () => {
    mark(false);
    step = -1;
    card.hidden = true;
    byId("tour").focus();
  };
  const show = (next) => {
    mark(false);
    step = next;
    const { at, t, text } = STEPS[step];
    mark(true);
    page.goTo(t);
    byId("tour-text").textContent = text;
    byId("tour-step").textContent = `${step + 1} of ${STEPS.length}`;
    byId("tour-back").disabled = step === 0;
    byId("tour-next").textContent = step + 1 === STEPS.length ? "Drive" : "Next";
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
