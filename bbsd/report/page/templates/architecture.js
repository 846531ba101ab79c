// The architecture, as the paper's Fig. 2: layers as boxes, the highest on top; sensors left, commands right.

const OPEN_RULES = 14; // rules of all layers together up to which they are open at first

function architecture() {
  const cards = DATA.layers.map((behavior, index) => layerCard(behavior, DATA.layers.length - index));
  const inputs = sensorBoxes();
  const commands = commandBoxes();
  const wires = drawn("svg", { class: "wires", "aria-hidden": "true" });
  const figure = element("div", { class: "architecture", role: "group", "aria-label": "Architecture: layers, the highest on top" },
    wires, inputs.column, element("ol", { class: "layers" }, ...cards.map((card) => card.item)), commands.column);
  const rewire = () => drawWires(wires, figure, cards, inputs.boxes, commands.boxes);
  new ResizeObserver(rewire).observe(figure);
  replay.listen(() => {
    for (const part of [...cards, inputs, commands]) part.update();
    rewire();
  });
  return figure;
}

function layerCard(behavior, layer) {
  const about = DATA.behaviors[behavior];
  const state = element("span", { class: "state" });
  const head = element("summary", {}, element("span", { class: "layer", "aria-label": `layer ${layer}` }, String(layer)),
    element("span", { class: "who" }, swatch(behavior), about.name), state);
  const rules = about.rules.map((rule, index) => element("li", { "data-rule": index },
    element("span", { class: "do" }, rule.decision), ` ${rule.where ? `where ${rule.where}` : about.rules.length > 1 ? "otherwise" : "always"}`,
    rule.overruled ? element("span", { class: "note" }, " (higher layers always prevent it)") : null));
  const card = element("details", {}, head);
  card.open = DATA.behaviors.reduce((sum, each) => sum + each.rules.length, 0) <= OPEN_RULES;
  if (about.excited) card.append(element("p", { class: "excited" }, "when ", element("code", {}, about.excited)));
  if (rules.length) card.append(element("ol", { class: "rules" }, ...rules));
  else card.append(element("p", {}, `its rules would be too long to read: a table of ${counted(about.n_cells, "cell")}`));
  for (const remark of about.remarks) card.append(element("p", { class: "note" }, remark));
  const dropped = DATA.worth?.behaviors.find((each) => each.behavior === about.name)?.dropped;
  if (dropped) card.append(element("p", { class: "note" }, `without it: ${change(dropped)} (${between(dropped)})`));
  if (about.expects) card.append(element("p", { class: "note" }, "expects afterwards: ", element("code", {}, about.expects)));
  if (about.inputs.length && about.is_listed) card.append(live(`Decision table of ${about.name}`, () => decisionTable(behavior)));
  const item = element("li", { "data-layer": layer, "data-behavior": about.name }, card);
  return {
    behavior, item, head,
    update() {
      const part = partOf(behavior, replay.robot, replay.step);
      this.part = part;
      item.dataset.state = part.state;
      state.textContent = `${SIGNS[part.state]} ${stateText(part)}`;
      const fired = part.state === "calm" ? null : ruleOf(behavior, part.cell);
      rules.forEach((rule, index) => (index === fired ? rule.setAttribute("aria-current", "true") : rule.removeAttribute("aria-current")));
    },
  };
}

function decisionTable(behavior) {
  const about = DATA.behaviors[behavior];
  const now = partOf(behavior, replay.robot, replay.step).cell;
  const rows = about.decisions.map((wish, cell) => [
    element("span", {}, cell === now ? "▶ " : "", String(cell)),
    ...placesOf(behavior, cell).map((place, index) => about.inputs[index].cells[place]), wordOf(behavior, wish),
    percent(about.visits ? about.visits[cell] : null)]);
  const made = table(`${about.name}: what it decides in each cell, and the share of the replayed time in it`,
    ["cell", ...about.inputs.map((input) => input.name), "decision", "time"], rows, { left: [0, ...about.inputs.map((_, index) => index + 1), about.inputs.length + 1] });
  made.querySelectorAll("tbody tr")[now]?.setAttribute("aria-current", "true");
  return made;
}

// The whole architecture as one table: of all rows that hold, the one of the highest layer counts.
function wholeTable() {
  const rows = DATA.whole.map((row) => [row.layer, named(indexOf(row.behavior)), row.decision,
    [row.excited, row.where].filter(Boolean).join(" and ") || "always"]);
  return table("Which command in which situation; of all rows that hold, the highest layer's counts", ["layer", "behavior", "does", "where"], rows, { left: [0, 1, 2, 3] });
}

// The inputs of all behaviors with their present cells.
function sensorBoxes() {
  const boxes = DATA.inputs.map((input) => {
    const now = element("span", { class: "now" });
    const item = element("li", { title: input.meaning }, element("span", {}, input.name), now);
    return { ...input, item, now };
  });
  return {
    boxes,
    column: element("div", { class: "side sensors" }, element("h3", {}, "Sensors"), boxes.length ? element("ul", {}, ...boxes.map((box) => box.item)) : "none"),
    update() {
      for (const box of boxes) {
        const [behavior, index] = box.users[0];
        const cell = replay.episode.cells[replay.robot][behavior][replay.step - 1];
        box.now.textContent = DATA.behaviors[behavior].inputs[index].cells[placesOf(behavior, cell)[index]];
      }
    },
  };
}

// The commands that actions set, marked while the one in control sets them.
function commandBoxes() {
  const boxes = DATA.commands.map((name) => ({ name, now: element("span", { class: "now" }) }))
    .map((box) => ({ ...box, item: element("li", {}, element("span", {}, box.name), box.now) }));
  return {
    boxes,
    column: element("div", { class: "side commands" }, element("h3", {}, "Commands"), element("ul", {}, ...boxes.map((box) => box.item))),
    update() {
      const at = replay.step - 1, behavior = replay.episode.controlling[replay.robot][at];
      const action = behavior === NOBODY ? null : DATA.behaviors[behavior].actions.find((each) => each.name === replay.episode.actions[replay.robot][at]);
      for (const box of boxes) {
        box.set = Boolean(action?.sets.some(([name]) => name === box.name));
        box.item.classList.toggle("set", box.set);
        box.now.textContent = box.set ? action.sets.find(([name]) => name === box.name)[1] : "stays";
      }
    },
  };
}

// Wires from sensors to layers, and from layers to a common line to the commands; what acts now is strong.
function drawWires(wires, figure, cards, sensors, commands) {
  if (getComputedStyle(wires).display === "none") return;
  const frame = figure.getBoundingClientRect();
  const at = (node, side) => {
    const box = node.getBoundingClientRect();
    return { x: (side === "left" ? box.left : box.right) - frame.left, y: box.top + box.height / 2 - frame.top };
  };
  wires.setAttribute("viewBox", `0 0 ${frame.width} ${frame.height}`);
  const paths = [], strong = [];
  const path = (d, kind) => (kind === "acts" ? strong : paths).push(drawn("path", { d, class: kind }));
  for (const sensor of sensors) {
    for (const [behavior] of sensor.users) {
      const card = cards.find((each) => each.behavior === behavior);
      if (!card) continue;
      const from = at(sensor.item, "right"), to = at(card.head, "left");
      path(`M${from.x} ${from.y}C${from.x + 24} ${from.y} ${to.x - 24} ${to.y} ${to.x} ${to.y}`, card.part.state === "controls" ? "acts" : "wire");
    }
  }
  const outs = cards.map((card) => ({ ...card, at: at(card.head, "right") }));
  const ends = commands.map((box) => ({ ...box, at: at(box.item, "left") }));
  if (!ends.length) return wires.replaceChildren(...paths, ...strong);
  const line = (outs[0].at.x + ends[0].at.x) / 2;
  const all = [...outs, ...ends].map((each) => each.at.y);
  path(`M${line} ${Math.min(...all)}V${Math.max(...all)}`, "wire");
  const acting = outs.find((each) => each.part.state === "controls");
  for (const each of outs) {
    if (each.part.state === "controls") path(`M${each.at.x} ${each.at.y}H${line}`, "acts");
    else path(`M${each.at.x} ${each.at.y}H${line - (each.part.state === "suppressed" ? 10 : 0)}`, each.part.state === "suppressed" ? "stopped" : "wire");
    if (each.part.state === "suppressed") strong.push(drawn("path", { d: `M${line - 14} ${each.at.y - 5}l8 10m0 -10l-8 10`, class: "cross" }));
  }
  for (const end of ends) {
    path(`M${line} ${end.at.y}H${end.at.x}`, end.set ? "acts" : "wire");
    if (end.set && acting) path(`M${line} ${acting.at.y}V${end.at.y}`, "acts");
    strong.push(drawn("path", { d: `M${end.at.x} ${end.at.y}l-7 -4v8z`, class: end.set ? "tip acts" : "tip" }));
  }
  wires.replaceChildren(...paths, ...strong);
}
