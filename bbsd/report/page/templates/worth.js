// What behaviors, rules and their order are worth, and what stands out.

const spread = (each) => (each ? { value: each.mean, low: each.ci95[0], high: each.ci95[1] } : { value: null, low: null, high: null });
const change = (each) => (each ? signed(each.mean) : "");
const between = (each) => (each && finite(...each.ci95) ? `${signed(each.ci95[0])} to ${signed(each.ci95[1])}` : "");
const signed = (value) => (value > 0 ? `+${number(value)}` : number(value));
const indexOf = (name) => DATA.behaviors.findIndex((each) => each.name === name);
const GRAVE = new Set(["selfish", "harmful", "harmful rule", "broken expectation", "better order"]);

function worthSection(worth) {
  const earned = [...worth.behaviors.map((each) => [each.behavior, each.earned]), ["nobody", worth.nobody.earned]];
  const terms = Object.keys(worth.nobody.earned);
  const sum = (values) => values.reduce((total, value) => total + value, 0);
  const rules = worth.behaviors.flatMap((each) => each.rules.filter((rule) => rule.dropped).map((rule) => ({ behavior: each.behavior, ...rule })));
  return section("worth", "What each part is worth",
    element("p", { class: "note" }, `Each change runs the same ${counted(worth.episodes, "episode")} as the design; a change below 0 is a loss without the part.`),
    estimates("Change of the return if a behavior is held to No Action", ["behavior", "in control", "suppressed", "change", "95 % interval", "if at random"],
      worth.behaviors.map((each) => ({ ...spread(each.dropped), cells: [named(indexOf(each.behavior)), percent(each.control), percent(each.suppressed), change(each.dropped), between(each.dropped), change(each.replaced_at_random)] }))),
    rules.length ? estimates("Change of the return if a rule is dropped", ["rule", "in control", "change", "95 % interval"],
      rules.map((rule) => ({ ...spread(rule.dropped), cells: [`${rule.behavior}: ${rule.decision}${rule.where ? ` where ${rule.where}` : ", otherwise"}`, percent(rule.control), change(rule.dropped), between(rule.dropped)] }))) : "",
    behind("Table: what was earned while each controlled, by reward term", () => table("Earned while in control, per episode", ["behavior", ...terms, "in all"],
      [...earned.map(([name, by]) => [named(indexOf(name)), ...terms.map((term) => number(by[term])), number(sum(terms.map((term) => by[term])))]),
        ["in all", ...terms.map((term) => number(sum(earned.map(([, by]) => by[term])))), number(sum(terms.flatMap((term) => earned.map(([, by]) => by[term]))))]])),
    ...(worth.swaps.length ? orders(worth) : []));
}

function findings(all) {
  if (!all.length) return "";
  return element("ul", { class: "findings", "aria-label": "What stands out" }, ...all.map((each) =>
    element("li", { class: GRAVE.has(each.kind) ? "grave" : "" }, element("b", {}, each.kind), " ", each.text)));
}

function orders(worth) {
  const { above, best, tried, all } = worth.orders;
  const names = worth.behaviors.map((each) => each.behavior);
  return [
    element("h3", {}, "What must stand above what"),
    above.length ? scrolling(partialOrder(names, above), "Partial order of the layers") : element("p", {}, "No layer must stand above another one, as far as these episodes tell."),
    behind("Table: what must stand above what", () => table("Pairs that all orders have in common which are not clearly worse", ["above", "below"], above, { left: [0, 1] })),
    estimates("Change of the return if neighbors are exchanged", ["neighbors", "change", "95 % interval", "by the tables"],
      worth.swaps.map((swap) => ({ ...spread(swap.change), cells: [`${swap.upper}, ${swap.lower}`, change(swap.change), between(swap.change), swap.proven_equal ? "equal" : ""] }))),
    behind("Table: the best orders", () => table(`The best of ${counted(tried, "order")} (${all ? "all" : "two behaviors exchanged, or one elsewhere"})`, ["highest layer first", "change", "95 % interval", "do just the same"],
      best.map((order) => [order.structure.join(" "), change(order.change), between(order.change), order.alike]))),
  ];
}

// Behaviors below all that must stand above them, with lines to the nearest.
function partialOrder(names, above) {
  const depth = new Map(names.map((name) => [name, 0]));
  for (let round = 0; round < names.length; round += 1) {
    for (const [upper, lower] of above) depth.set(lower, Math.max(depth.get(lower), depth.get(upper) + 1));
  }
  const rows = [];
  for (const name of names) (rows[depth.get(name)] ??= []).push(name);
  const wide = 9 * Math.max(...names.map((name) => name.length)) + 30, high = 30, gap = 26;
  const width = Math.max(...rows.map((row) => row.length)) * (wide + 16), height = rows.length * (high + gap) - gap;
  const places = new Map(rows.flatMap((row, level) => row.map((name, index) =>
    [name, { x: (width * (index + 0.5)) / row.length, y: level * (high + gap) }])));
  const links = above.map(([upper, lower]) => {
    const from = places.get(upper), to = places.get(lower);
    return drawn("path", { d: `M${from.x} ${from.y + high}L${to.x} ${to.y - 7}m-4 0h8l-4 7z` });
  });
  const boxes = names.flatMap((name) => {
    const { x, y } = places.get(name);
    return [drawn("rect", { x: x - wide / 2, y: y + 1, width: wide, height: high - 2, rx: 6 }),
      drawn("text", { x, y: y + 20, "text-anchor": "middle" }, name)];
  });
  return drawn("svg", { class: "order", width, height, viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": "Partial order of the layers; the table below says the same" }, ...links, ...boxes);
}

// Faults, and how the design degrades under them.
function faultsSection(faults) {
  return section("faults", "When something fails",
    element("p", { class: "note" }, `Undisturbed it earns ${number(faults.return.mean)} in these ${counted(faults.episodes, "episode")}. A silent behavior has No Action; bbsd report --fault shows other faults, such as robot=0:dead or sensor=NAME:lost.`),
    estimates("Change of the return under each fault alone, in the same episodes", ["fault", "return", "change", "95 % interval"],
      faults.faults.map((each) => ({ ...spread(each.change), cells: [each.fault, number(each.return.mean), change(each.change), between(each.change)] }))));
}
