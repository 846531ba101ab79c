// Why a step went as it did: for each layer whether it was excited, its cell, its wish, and what became of it.

const NO_ACTION = "no action";
const wordOf = (behavior, wish) => (wish ? DATA.behaviors[behavior].actions[wish - 1].name : NO_ACTION);

// The part of a behavior in the decision of a step: controls, suppressed, leaves it (No Action), or is not excited.
function partOf(behavior, robot, step) {
  const episode = replay.episode, at = step - 1;
  const wish = episode.wishes[robot][behavior][at];
  const cell = episode.cells[robot][behavior][at];
  const part = { behavior, cell, wish, does: wordOf(behavior, wish) };
  if (!episode.excited[robot][behavior][at]) return { ...part, state: "calm" };
  if (episode.controlling[robot][at] === behavior) return { ...part, state: "controls" };
  return { ...part, state: wish ? "suppressed" : "leaves" };
}

const SIGNS = { controls: "▶", suppressed: "⊘", leaves: "–", calm: "○" };

function stateText(part) {
  return {
    controls: `controls: ${part.does}`,
    suppressed: `suppressed, wanted ${part.does}`,
    leaves: NO_ACTION,
    calm: "not excited",
  }[part.state];
}

// The cells of a behavior's inputs in one of its cells, the first input counting slowest.
function placesOf(behavior, cell) {
  const places = [];
  for (const input of [...DATA.behaviors[behavior].inputs].reverse()) {
    places.unshift(cell % input.cells.length);
    cell = Math.floor(cell / input.cells.length);
  }
  return places;
}

function cellText(behavior, cell) {
  const inputs = DATA.behaviors[behavior].inputs;
  return placesOf(behavior, cell).map((place, index) => `${inputs[index].name} is ${inputs[index].cells[place]}`).join(", ");
}

// The rule that decides a cell; none where rules differ from the table, since higher layers always act there.
function ruleOf(behavior, cell) {
  const { rules, rule_of_cell: ruleOfCell, decisions } = DATA.behaviors[behavior];
  const rule = ruleOfCell?.[cell] ?? -1;
  return rules[rule]?.decision === wordOf(behavior, decisions[cell]) ? rule : -1;
}

// The condition of the rule that decides a cell; of a rule for all other cells, the cell itself.
function reasonOf(behavior, cell) {
  const about = DATA.behaviors[behavior];
  const rule = about.rules[ruleOf(behavior, cell)];
  if (rule?.where) return ` where ${rule.where}`;
  if (rule && about.rules.length === 1) return ", as always";
  const text = cellText(behavior, cell);
  return text ? ` (${text})` : "";
}

function sentenceOf(robot, step) {
  const episode = replay.episode, at = step - 1;
  const behavior = episode.controlling[robot][at];
  const who = DATA.robots > 1 ? `robot ${robot}: ` : "";
  const parts = DATA.layers.map((each) => partOf(each, robot, step));
  const suppressed = parts.filter((part) => part.state === "suppressed").map((part) => `${nameOf(part.behavior)} wanted ${part.does}`);
  const under = suppressed.length ? `; suppressed: ${suppressed.join(", ")}` : "";
  if (behavior === NOBODY) return `${who}nobody controls, commands stay as they are`;
  return `${who}${nameOf(behavior)} controls and does ${episode.actions[robot][at]}${reasonOf(behavior, episode.cells[robot][behavior][at])}${under}`;
}

// The decision of every layer as a table, for readers of tables.
function whyTable() {
  const rows = DATA.layers.map((behavior, index) => {
    const part = partOf(behavior, replay.robot, replay.step);
    const excited = part.state === "calm" ? "no" : "yes";
    const conditions = DATA.behaviors[behavior].excited;
    return [named(behavior), DATA.layers.length - index, conditions ? `${excited}: ${conditions}` : excited, cellText(behavior, part.cell) || "always the same", part.does, stateText(part)];
  });
  return table(`Decision of step ${replay.step}${DATA.robots > 1 ? `, robot ${replay.robot}` : ""}`,
    ["behavior", "layer", "excited", "cell", "wish", "outcome"], rows, { left: [0, 2, 3, 4, 5] });
}

function whySentence() {
  const text = element("p", { id: "why", "aria-live": "polite" });
  replay.listen(() => {
    text.setAttribute("aria-live", player.playing || replay.passing !== null ? "off" : "polite");
    text.textContent = `Step ${replay.step}, ${sentenceOf(replay.robot, replay.step)}.`;
  });
  return text;
}

// The command that says it in a terminal, and what would have changed it.
function whyCommand() {
  const text = element("code", { id: "ask" });
  replay.listen(() => {
    const robot = DATA.robots > 1 ? ` --robot ${replay.robot}` : "";
    text.textContent = `${DATA.repeat.ask} --episode ${replay.episode.number} --step ${replay.step}${robot}`;
  });
  return element("p", { class: "note" }, "In a terminal, also what would have changed it: ", text);
}

// Who controls each robot now; choosing one shows its decision.
function robotList() {
  const rows = [...Array(DATA.robots).keys()].map((robot) => {
    const who = element("span", { class: "controlling" });
    const does = element("span", { class: "does" });
    const input = element("input", { type: "radio", name: "robot", value: robot, onchange: () => replay.look(robot) });
    input.checked = robot === replay.robot;
    const samples = new Map([...DATA.layers, NOBODY].map((behavior) => [behavior, swatch(behavior)]));
    const sample = element("span", { class: "sample" });
    replay.listen(() => {
      const behavior = replay.episode.controlling[robot][replay.step - 1];
      who.textContent = nameOf(behavior);
      does.textContent = replay.episode.actions[robot][replay.step - 1];
      sample.replaceChildren(samples.get(behavior) ?? swatch(behavior));
    });
    return element("li", { "data-robot": robot }, element("label", {}, input, element("span", {}, `robot ${robot}`), sample, who, does));
  });
  return element("fieldset", { class: "robots" }, element("legend", {}, DATA.robots > 1 ? "Robots, and who controls them now" : "Who controls now"),
    element("ul", { id: "robots", class: DATA.robots > 8 ? "many" : "" }, ...rows));
}

// All values before and after a step, with what it earned.
function valuesTable() {
  const episode = replay.episode, step = replay.step;
  const rows = episode.values.map((each) => [each.text, show(each.column[step - 1]), show(each.column[step])]);
  const earned = episode.rewards.flatMap((term) => term.robots.map((column, robot) =>
    [DATA.robots > 1 ? `${term.name}, robot ${robot}` : term.name, number(column[step - 1])]));
  const parts = [table(`Values before and after step ${step}`, ["value", "before", "after"], rows)];
  if (earned.length) parts.push(table(`Reinforcement of step ${step} by term`, ["term", "earned"], earned));
  return element("div", {}, ...parts);
}

const show = (value) => (value === undefined ? "" : typeof value === "boolean" ? String(value) : number(value));

// Parts that are made anew at every step, while they are open.
function live(summary, make) {
  const details = element("details", { class: "behind" }, element("summary", {}, summary));
  const content = element("div");
  details.append(content);
  const update = () => details.open && content.replaceChildren(make());
  details.addEventListener("toggle", update);
  replay.listen(update);
  return details;
}
