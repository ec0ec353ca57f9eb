// A room with twenty coloured things, five of them walls that stand across.
const HUES = [["red", "d02020"], ["yellow", "d8c020"], ["green", "20a040"], ["blue", "2040c0"]];
const ring = (x, y, deep, wide) => {
  const corners = [[x - deep, y - wide], [x + deep, y - wide], [x + deep, y + wide], [x - deep, y + wide]];
  return { type: "Polygon", coordinates: [[...corners, corners[0]].map((p) => p.map((v) => Math.round(v * 1e4) / 1e4))] };
};

export function twentyThings() {
  return {
    format: 1, seed: 3,
    camera: { model: "pixy2", width: 316, height: 208, fx: 273.6, fy: 273.6, cx: 157.5, cy: 103.5, k1: 0,
      mount: { x: 0.05, y: 0, z: 0.12, yaw: 0, pitch: 0 }, latency: 0.05, rate: 20, max_blobs: 16 },
    robot: { width: 0.2 },
    signatures: HUES.map(([name, rgb], i) => ({ id: i + 1, name, rgb })),
    objects: Array.from({ length: 20 }, (_, i) => {
      const [x, y] = [0.9 + 0.7 * Math.floor(i / 5), 0.7 * (i % 5) - 1.4];
      const kind = i % 4;
      return { name: `${HUES[kind][0]} ${i}`, signature: kind + 1, height: 0.14,
        footprint: kind === 1 ? { circle: [x, y, 0.05] } : kind === 3 ? ring(x, y, 0.025, 0.2) : ring(x, y, 0.07, 0.06) };
    }),
    noise: { edge_px: 0.5 },
  };
}
