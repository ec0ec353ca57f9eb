// Colours that are distinct with every common kind of colour vision (Okabe and Ito), and a mark for each signature.

const WHEEL = [  // a trained colour's hue, and the colour that is drawn for it by day and by night
  { hue: 5, light: "#c24a00", dark: "#ff7a3d" },     // red: vermilion
  { hue: 35, light: "#a86f00", dark: "#e69f00" },    // orange
  { hue: 58, light: "#8a7a00", dark: "#f0e442" },    // yellow
  { hue: 130, light: "#00795a", dark: "#2fd0a2" },   // green: bluish green
  { hue: 190, light: "#1d78a8", dark: "#56b4e9" },   // cyan: sky blue
  { hue: 230, light: "#00599a", dark: "#6ea8ff" },   // blue
  { hue: 310, light: "#a8487c", dark: "#f09cc9" },   // magenta: reddish purple
];
const GREY = { light: "#55616e", dark: "#b8c3cd" };
const MARKS = ["circle", "square", "triangle", "diamond", "cross", "star", "bar"];

export const LEVELS = ["clear", "notice", "warn", "stop", "blind"];

function hueOf(rgb) {
  const [r, g, b] = [0, 2, 4].map((at) => parseInt(rgb.slice(at, at + 2), 16) / 255);
  const high = Math.max(r, g, b);
  const spread = high - Math.min(r, g, b);
  if (spread < 0.12) return null;
  const sixth = high === r ? (g - b) / spread : high === g ? 2 + (b - r) / spread : 4 + (r - g) / spread;
  return (60 * sixth + 360) % 360;
}

const apart = (a, b) => Math.min(Math.abs(a - b), 360 - Math.abs(a - b));

/** `rgb` as six hex digits, or null where the log has none. */
export function colourOf(rgb, signature, theme) {
  if (!/^[0-9a-f]{6}$/i.test(rgb ?? "")) return WHEEL[signature % WHEEL.length][theme];
  const hue = hueOf(rgb);
  if (hue === null) return GREY[theme];
  return WHEEL.reduce((best, entry) => apart(entry.hue, hue) < apart(best.hue, hue) ? entry : best)[theme];
}

export const markOf = (signature) => MARKS[(signature + MARKS.length - 1) % MARKS.length];

/** The mark of a signature, filled, around (x, y). */
export function drawMark(g, mark, x, y, size) {
  const corners = (n, turn, inner = 1) => {
    for (let i = 0; i < n; ++i) {
      const r = i % 2 ? size * inner : size;
      const a = turn + i * 2 * Math.PI / n;
      g.lineTo(x + r * Math.sin(a), y - r * Math.cos(a));
    }
    g.closePath();
  };
  g.beginPath();
  if (mark === "circle") g.arc(x, y, size * 0.9, 0, 2 * Math.PI);
  if (mark === "square") g.rect(x - size * 0.8, y - size * 0.8, size * 1.6, size * 1.6);
  if (mark === "triangle") corners(3, 0);
  if (mark === "diamond") corners(4, 0);
  if (mark === "cross") corners(8, 0, 0.3);
  if (mark === "star") corners(10, 0, 0.45);
  if (mark === "bar") g.rect(x - size, y - size * 0.4, size * 2, size * 0.8);
  g.fill();
}

/** The style sheet's colours for the theme in force. */
export function inks() {
  const style = getComputedStyle(document.documentElement);
  const ink = (name) => style.getPropertyValue(`--${name}`).trim();
  const names = ["ink", "soft", "rule", "paper", "ground", "accent", ...LEVELS];
  return Object.fromEntries(names.map((name) => [name, ink(name)]));
}

export const theme = () => document.documentElement.dataset.theme === "dark" ? "dark" : "light";
