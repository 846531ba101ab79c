// Which behavior controlled each robot at each step, as bands in its color and pattern; × where an expectation failed.

const MANY = DATA.robots > 8;
const BAND = MANY ? 11 : 20, GAP = MANY ? 3 : 4, AXIS = 20;

function bands(slider) {
  const canvas = element("canvas", { id: "bands", role: "img", "aria-label": "Which behavior controlled each robot at each step; the table below says the same" });
  const names = element("div", { class: "band-names", "aria-hidden": "true" }, ...[...Array(DATA.robots).keys()].map((robot) => element("span", {}, `robot ${robot}`)));
  const surface = element("div", { class: "band-surface" }, canvas);
  const still = document.createElement("canvas"); // the bands without the mark of the step
  const mark = () => surface.clientWidth && markStep(canvas, still, surface.clientWidth);
  const draw = (width) => {
    drawBands(still, width);
    mark();
  };
  redrawn(surface, draw);
  replay.listen((what) => (what === "step" ? mark() : surface.clientWidth && draw(surface.clientWidth)));
  follow(surface, (event) => {
    const box = canvas.getBoundingClientRect();
    return 1 + Math.floor(((event.clientX - box.left) / box.width) * replay.steps);
  });
  return element("div", { class: MANY ? "bands many" : "bands" }, names, surface, element("div", { class: "slider" }, slider));
}

function drawBands(canvas, width) {
  const height = DATA.robots * (BAND + GAP) + AXIS;
  const pen = canvasOf(canvas, width, height);
  const fills = new Map();
  const episode = replay.episode, per = width / replay.steps;
  episode.controlling.forEach((controlling, robot) => {
    const top = robot * (BAND + GAP);
    for (const [behavior, first, last] of stretches(controlling)) {
      if (!fills.has(behavior)) fills.set(behavior, fillOf(pen, behavior));
      pen.fillStyle = fills.get(behavior);
      pen.fillRect(first * per, top, Math.max((last - first + 1) * per, 0.75), BAND);
    }
    if (robot === replay.robot && DATA.robots > 1) {
      pen.strokeStyle = theme("ink");
      pen.lineWidth = 1.5;
      pen.strokeRect(0.75, top + 0.75, width - 1.5, BAND - 1.5);
    }
    failures(pen, episode.expectations[robot] ?? [], per, top);
  });
  axis(pen, width, height, per);
}

function failures(pen, outcomes, per, top) {
  const cross = (x, y) => lines(pen, [[x - 3, y - 3, x + 3, y + 3], [x - 3, y + 3, x + 3, y - 3]]);
  outcomes.forEach((outcome, at) => {
    if (outcome !== "failed") return;
    for (const [style, size] of [["paper", 3], ["ink", 1.2]]) {
      pen.strokeStyle = theme(style);
      pen.lineWidth = size;
      cross((at + 0.5) * per, top + BAND / 2);
    }
  });
}

function axis(pen, width, height, per) {
  pen.fillStyle = theme("faint");
  pen.font = `12px ${theme("font")}`;
  const every = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000].find((each) => each * per >= 56) ?? replay.steps;
  for (let step = every; step <= replay.steps; step += every) {
    const x = (step - 0.5) * per;
    pen.fillRect(x, height - AXIS, 1, 4);
    pen.textAlign = x > width - 20 ? "right" : "center";
    pen.fillText(step.toLocaleString("en-US"), Math.min(x, width), height - 3);
  }
}

function markStep(canvas, still, width) {
  const height = DATA.robots * (BAND + GAP), x = ((replay.step - 0.5) / replay.steps) * width;
  const pen = canvasOf(canvas, width, height + AXIS);
  pen.drawImage(still, 0, 0, width, height + AXIS);
  for (const [style, size] of [["paper", 5], ["ink", 2]]) {
    pen.fillStyle = theme(style);
    pen.fillRect(x - size / 2, 0, size, height);
  }
}

const MOST_ROWS = 1000;

function controlTable() {
  const rows = replay.episode.controlling.flatMap((controlling, robot) => {
    const actions = replay.episode.actions[robot];
    return stretches(controlling.map((behavior, at) => `${behavior} ${actions[at]}`))
      .map(([, first, last]) => [`robot ${robot}`, first + 1, last + 1, nameOf(controlling[first]), actions[first]]);
  });
  const more = rows.length > MOST_ROWS ? ` (the first ${number(MOST_ROWS)} of ${number(rows.length)} stretches)` : "";
  return table(`Who controlled from which step to which${more}`, ["robot", "from", "to", "behavior", "action"], rows.slice(0, MOST_ROWS), { left: [0, 3, 4] });
}

function shareTable() {
  const rows = [...DATA.layers, NOBODY].map((behavior) => [named(behavior), ...replay.episode.controlling.map((controlling) =>
    percent(controlling.filter((each) => each === behavior).length / controlling.length))]);
  return table("Share of this episode's steps in control", ["behavior", ...replay.episode.controlling.map((_, robot) => `robot ${robot}`)], rows);
}
