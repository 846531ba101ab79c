// A color and a pattern for each behavior, in the spec's order; nobody is last. No color stands alone.

const COLORS = 8;
const NOBODY = -1;

const colorOf = (behavior) => theme(behavior === NOBODY ? "nobody" : `module-${behavior % COLORS}`);

const PATTERNS = [
  () => {},
  (pen) => lines(pen, [[0, 8, 8, 0], [-2, 2, 2, -2], [6, 10, 10, 6]]),
  (pen) => dots(pen, [[2, 2], [6, 6]]),
  (pen) => lines(pen, [[0, 4, 8, 4]]),
  (pen) => lines(pen, [[0, 0, 8, 8], [-2, 6, 2, 10], [6, -2, 10, 2]]),
  (pen) => lines(pen, [[4, 0, 4, 8]]),
  (pen) => lines(pen, [[0, 4, 8, 4], [4, 0, 4, 8]]),
  (pen) => { dots(pen, [[4, 4]]); },
];

function lines(pen, each) {
  pen.beginPath();
  for (const [fromX, fromY, toX, toY] of each) {
    pen.moveTo(fromX, fromY);
    pen.lineTo(toX, toY);
  }
  pen.stroke();
}

function dots(pen, each) {
  for (const [x, y] of each) {
    pen.beginPath();
    pen.arc(x, y, 1.3, 0, 2 * Math.PI);
    pen.fill();
  }
}

// The fill of a behavior: its color with its pattern in the color of the paper.
function fillOf(pen, behavior) {
  const tile = document.createElement("canvas");
  tile.width = tile.height = 8;
  const brush = tile.getContext("2d");
  brush.fillStyle = colorOf(behavior);
  brush.fillRect(0, 0, 8, 8);
  brush.strokeStyle = brush.fillStyle = theme("paper");
  brush.lineWidth = 1.2;
  if (behavior !== NOBODY) PATTERNS[(behavior + Math.floor(behavior / COLORS)) % PATTERNS.length](brush);
  return pen.createPattern(tile, "repeat");
}

// A small sample of a behavior's color and pattern, beside its name.
function swatch(behavior) {
  const canvas = element("canvas", { class: "swatch", "aria-hidden": "true" });
  const draw = () => {
    const pen = canvasOf(canvas, 22, 12);
    pen.fillStyle = fillOf(pen, behavior);
    pen.fillRect(0, 0, 22, 12);
  };
  draw();
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  return canvas;
}

const nameOf = (behavior) => (behavior === NOBODY ? "nobody" : DATA.behaviors[behavior].name);
const named = (behavior) => element("span", { class: "named" }, swatch(behavior), nameOf(behavior));
