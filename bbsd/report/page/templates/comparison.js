// How another design differs: in what it earns and does, in rules and order, and which change the difference is from.

const command = (each) => (each.behavior ? `${each.behavior}: ${each.action}` : "nobody");
const places = (where) => where.join("; or ");

function comparisonSection(comparison) {
  const { a, b, return: earns } = comparison;
  const difference = earns.difference;
  const paired = comparison.paired ? "in the same episodes" : "in episodes of their own";
  return section("comparison", `Beside ${b}`,
    element("p", {}, element("b", {}, moreOrLess(difference.mean, a, b)),
      `, 95 % interval ${between(difference)}, ${paired} (${number(comparison.episodes)}): ${number(earns.a.mean)} and ${number(earns.b.mean)}.`),
    ...comparison.notes.map((note) => element("p", { class: "note" }, note)),
    estimates(`Difference of the return and of each reward term, ${b} minus ${a}`, ["what", a, b, "difference", "95 % interval"],
      [{ ...spread(difference), cells: ["return", number(earns.a.mean), number(earns.b.mean), change(difference), between(difference)] },
        ...Object.entries(comparison.reward_terms).map(([term, each]) => ({ ...spread(each.difference), cells: [term, given(each.a), given(each.b), change(each.difference), between(each.difference)] }))]),
    comparison.sources.length ? estimates("Which change the difference comes from", ["change", `what it adds to ${a}`, "95 % interval", `what it adds in ${b}`],
      comparison.sources.map((each) => ({ ...spread(each.taken_over_into_a), cells: [sourceText(each), change(each.taken_over_into_a), between(each.taken_over_into_a), change(each.taken_back_in_b)] }))) : "",
    comparison.commands ? commandTables(comparison) : "",
    comparison.rules.length ? table("Cells whose decision differs", ["behavior", "where", a, b, "cells"],
      comparison.rules.map((each) => [each.behavior, places(each.where), each.before, each.after, number(each.cells)]), { left: [0, 1, 2, 3] }) : element("p", {}, "Their tables are the same."),
    orderText(comparison.order, a, b));
}

function moreOrLess(difference, a, b) {
  if (!difference) return `${b} earns as much as ${a}`;
  return `${b} earns ${number(Math.abs(difference))} ${difference > 0 ? "more" : "less"} than ${a}`;
}

const given = (value) => (value === null ? "not a term" : number(value));

function sourceText(each) {
  if (each.kind === "order") return "the order";
  if (each.kind !== "rules") return `${each.behavior}: ${each.kind}`;
  return `${each.behavior}: ${each.before} \u2192 ${each.after}${each.where.length ? ` where ${places(each.where)}` : ""}`;
}

function commandTables({ a, b, commands }) {
  const text = `In ${percent(commands.share_of_a)} of ${a}'s steps ${b} would have commanded something else; in ${percent(commands.share_of_b)} of ${b}'s steps ${a} would.`;
  return element("div", {}, element("p", {}, text), commands.differences.length ? table("Situations with another command", [`${a} does`, `${b} does`, "where", `of ${a}'s steps`, `of ${b}'s steps`],
    commands.differences.map((each) => [command(each.a), command(each.b), places(each.where), percent(each.share_of_a), percent(each.share_of_b)]), { left: [0, 1, 2] }) : "");
}

function orderText(order, a, b) {
  if (order.a.join() === order.b.join()) return element("p", {}, "Their layers have the same order.");
  return table("Layers, the highest first", ["layer", a, b],
    [...Array(Math.max(order.a.length, order.b.length)).keys()].map((index) => [index + 1, order.a[index] ?? "", order.b[index] ?? ""]), { left: [0, 1, 2] });
}
