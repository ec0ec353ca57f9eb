// Whoever never answers ends with an error.

/** Waits for `promise`; fails after `ms`. */
export function within(ms, promise) {
  let timer = 0;
  const late = new Promise((_, fail) => { timer = setTimeout(() => fail(new DOMException(`no answer within ${ms / 1000} s`, "TimeoutError")), ms); });
  return Promise.race([promise, late]).finally(() => clearTimeout(timer));
}

/** `device` with methods that take at most `ms`. */
export const patient = (device, ms) => new Proxy(device, {
  get(target, name) {
    const value = target[name];
    return typeof value === "function" ? (...args) => within(ms, value.apply(target, args)) : value;
  },
});
