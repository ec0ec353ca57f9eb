// The film that a camera plays in the tests: an orange box stands, comes, and stands again. Black and white cells in the upper left corner are the
// number of each picture.
export const [WIDTH, HEIGHT] = [320, 240];
export const RATE = 20;    // pictures a second
export const COMES = 5;    // s; until then it stands
const HERE = 9.3;          // s; from then on it stands
export const LENGTH = 11;  // s
export const SPEED = 0.3;  // m/s
const FAR = 1.5;           // m, where it stands at first
const BROAD = 0.12;        // m
const FOCAL = 277.13;
export const CELL = 12;    // px
export const BITS = 9;

export const distanceAt = (number) => FAR - SPEED * (Math.min(HERE, Math.max(COMES, number / RATE)) - COMES);
export function truthAt(number) {
  const half = FOCAL * BROAD / 2 / distanceAt(number);
  return [Math.round(159.5 - half), Math.round(125.5 - half), Math.round(159.5 + half), Math.round(125.5 + half)];
}

/** The pictures of the film as I420, with grey levels that wander as a cheap camera's do. */
export function pictures() {
  const yuv = ([red, green, blue]) => {
    const y = 0.299 * red + 0.587 * green + 0.114 * blue;
    return [16 + y * 219 / 255, 128 + (blue - y) / 1.772 * 224 / 255, 128 + (red - y) / 1.402 * 224 / 255];
  };
  let random = 1;
  const noise = () => { random = (random * 48271) % 2147483647; return random % 7 - 3; };
  const [wall, box] = [yuv([120, 122, 126]), yuv([230, 110, 30])];
  const all = [];
  for (let number = 0; number < LENGTH * RATE; ++number) {
    const [x1, y1, x2, y2] = truthAt(number);
    const inside = (u, v) => u >= x1 && u <= x2 && v >= y1 && v <= y2;
    const luma = Buffer.alloc(WIDTH * HEIGHT);
    for (let v = 0; v < HEIGHT; ++v) {
      for (let u = 0; u < WIDTH; ++u) {
        const bit = v < CELL && u < CELL * BITS ? (number >> Math.floor(u / CELL)) & 1 : null;
        luma[v * WIDTH + u] = bit === null ? (inside(u, v) ? box : wall)[0] + noise() : bit ? 235 : 16;
      }
    }
    const chroma = [1, 2].map((part) => {
      const plane = Buffer.alloc(WIDTH * HEIGHT / 4);
      for (let v = 0; v < HEIGHT; v += 2) {
        for (let u = 0; u < WIDTH; u += 2) {
          const orange = [[0, 0], [1, 0], [0, 1], [1, 1]].filter(([du, dv]) => inside(u + du, v + dv)).length / 4;
          const cell = v < CELL && u < CELL * BITS;
          plane[v / 2 * WIDTH / 2 + u / 2] = cell ? 128 : orange * box[part] + (1 - orange) * wall[part];
        }
      }
      return plane;
    });
    all.push(Buffer.concat([luma, ...chroma]));
  }
  return all;
}

/** Those pictures as Y4M. */
export function y4m(list) {
  const head = Buffer.from(`YUV4MPEG2 W${WIDTH} H${HEIGHT} F${RATE}:1 Ip A1:1 C420jpeg\n`);
  return Buffer.concat([head, ...list.flatMap((picture) => [Buffer.from("FRAME\n"), picture])]);
}
