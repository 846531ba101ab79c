// What is looked at: an episode, one of its steps, one robot. Whoever shows it listens.

const replay = {
  packed: null,
  robot: 0,
  pinned: 1,
  passing: null, // the step under the pointer, while it is there
  listeners: [],
  get episode() { return episodeOf(this.packed); },
  get step() { return this.passing ?? this.pinned; },
  get steps() { return this.episode.shown; },
  listen(listener) { this.listeners.push(listener); },
  tell(what) { for (const listener of this.listeners) listener(what); },
  open(packed) {
    this.packed = packed;
    this.passing = null;
    this.pinned = Math.min(this.pinned, this.steps);
    this.tell("episode");
  },
  look(robot) {
    this.robot = robot;
    this.tell("robot");
  },
  go(step) {
    this.pinned = Math.max(1, Math.min(this.steps, step));
    this.passing = null;
    this.tell("step");
  },
  pass(step) {
    this.passing = step === null ? null : Math.max(1, Math.min(this.steps, step));
    this.tell("step");
  },
};

const SECONDS = 15; // of a replay as a whole
const CALM = matchMedia("(prefers-reduced-motion: reduce)");

const player = {
  timer: 0,
  playing: false,
  toggle(button) {
    this.playing = !this.playing;
    button.textContent = this.playing ? "Pause" : "Play";
    if (!this.playing) return cancelAnimationFrame(this.timer);
    if (replay.pinned >= replay.steps) replay.go(1);
    const rate = CALM.matches ? 2 : Math.min(30, Math.max(4, replay.steps / SECONDS));
    let from = null;
    const first = replay.pinned;
    const advance = (now) => {
      from ??= now;
      const step = first + Math.floor(((now - from) / 1000) * rate);
      if (step !== replay.pinned) replay.go(step);
      if (replay.pinned >= replay.steps) return this.toggle(button);
      this.timer = requestAnimationFrame(advance);
    };
    this.timer = requestAnimationFrame(advance);
  },
};

function transport() {
  const play = element("button", { type: "button", id: "play", onclick: () => player.toggle(play) }, "Play");
  const slider = element("input", { type: "range", id: "step", min: "1", "aria-label": "Step", oninput: () => replay.go(Number(slider.value)) });
  const shown = element("output", { id: "step-shown", for: "step" });
  const episodes = choice("episode", "Episode", DATA.episodes.map((each, index) => [index, `${each.label} `, element("b", {}, number(each.total))]), 0,
    (index) => replay.open(DATA.episodes[index]));
  const jumps = element("div", { class: "jumps" },
    element("button", { type: "button", onclick: () => jump(-1) }, "◀ Previous change"),
    play,
    element("button", { type: "button", onclick: () => jump(1) }, "Next change ▶"));
  replay.listen(() => {
    slider.max = String(replay.steps);
    slider.value = String(replay.step);
    slider.setAttribute("aria-valuetext", `step ${replay.step}: ${sentenceOf(replay.robot, replay.step)}`);
    shown.textContent = `step ${replay.step} of ${replay.steps}`;
  });
  document.addEventListener("keydown", (event) => {
    if (event.target !== document.body || event.ctrlKey || event.altKey || event.metaKey) return;
    const move = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (move) {
      replay.go(replay.pinned + move);
      event.preventDefault();
    }
  });
  return { controls: element("div", { class: "transport" }, episodes, jumps, shown), slider };
}

// Go to the next step at which another behavior takes over control of the robot, forward or back.
function jump(direction) {
  const controlling = replay.episode.controlling[replay.robot];
  let step = replay.pinned;
  do step += direction;
  while (step > 1 && step <= replay.steps && controlling[step - 1] === controlling[step - 2]);
  replay.go(step);
}

// Let a pointer over a plot of the episode pass through the steps; a click stays there.
function follow(surface, stepAt) {
  surface.addEventListener("pointermove", (event) => (event.buttons ? replay.go(stepAt(event)) : event.pointerType === "mouse" && replay.pass(stepAt(event))));
  surface.addEventListener("pointerleave", () => replay.passing !== null && replay.pass(null));
  surface.addEventListener("pointerdown", (event) => replay.go(stepAt(event)));
}
