// The page, from top to bottom.

function earned() {
  const earns = DATA.earns;
  const facts = [["mean return", number(earns.mean), earns.low === null ? "" : `95 % interval ${number(earns.low)} to ${number(earns.high)}`],
    ["worst", number(earns.quantiles[0][1]), ""], ["median", number(earns.quantiles.find(([name]) => name === "median")[1]), ""],
    ["best", number(earns.quantiles[earns.quantiles.length - 1][1]), ""]];
  if (earns.random) facts.push(["random agents", number(earns.random.mean), `95 % interval ${number(earns.random.low)} to ${number(earns.random.high)}`]);
  return element("dl", { class: "facts" }, ...facts.map(([name, value, note]) =>
    element("div", {}, element("dt", {}, name), element("dd", {}, element("b", {}, value), note ? element("span", {}, note) : null))));
}

function head() {
  const behaviors = `${counted(DATA.layers.length, "layer")}, ${counted(DATA.robots, "robot")}`;
  document.getElementById("head").append(
    element("p", { class: "kind" }, "design by ", element("b", {}, "bbsd")),
    element("h1", {}, DATA.name),
    DATA.summary ? element("p", { class: "summary" }, DATA.summary) : "",
    earned(),
    findings([...(DATA.worth?.findings ?? []), ...DATA.useless]),
    element("p", { class: "note" }, `${behaviors}. Measured in ${counted(DATA.earns.episodes, "new episode")}, of ${number(DATA.earns.steps, 4)} ${DATA.earns.steps === 1 ? "step" : "steps"} on average.`));
}

function replaySection() {
  const { controls, slider } = transport();
  const hasScene = Boolean(DATA.episodes[0].scene);
  const picture = hasScene ? element("figure", { class: "above" }, element("figcaption", {}, "From above"), fromAbove()) : valueCharts(0, BESIDE);
  const right = element("div", { class: hasScene ? "right first" : "right" }, robotList(), picture);
  const left = element("div", { class: "left" }, whySentence(), architecture(),
    DATA.left_out.length ? element("p", { class: "note" }, `Not in the structure: ${DATA.left_out.join(", ")}.`) : "", whyCommand());
  const tables = [...(DATA.whole.length ? [behind("Table: the whole design, which command in which situation", wholeTable)] : []), live("Table: why, layer by layer", whyTable), live("Table: values and reinforcement of this step", valuesTable),
    live("Table: share of control in this episode", shareTable), live("Table: who controlled when", controlTable)];
  const notes = DATA.notes.map((note) => element("p", { class: "note" }, note));
  const from = hasScene ? 0 : BESIDE;
  const names = new Set(DATA.episodes[0].values.filter((each) => !each.column.w).map((each) => each.name));
  const curves = names.size > from ? [element("details", { class: "behind" },
    element("summary", {}, from ? "Further values over the steps" : "Values over the steps"), valueCharts(from, MOST_CHARTS))] : [];
  return section("replay", "What it does, and why", controls, bands(slider), element("p", { class: "note" },
    "Point at a band, click it, or use the arrow keys: the layers show why that step went as it did. ",
    DATA.worth ? "Without it: the change of the return, with its 95 % interval. " : "", `${SIGNS.controls} controls, ${SIGNS.suppressed} suppressed by a higher layer, ${SIGNS.leaves} no action, ${SIGNS.calm} not excited.`),
    element("div", { class: "bench" }, left, right), ...curves, ...tables, ...notes);
}

function earnings() {
  const { earns } = DATA;
  const parts = [
    table("Quantiles of the return", ["quantile", "return"], earns.quantiles.map(([name, value]) => [name, number(value)])),
    table("What each reward term gave per episode", ["term", "mean"], earns.terms.map(([name, value]) => [name, number(value)])),
    table("Share of time in control", ["behavior", "share"], earns.control.map(([behavior, share]) => [named(behavior), percent(share)]))];
  if (earns.expectations.length) parts.push(table("How often expectations were met", ["behavior", "share of its steps"], earns.expectations.map(([name, share]) => [name, percent(share)])));
  return section("returns", "What it earns", element("div", { class: "columns" }, element("div", { class: "wide" }, ...distribution(DATA.returns)), ...parts));
}

function textAbout(designed) {
  if (!DATA.spec.is_run) return "Which of its lines were designed is known of the folder of a run.";
  return designed ? "Lines that were designed are marked; the others were given." : "Nothing in it was designed.";
}

function specText() {
  const list = DATA.spec.lines.map(([text, isDesigned], index) => element("li", isDesigned ? { class: "designed" } : {},
    element("code", {}, text || " "), isDesigned ? element("span", { class: "tag" }, "designed") : null));
  const designed = DATA.spec.lines.some(([, isDesigned]) => isDesigned);
  const listing = scrolling(element("ol", { class: "listing" }, ...list), "The spec's text");
  const first = list.find((line) => line.classList.contains("designed"));
  if (first) requestAnimationFrame(() => { listing.scrollTop = first.offsetTop - listing.offsetTop - 40; });
  const cut = DATA.spec.is_cut ? " Only its beginning is shown." : "";
  return section("spec", "The spec", element("p", { class: "note" }, textAbout(designed) + cut), listing);
}

function repeat() {
  return section("repeat", "How to repeat it", ...DATA.repeat.commands.map((text) => scrolling(element("pre", {}, element("code", {}, text)), "Command")),
    table("What it was made with", ["what", "value"], DATA.repeat.facts.map(([name, value]) => [name, element("code", {}, value)]), { left: [0, 1] }));
}

// Begin where the address says, such as page.html#episode=best&robot=1&step=57, else at the start of the worst episode.
function begin(wanted) {
  const episode = Math.max(0, DATA.episodes.findIndex((each) => each.label === wanted.get("episode")));
  const robot = Number(wanted.get("robot"));
  if (Number.isInteger(robot) && robot > 0 && robot < DATA.robots) replay.robot = robot;
  for (const [name, value] of [["episode", episode], ["robot", replay.robot]]) document.querySelector(`input[name="${name}"][value="${value}"]`).checked = true;
  replay.open(DATA.episodes[episode]);
  if (Number(wanted.get("step")) >= 1) replay.go(Math.floor(Number(wanted.get("step"))));
}

head();
document.getElementById("main").append(replaySection(), earnings(),
  ...(DATA.worth ? [worthSection(DATA.worth)] : []),
  ...(DATA.faults ? [faultsSection(DATA.faults)] : []),
  ...(DATA.comparison ? [comparisonSection(DATA.comparison)] : []),
  ...(DATA.curves ? [section("progress", "How it was found", ...progress(DATA.curves))] : []),
  specText(), repeat());
document.getElementById("foot").append(element("p", { class: "note" }, `bbsd ${DATA.version}. This file is whole: it needs no other file and no network.`));
begin(new URLSearchParams(location.hash.slice(1)));
