// Programs of all boards, as far as the page reads them, and a page that has them inside.
import { readFileSync, writeFileSync } from "node:fs";
import { gzipSync } from "node:zlib";

/** An image: some program, then what it says of itself (hal/mcu/about_board.hpp, firmware/config/about_image.hpp). */
function imageOf({ board, begin, settings, room, cameras, odometries, oneLine = 0, lowest = 0, motors = 0, camera = 1, odometry = 0, wheels = [650, 14400, 1300] }) {
  const about = Buffer.alloc(60 + 84);
  about.write("fencepost board 1");
  about.write(board, 17);
  [begin, settings, room].forEach((word, i) => about.writeUInt32LE(word, 48 + 4 * i));
  about.write("fencepost image 2", 60);
  about.write("0.1.0", 77);
  about.writeUInt8(8, 91);
  [cameras, odometries, oneLine, lowest, motors].forEach((word, i) => about.writeUInt32LE(word, 92 + 4 * i));
  [camera, 0, odometry, ...wheels, 0, 0].forEach((word, i) => about.writeInt32LE(word, 112 + 4 * i));
  const program = Uint8Array.from({ length: 9000 }, (_, i) => (i * 37 + (i >> 8)) & 0xff);
  return Buffer.concat([program, about, program.subarray(0, 500)]);
}
const F405 = { begin: 0x08000000, settings: 0x08004000, room: 0x4000, cameras: 0xfffff, odometries: 0xf };
const RP2040 = { begin: 0x10000000, settings: 0x101fe000, room: 0x1000, cameras: 0xfffff, odometries: 0xf, oneLine: 1, lowest: 8, motors: 1 };
const TWO_WIRE = 0x49419;
export const IMAGES = {
  netduino_plus_2: imageOf({ board: "netduino_plus_2", ...F405 }),
  pyboard: imageOf({ board: "pyboard", ...F405 }),
  feather_f405: imageOf({ board: "feather_f405", ...F405 }),
  pico: imageOf({ board: "pico", ...RP2040 }),
  xrp: imageOf({ board: "xrp", ...RP2040, odometry: 1, wheels: [600, 5850, 1550] }),
  pico2: imageOf({ board: "pico2", ...RP2040 }),
  xrp2: imageOf({ board: "xrp2", ...RP2040, odometry: 1, wheels: [600, 5850, 1550] }),
  microbit: imageOf({ board: "microbit", begin: 0, settings: 0x3f800, room: 0x400, cameras: TWO_WIRE, odometries: 1, camera: 3 }),
  microbit_v2: imageOf({ board: "microbit_v2", begin: 0, settings: 0x7e000, room: 0x1000, cameras: TWO_WIRE, odometries: 1, camera: 3 }),
  gba: imageOf({ board: "gba", begin: 0x08000000, settings: 0x0e000000, room: 0x2000, cameras: 1, odometries: 1, camera: 0 }),
};

/** A copy of the page with these programs inside, { board: bytes }, as toolchain/images.py writes it. */
export function withImages(page, file, images = IMAGES) {
  const inside = Object.entries(images).map(([board, image]) => ({ board, image: gzipSync(image).toString("base64") }));
  writeFileSync(file, readFileSync(page, "utf8").replace("<!-- given -->", `<script type="application/json" id="images">${JSON.stringify(inside)}</script>\n<!-- given -->`));
  return file;
}
