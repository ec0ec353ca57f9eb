// Dragging, pinching and the wheel on the map.

/** `moved(du, dv)`, `zoomed(factor, at)`, `pointed(at | null)`, `clicked(at)`; places in pixels of the element. `grabbed(at)`: null, or who
 * has the drag from there: { moved(at), dropped() }. */
export function listen(element, { moved, zoomed, pointed, clicked, grabbed = () => null }) {
  const down = new Map();
  let travelled = 0;
  let holder = null;
  const place = (event) => {
    const box = element.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    down.set(event.pointerId, place(event));
    travelled = 0;
    if (down.size === 1) holder = grabbed(place(event));
  });
  element.addEventListener("pointermove", (event) => {
    const at = place(event);
    const last = down.get(event.pointerId);
    if (!last) return pointed(at);
    const other = [...down].find(([id]) => id !== event.pointerId)?.[1];
    const span = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]);
    if (holder) holder.moved(at);
    else if (other) zoomed(span(at) / Math.max(1, span(last)), other);
    else moved(at[0] - last[0], at[1] - last[1]);
    travelled += Math.hypot(at[0] - last[0], at[1] - last[1]);
    down.set(event.pointerId, at);
    return pointed(null);
  });
  const up = (event) => {
    const had = down.delete(event.pointerId);
    if (had) holder?.dropped();
    holder = null;
    if (had && event.type === "pointerup" && travelled < 5) clicked(place(event));
  };
  element.addEventListener("pointerup", up);
  element.addEventListener("pointercancel", up);
  element.addEventListener("pointerleave", () => pointed(null));
  element.addEventListener("wheel", (event) => {
    event.preventDefault();
    zoomed(Math.exp(-event.deltaY * (event.deltaMode ? 0.04 : 0.0015)), place(event));
  }, { passive: false });
}
