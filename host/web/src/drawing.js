// Where a board's file goes: the computer, the cable, and what to press on the board.
import { t } from "./words.js";

const SVG = "http://www.w3.org/2000/svg";

function put(parent, tag, attributes, text) {
  const element = document.createElementNS(SVG, tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  if (text !== undefined) element.textContent = text;
  parent.append(element);
}

/** `board`: { name, drive, button, wire, card }; `file`: the name of its file. */
export function drawBoard(svg, board, file) {
  svg.replaceChildren();
  svg.setAttribute("aria-label", t("drawLabel", { file, board: board.name }));
  const drive = board.drive ?? (board.card ? t("drawCard") : "");
  put(svg, "rect", { x: 10, y: 14, width: 190, height: 112, rx: 8, class: "body" });
  put(svg, "rect", { x: 20, y: 24, width: 170, height: 92, rx: 3, class: "screen" });
  put(svg, "path", { d: "M0 138h210l-12 -12h-186z", class: "body" });
  put(svg, "text", { x: 105, y: 158, class: "under" }, t("drawComputer"));
  put(svg, "rect", { x: 30, y: 36, width: 26, height: 32, rx: 2, class: "paper" });
  put(svg, "text", { x: 62, y: 56, class: "file" }, file);
  if (drive) {
    put(svg, "path", { d: "M43 72v16h22", class: "arrow" });
    put(svg, "path", { d: "M65 83l8 5l-8 5z", class: "tip" });
    put(svg, "rect", { x: 80, y: 78, width: 104, height: 24, rx: 4, class: "drive" });
    put(svg, "text", { x: 132, y: 95, class: "middle" }, drive);
  }
  if (!board.card) {
    put(svg, "path", { d: "M200 92c40 0 30 -18 74 -18", class: "cable" });
    put(svg, "text", { x: 237, y: 112, class: "middle" }, "USB");
  }
  put(svg, "rect", { x: 274, y: 40, width: 170, height: 68, rx: 8, class: "board" });
  put(svg, "rect", { x: 268, y: 64, width: 22, height: 20, rx: 2, class: "plug" });
  put(svg, "rect", { x: 366, y: 58, width: 32, height: 32, rx: 2, class: "chip" });
  put(svg, "text", { x: 359, y: 128, class: "middle" }, board.name);
  if (board.button) {
    put(svg, "circle", { cx: 326, cy: 74, r: 10, class: "press" });
    put(svg, "text", { x: 326, y: 30, class: "middle" }, t("drawHold", { button: board.button === true ? t("drawButton") : board.button }));
    put(svg, "path", { d: "M326 36v24", class: "arrow" });
  }
  if (board.wire) {
    put(svg, "path", { d: "M310 44c0 -34 110 -34 110 0", class: "wire" });
    put(svg, "text", { x: 310, y: 60, class: "middle" }, board.wire[0]);
    put(svg, "text", { x: 420, y: 60, class: "middle" }, board.wire[1]);
  }
}
