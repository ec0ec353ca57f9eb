// A drive past 32 things, each with a name that is long, strange, or like its neighbour's; and the truth likewise.

const ALIKE = "twenty letters alike ";  // and then different
const STRANGE = ["箱子箱子箱子箱子箱子", "שלום תיבה ירוקה", "Straße über Öl – Ärger №", "🤖🚧🟥🟦🤖🚧🟥", "<img src=x onerror=hacked=1>", "</script><b>\"&amp;'", "WWWWWWWWWWWWWWWWWWWWWWWWWWWWWWWW",
  "x", "  spaces   in between ", "e\u0301e\u0301e\u0301e\u0301e\u0301 combining"];

export const NAMES = Array.from({ length: 32 }, (_, i) => i < 22 ? `${ALIKE}${String.fromCharCode(97 + i).repeat(1 + i % 10)}` : STRANGE[i - 22]);

export function hostileScene() {
  const objects = NAMES.map((name, i) => {
    const [row, column] = [i % 4, Math.floor(i / 4)];
    const x = 0.9 + 0.42 * column + 0.05 * row;
    const y = [0.42, -0.42, 0.78, -0.78][row] + 0.03 * (column % 3);
    return { name: i < 22 ? `the same begin of a very long name in the truth, number ${i} of them, and the same end` : name, signature: i + 1, height: 0.12 + 0.02 * row,
      footprint: { circle: [x, y, 0.05] } };
  });
  return {
    format: 1, seed: 3,
    camera: { model: "pixy2", width: 316, height: 208, fx: 200, fy: 200, cx: 157.5, cy: 103.5, k1: 0,
      mount: { x: 0.05, y: 0, z: 0.2, yaw: 0, pitch: 0.2 }, latency: 0.05, rate: 15, max_blobs: 16 },
    robot: { width: 0.2 },
    signatures: NAMES.map((name, i) => ({ id: i + 1, name, rgb: (0x102030 + i * 0x070b0d).toString(16).padStart(6, "0") })),
    objects,
    path: { type: "waypoints", points: [[0, 0], [1.5, 0.05], [3, -0.05], [4.4, 0]], speed: 0.25, turn_rate: 0.6 },
  };
}
