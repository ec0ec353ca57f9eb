// A canvas as sharp as the screen, and scales with round numbers.

/** Its context in CSS pixels, cleared; with the width and height of now. */
export function prepare(canvas) {
  const { clientWidth: width, clientHeight: height } = canvas;
  const ratio = window.devicePixelRatio || 1;
  if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
  }
  const g = canvas.getContext("2d");
  g.setTransform(ratio, 0, 0, ratio, 0, 0);
  g.clearRect(0, 0, width, height);
  g.font = "13px system-ui, sans-serif";
  return { g, width, height };
}

/** The least of 1, 2, 5 times a power of ten that is not below `least`. */
export function niceStep(least) {
  const power = 10 ** Math.floor(Math.log10(least));
  return power * [1, 2, 5, 10].find((factor) => factor * power >= least * 0.999);
}

export const figure = (value, decimals) => value === null || value === undefined ? "–" : value.toFixed(decimals);

/** Text with a rim in the paper's colour, so that it is read on anything. */
export function label(g, text, x, y, ink, rim) {
  g.lineJoin = "round";
  g.lineWidth = 3.5;
  g.strokeStyle = rim;
  g.strokeText(text, x, y);
  g.fillStyle = ink;
  g.fillText(text, x, y);
}
