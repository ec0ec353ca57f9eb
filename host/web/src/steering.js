// Keys, a pad to drag on and a gamepad steer the robot. Shares of full speed: forwards, to the left.
const KEYS = { ArrowUp: [1, 0], ArrowDown: [-1, 0], ArrowLeft: [0, 1], ArrowRight: [0, -1], w: [1, 0], s: [-1, 0], a: [0, 1], d: [0, -1] };
const DEAD = 0.15;  // of a stick's way: worn ones do not come back to their middle

const live = (value) => Math.abs(value) < DEAD ? 0 : value;

export class Steering {
  #pressed = new Set();
  #pad = [0, 0];
  #knob;

  /** `active()`: keys are for the robot now. */
  constructor(pad, active) {
    this.#knob = pad.firstElementChild;
    const named = (event) => event.key.length === 1 ? event.key.toLowerCase() : event.key;
    document.addEventListener("keydown", (event) => {
      if (!active() || !KEYS[named(event)] || event.ctrlKey || event.altKey || event.metaKey || event.target.closest("select, input:not([type=checkbox])")) return;
      event.preventDefault();
      this.#pressed.add(named(event));
    });
    document.addEventListener("keyup", (event) => this.#pressed.delete(named(event)));
    window.addEventListener("blur", () => this.release());
    const follow = (event) => {
      const { left, top, width, height } = pad.getBoundingClientRect();
      const [u, v] = [(event.clientX - left - width / 2) / (width / 2), (event.clientY - top - height / 2) / (height / 2)];
      const long = Math.max(1, Math.hypot(u, v));
      this.#set(-v / long, -u / long);
    };
    pad.addEventListener("pointerdown", (event) => { pad.setPointerCapture(event.pointerId); follow(event); });
    pad.addEventListener("pointermove", (event) => { if (pad.hasPointerCapture(event.pointerId)) follow(event); });
    for (const end of ["pointerup", "pointercancel"]) pad.addEventListener(end, () => this.#set(0, 0));
  }

  #set(forward, turn) {
    this.#pad = [forward, turn];
    this.#knob.setAttribute("transform", `translate(${-turn * 30} ${-forward * 30})`);
  }

  release() {
    this.#pressed.clear();
    this.#set(0, 0);
  }

  #gamepad() {
    const pad = [...navigator.getGamepads?.() ?? []].find((one) => one?.connected);
    if (!pad) return [0, 0];
    const held = (button) => pad.buttons[button]?.pressed ? 1 : 0;
    return [-live(pad.axes[1] ?? 0) + held(12) - held(13), -live(pad.axes[0] ?? 0) + held(14) - held(15)];
  }

  /** The sum of all inputs, each axis from -1 to 1. */
  now() {
    const all = [...[...this.#pressed].map((name) => KEYS[name]), this.#pad.map(live), this.#gamepad()];
    const sum = (axis) => Math.max(-1, Math.min(1, all.reduce((total, one) => total + one[axis], 0)));
    return { forward: sum(0), turn: sum(1) };
  }
}
