// The panel of a connected robot.
import { byId, download, make, plain } from "./dom.js";
import { Live } from "./player.js";
import { Robot, absent, diagnose, explain } from "./serial.js";
import { t } from "./words.js";

function complain(problem) {
  byId("port-error").replaceChildren(...(problem ? [make("p", {}, make("b", {}, plain(problem.says)), ` (${plain(problem.detail)})`), make("p", {}, t("portTry", { fix: plain(problem.fix) }))] : []));
}

/** `page`: engine(), open(entry), begin(name), show(look). */
export function bindPort(page) {
  let robot = null;
  let live = null;
  let timer = 0;
  let records = 0;
  const buttons = () => {
    byId("port-open").disabled = Boolean(robot?.open);
    byId("port-close").disabled = !robot?.open;
    byId("port-save").disabled = !robot?.recording.length;
  };
  const tell = (text) => { byId("port-state").textContent = text; };
  const name = () => `robot-${new Date().toISOString().slice(0, 19).replace(/[-:]/g, "").replace("T", "-")}.log`;

  async function tick() {
    if (!robot?.open) return;
    const started = performance.now();
    if (await live.work()) {
      const look = live.look();
      records = look.result.log.records;
      robot.answered = records > 0;
      page.show(look);
    }
    if (!robot?.open) return;
    tell(t("portConnected", { bytes: robot.bytes, records }));
    complain(diagnose({ bytes: robot.bytes, strange: robot.strange, records, quiet: robot.quiet }));
    buttons();
    timer = setTimeout(tick, Math.max(150, 2 * (performance.now() - started)));
  }

  async function whole() { return new Uint8Array(await new Blob(robot.recording).arrayBuffer()); }

  async function connect() {
    if (!navigator.serial) return complain(absent());
    complain(null);
    byId("port-open").disabled = true;
    records = 0;
    robot = new Robot({
      heard: (bytes) => live.push(bytes),
      failed: complain,
      ended: async () => {
        clearTimeout(timer);
        live.stop();
        buttons();
        tell(t("portEnded", { bytes: robot.bytes }));
        if (robot.bytes) page.open({ name: name(), bytes: await whole(), truth: [] });
      },
    });
    live = new Live(page.engine());
    try {
      await robot.connect(navigator.serial, Number(byId("baud").value), byId("ask-log").checked);
    } catch (error) {
      tell(t("portNot"));
      buttons();
      return complain(explain(error));
    }
    page.begin(t("robotLive"));
    buttons();
    return tick();
  }

  byId("connect").onclick = () => {
    const shown = !byId("port").hidden && !byId("port-row").hidden;
    byId("port").hidden = shown;
    byId("port-row").hidden = false;
    if (!byId("port").hidden) complain(navigator.serial ? null : absent());
  };
  byId("port-open").onclick = connect;
  byId("port-close").onclick = () => robot.close();
  byId("port-save").onclick = async () => download(name(), [await whole()], "text/plain");
}
