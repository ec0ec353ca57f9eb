// Runs in the page: a navigator.serial with one port that plays a recorded robot, or has the fault in window.fault.
export function standIn({ base64 = "", portion = 512, every = 10 }) {
  const log = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  window.written = "";
  window.fault = null;
  const fail = (name) => { throw new DOMException("stand-in", name); };
  const spoken = () => {
    if (window.fault === "noise") return new Uint8Array(512).map((_, i) => (i * 89) & 255);
    return new TextEncoder().encode("a robot that only chats\r\n".repeat(40));
  };
  const port = {
    async open({ baudRate }) {
      if (window.fault === "NetworkError" || window.fault === "InvalidStateError") fail(window.fault);
      if (window.fault === "never") return new Promise(() => {});
      if (port.readable) fail("InvalidStateError");
      window.baudRate = baudRate;
      let at = 0;
      const { fault } = window;
      port.readable = new ReadableStream({
        async pull(controller) {
          await new Promise((resolve) => setTimeout(resolve, every));
          if (fault === "unplug" && ++at > 5) {
            port.readable = null;
            controller.error(new DOMException("The device has been lost.", "NetworkError"));
            return;
          }
          if (fault) return controller.enqueue(spoken());
          if (at < log.length) controller.enqueue(log.slice(at, at += portion));
          else await new Promise(() => {});
        },
      }, { highWaterMark: 0 });
      port.writable = new WritableStream({ write(bytes) {
        if (fault === "deaf") return new Promise(() => {});
        window.written += new TextDecoder().decode(bytes);
      } });
    },
    async close() {
      if (port.readable?.locked || port.writable?.locked) throw new TypeError("locked");
      port.readable = port.writable = null;
    },
  };
  const serial = { requestPort: async () => window.fault === "NotFoundError" ? fail(window.fault) : port };
  Object.defineProperty(navigator, "serial", { value: serial, configurable: true });
}
