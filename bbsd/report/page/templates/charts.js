// Charts by uPlot, in the colors of the theme, drawn anew when that or the width changes.

const LINE_DASHES = [[], [7, 4], [2, 3], [9, 3, 2, 3], [4, 4], [12, 4], [1, 3], [6, 2, 1, 2]];
const GRADES = (index) => theme(`module-${index % COLORS}`);

function axisStyle(more = {}) {
  return { stroke: theme("faint"), grid: { stroke: theme("line"), width: 1 }, ticks: { stroke: theme("line"), width: 1, size: 4 }, font: `12px ${theme("font")}`, labelFont: `12px ${theme("font")}`, labelSize: 18, size: 28, ...more };
}

// `options()` and `data` as uPlot has them; `made` is told of each new chart.
function chart(name, options, data, { height = 200, made = () => {} } = {}) {
  const box = element("div", { class: "chart", role: "img", "aria-label": name });
  let plot = null;
  redrawn(box, (width) => {
    plot?.destroy();
    plot = new uPlot({ width, height, cursor: { y: false, drag: { x: false, y: false } }, legend: { show: false }, ...options() }, data, box);
    made(plot);
  });
  return box;
}

function key(entries) {
  return element("ul", { class: "key" }, ...entries.map(([text, index, dashed]) => {
    const stroke = drawn("line", { x1: 0, y1: 5, x2: 26, y2: 5, "stroke-width": 2.5, "stroke-dasharray": (dashed ?? []).join(" "), class: `stroke-${index}` });
    return element("li", {}, drawn("svg", { width: 26, height: 10, "aria-hidden": "true" }, stroke), text);
  }));
}

// The values of an episode over its steps: a chart for each name, a line for each robot.
const BESIDE = 4, MOST_CHARTS = 24;

function valueCharts(first, last) {
  const box = element("div", { class: "values" });
  const plots = new Set();
  const place = (plot) => {
    if (plot.root.isConnected) plot.setCursor({ left: plot.valToPos(replay.step, "x"), top: -10 }, false);
    else plots.delete(plot);
  };
  const draw = () => {
    plots.clear();
    const groups = new Map();
    for (const each of replay.episode.values) {
      if (each.column.some((value) => typeof value === "number")) groups.set(each.name, [...(groups.get(each.name) ?? []), each]);
    }
    const shown = [...groups].slice(first, last);
    const left = last === MOST_CHARTS ? groups.size - first - shown.length : 0;
    const labels = new Set(); // a key for each set of lines, once
    box.replaceChildren(...shown.map(([title, each]) => valueChart(title, each, isNew(labels, each), (plot) => { plots.add(plot); place(plot); })),
      left ? element("p", { class: "note" }, `${counted(left, "further value")} in the table of this step`) : "");
  };
  replay.listen((what) => {
    if (what === "episode") draw();
    else plots.forEach(place);
  });
  return box;
}

function isNew(labels, each) {
  const text = each.map((one) => one.label).join();
  return each.length > 1 && !labels.has(text) && labels.add(text);
}

function valueChart(title, each, hasKey, made) {
  const steps = each[0].column.map((_, step) => step);
  const isStepped = each.every((one) => one.column.every((value) => value === null || Number.isInteger(value)));
  const paths = isStepped ? uPlot.paths.stepped({ align: -1 }) : undefined;
  const options = () => ({
    scales: { x: { time: false } },
    axes: [axisStyle(), axisStyle({ size: 56 })],
    series: [{}, ...each.map((one, index) => ({ label: one.label, stroke: each.length > 1 ? GRADES(index) : theme("ink"), dash: LINE_DASHES[index % LINE_DASHES.length], width: 1.5, paths, points: { show: false } }))],
    cursor: { y: false, drag: { x: false, y: false }, bind: { mousemove: () => null, mouseleave: () => null, mousedown: () => null, mouseup: () => null, dblclick: () => null } },
  });
  const ready = (plot) => {
    follow(plot.over, (event) => Math.round(plot.posToVal(event.clientX - plot.over.getBoundingClientRect().left, "x")));
    made(plot);
  };
  const box = chart(`${title} over the steps; the values of a step are in the table of this step`, options, [steps, ...each.map((one) => one.column)], { height: 120, made: ready });
  return element("figure", {}, element("figcaption", {}, title), box, hasKey ? key(each.map((one, index) => [one.label, index % COLORS, LINE_DASHES[index % LINE_DASHES.length]])) : "");
}

// Returns by how often they occur.
function distribution(returns) {
  const { edges, counts } = returns;
  const middles = counts.map((_, index) => (edges[index] + edges[index + 1]) / 2);
  const options = () => ({
    scales: { x: { time: false, range: () => [edges[0], edges[edges.length - 1]] }, y: { range: (_, low, high) => [0, high * 1.05 || 1] } },
    axes: [axisStyle({ label: "return of an episode" }), axisStyle({ label: "episodes", size: 56 })],
    series: [{}, { stroke: theme("module-0"), fill: theme("module-0"), width: 0, paths: uPlot.paths.bars({ size: [0.92, Infinity] }), points: { show: false } }],
  });
  const rows = counts.map((count, index) => [`${number(edges[index])} to ${number(edges[index + 1])}`, count]);
  return [chart("How the returns are distributed; the table below says the same", options, [middles, counts], { height: 200 }),
    behind("Table: returns by how often they occur", () => table("Episodes by their return", ["return", "episodes"], rows))];
}

// The mean of all runs over what they took, with the spread from the lowest run to the highest.
function progress(curves) {
  const { x, label, runs, lines: drawnLines } = curves;
  const columns = drawnLines.flatMap((line) => [line.mean, ...(runs > 1 ? [line.low, line.high] : [])]);
  const width = runs > 1 ? 3 : 1;
  const options = () => ({
    scales: { x: { time: false } },
    axes: [axisStyle({ label }), axisStyle({ label: curves.of, size: 64 })],
    series: [{}, ...drawnLines.flatMap((line, index) => [
      { stroke: GRADES(index), width: 2, dash: LINE_DASHES[index], points: { show: x.length < 40 } },
      ...(runs > 1 ? [0, 1].map(() => ({ stroke: GRADES(index), width: 0.5, points: { show: false } })) : []),
    ])],
    bands: runs > 1 ? drawnLines.map((_, index) => ({ series: [width * index + 3, width * index + 2], fill: `${GRADES(index)}33` })) : [],
  });
  const headings = drawnLines.flatMap((line) => [line.name, ...(runs > 1 ? ["lowest run", "highest run"] : [])]);
  const rows = x.map((at, place) => [number(at), ...columns.map((column) => (column[place] === null ? "" : number(column[place])))]);
  return [chart(`${curves.of} over ${label}; the table below says the same`, options, [x, ...columns], { height: 240 }),
    key(drawnLines.map((line, index) => [line.name, index, LINE_DASHES[index]])),
    runs > 1 ? element("p", { class: "note" }, `Lines are means of ${runs} runs; the shaded bands reach from the lowest run to the highest.`) : "",
    behind(`Table: ${curves.of}`, () => table(curves.of, [label, ...headings], rows))];
}

// Estimates with their intervals on a common scale, as dots and whiskers beside their numbers.
function estimates(caption, headings, rows) {
  const all = rows.flatMap((row) => [row.low, row.high, row.value]).filter((value) => Number.isFinite(value));
  const low = Math.min(0, ...all), high = Math.max(0, ...all), span = high - low || 1;
  const x = (value) => 4 + (192 * (value - low)) / span;
  const picture = (row) => {
    if (!finite(row.value, row.low, row.high)) return "";
    return drawn("svg", { width: 200, height: 18, viewBox: "0 0 200 18", "aria-hidden": "true", class: "whiskers" },
      drawn("line", { x1: x(0), x2: x(0), y1: 0, y2: 18, class: "zero" }),
      drawn("line", { x1: x(row.low), x2: x(row.high), y1: 9, y2: 9, class: "whisker" }),
      drawn("circle", { cx: x(row.value), cy: 9, r: 4, class: "dot" }));
  };
  return table(caption, [...headings, "interval"], rows.map((row) => [...row.cells, picture(row)]), { left: [0, headings.length] });
}
