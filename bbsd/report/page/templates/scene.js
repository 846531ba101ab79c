// The view from above: surroundings, marks, the robots with their paths so far in the colors of the behaviors in control.

const MARGIN = 0.04; // around everything, as a share of the larger side
const TALLEST = 460; // CSS pixels

function fromAbove() {
  const canvas = element("canvas", { id: "scene", role: "img" });
  const surface = element("div", { class: "scene" }, canvas);
  let width = 0;
  redrawn(surface, (now) => {
    width = now;
    drawScene(canvas, width);
  });
  replay.listen(() => {
    canvas.setAttribute("aria-label", `From above at step ${replay.step}: ${placesText()}`);
    if (width) drawScene(canvas, width);
  });
  return surface;
}

function placesText() {
  const scene = replay.episode.scene;
  const at = (track) => `${number(track[replay.step][0], 3)}, ${number(track[replay.step][1], 3)}`;
  return [...scene.places.map((track, robot) => `robot ${robot} at ${at(track)}`), ...scene.marks.map((mark) => `${mark.name} at ${at(mark.track)}`)].join("; ");
}

// The transformation from the view's plane to the canvas; the limits come with the episode.
function planeOf(width) {
  const [left, bottom, right, top] = replay.episode.scene.limits;
  const spanX = Math.abs(right - left), spanY = Math.abs(top - bottom);
  const margin = MARGIN * Math.max(spanX, spanY) || 1;
  const scale = Math.min(width / (spanX + 2 * margin), TALLEST / (spanY + 2 * margin));
  const height = Math.max(120, scale * (spanY + 2 * margin));
  const [toRight, up] = [right >= left ? 1 : -1, top >= bottom ? 1 : -1];
  const middleX = (left + right) / 2, middleY = (bottom + top) / 2;
  return {
    height, scale, toRight, up,
    x: (x) => width / 2 + toRight * (x - middleX) * scale,
    y: (y) => height / 2 - up * (y - middleY) * scale,
  };
}

const finite = (...values) => values.every((value) => Number.isFinite(value));

function drawScene(canvas, width) {
  const scene = replay.episode.scene, plane = planeOf(width), step = replay.step;
  const pen = canvasOf(canvas, width, plane.height);
  pen.lineJoin = pen.lineCap = "round";
  drawSurroundings(pen, scene, plane);
  for (const mark of scene.marks) drawTrail(pen, mark.track, step, plane);
  scene.places.forEach((track, robot) => robot !== replay.robot && drawPath(pen, track, robot, plane));
  drawPath(pen, scene.places[replay.robot], replay.robot, plane);
  for (const mark of scene.marks) drawMark(pen, mark, step, plane, width);
  scene.places.forEach((track, robot) => drawRobot(pen, track, robot, plane));
}

function drawSurroundings(pen, scene, plane) {
  pen.fillStyle = theme("solid");
  scene.walls.forEach(([column, row]) => {
    const x = plane.x(column), y = plane.y(row), half = plane.scale / 2;
    pen.fillRect(x - half, y - half, 2 * half, 2 * half);
  });
  for (const [x, y, radius] of scene.circles) {
    if (!finite(x, y, radius)) continue;
    circle(pen, plane.x(x), plane.y(y), radius * plane.scale);
    pen.fill();
  }
  pen.strokeStyle = theme("faint");
  pen.lineWidth = 2;
  for (const line of scene.lines) trace(pen, line, 0, line.length - 1, plane);
  if (scene.area) {
    const [left, bottom, right, top] = scene.area;
    pen.strokeStyle = theme("ink");
    pen.lineWidth = 2;
    pen.strokeRect(plane.x(left), plane.y(top), plane.x(right) - plane.x(left), plane.y(bottom) - plane.y(top));
  }
}

function circle(pen, x, y, radius) {
  pen.beginPath();
  pen.arc(x, y, Math.max(radius, 0), 0, 2 * Math.PI);
}

function drawTrail(pen, track, step, plane) {
  pen.strokeStyle = theme("faint");
  pen.lineWidth = 1;
  pen.setLineDash([4, 4]);
  trace(pen, track, 0, step, plane);
  pen.setLineDash([]);
}

function trace(pen, track, first, last, plane) {
  pen.beginPath();
  let isDown = false;
  for (let moment = first; moment <= last; moment += 1) {
    const [x, y] = track[moment];
    if (!finite(x, y)) isDown = false;
    else if (isDown) pen.lineTo(plane.x(x), plane.y(y));
    else {
      pen.moveTo(plane.x(x), plane.y(y));
      isDown = true;
    }
  }
  pen.stroke();
}

// A robot's path so far, each stretch in the color of the behavior in control, in a dash of its own.
const DASHES = [[], [9, 5], [2, 5], [9, 4, 2, 4], [5, 5], [14, 5], [1, 4], [7, 3, 1, 3]];

function drawPath(pen, track, robot, plane) {
  const isChosen = robot === replay.robot;
  for (const [behavior, first, last] of stretches(replay.episode.controlling[robot].slice(0, replay.step))) {
    pen.strokeStyle = theme("paper");
    pen.lineWidth = isChosen ? 6 : 4;
    trace(pen, track, first, last + 1, plane);
    pen.strokeStyle = colorOf(behavior);
    pen.lineWidth = isChosen ? 3.5 : 2;
    pen.setLineDash(behavior === NOBODY ? [1, 4] : DASHES[behavior % DASHES.length]);
    trace(pen, track, first, last + 1, plane);
    pen.setLineDash([]);
  }
}

function drawMark(pen, mark, step, plane, width) {
  const [x, y, radius] = mark.track[step];
  if (!finite(x, y)) return;
  const [atX, atY] = [plane.x(x), plane.y(y)];
  pen.strokeStyle = theme("ink");
  pen.lineWidth = 1;
  if (finite(radius)) {
    pen.setLineDash([3, 3]);
    circle(pen, atX, atY, radius * plane.scale);
    pen.stroke();
    pen.setLineDash([]);
  }
  pen.fillStyle = theme("mark");
  pen.beginPath();
  for (const [dx, dy] of [[0, -7], [7, 0], [0, 7], [-7, 0]]) pen.lineTo(atX + dx, atY + dy);
  pen.closePath();
  pen.fill();
  pen.stroke();
  const { area } = replay.episode.scene;
  label(pen, mark.name, atX, atY, area ? Math.max(plane.x(area[0]), plane.x(area[2])) : width);
}

function drawRobot(pen, track, robot, plane) {
  const [x, y, radius] = track[replay.step];
  if (!finite(x, y)) return;
  const [atX, atY] = [plane.x(x), plane.y(y)], isChosen = robot === replay.robot;
  const behavior = replay.episode.controlling[robot][replay.step - 1];
  const size = Math.max(DATA.robots > 1 ? 9 : 7, finite(radius) ? radius * plane.scale : 0);
  const heading = replay.episode.scene.headings?.[robot][replay.step];
  pen.lineWidth = isChosen ? 2.5 : 1.2;
  pen.strokeStyle = theme("ink");
  pen.fillStyle = colorOf(behavior);
  if (finite(heading)) {
    const angle = Math.atan2(-plane.up * Math.sin(heading), plane.toRight * Math.cos(heading)), back = 0.6;
    pen.beginPath();
    pen.moveTo(atX + 1.8 * size * Math.cos(angle), atY + 1.8 * size * Math.sin(angle));
    pen.arc(atX, atY, size, angle + back, angle - back + 2 * Math.PI);
    pen.closePath();
  } else circle(pen, atX, atY, size);
  pen.fill();
  pen.stroke();
  if (DATA.robots > 1) {
    circle(pen, atX, atY, 7);
    pen.fillStyle = theme("paper");
    pen.fill();
    pen.fillStyle = theme("ink");
    pen.font = `bold 11px ${theme("font")}`;
    pen.textAlign = "center";
    pen.fillText(String(robot), atX, atY + 4);
  }
}

function label(pen, text, x, y, edge) {
  pen.font = `12px ${theme("font")}`;
  const isLeft = x + 15 + pen.measureText(text).width > edge;
  pen.textAlign = isLeft ? "right" : "left";
  pen.strokeStyle = theme("paper");
  pen.lineWidth = 3;
  pen.strokeText(text, x + (isLeft ? -11 : 11), y - 6);
  pen.fillStyle = theme("ink");
  pen.fillText(text, x + (isLeft ? -11 : 11), y - 6);
}
