// Elements of the page. Whatever comes from a spec goes in as text, never as HTML.

function element(tag, properties = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(properties)) {
    if (name === "class") made.className = value;
    else if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value !== null && value !== undefined && value !== false) made.setAttribute(name, value === true ? "" : value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

function drawn(tag, attributes = {}, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}

// A section with a heading, announced by its name.
function section(id, title, ...children) {
  return element("section", { id, "aria-labelledby": `${id}-title` }, element("h2", { id: `${id}-title` }, title), ...children);
}

// A table whose first column names its rows; cells are texts, numbers or elements.
function table(caption, headings, rows, { left = [0] } = {}) {
  const kind = (index, cell) => (!left.includes(index) ? "number" : String(cell).length > 40 ? "long" : "");
  const head = headings.map((text, index) => element("th", { scope: "col", class: kind(index, "") }, text));
  const body = rows.map((row) =>
    element("tr", {}, ...row.map((cell, index) =>
      element(index ? "td" : "th", { class: kind(index, cell), scope: index ? null : "row" }, cell instanceof Node ? cell : String(cell)))));
  const made = element("table", {}, element("caption", {}, caption), element("thead", {}, element("tr", {}, ...head)), element("tbody", {}, ...body));
  return scrolling(made, caption);
}

// What may be wider than a phone scrolls by itself, also by keyboard.
function scrolling(child, name) {
  return element("div", { class: "scrolling", tabindex: "0", role: "group", "aria-label": name }, child);
}

// A table that is made when it is opened.
function behind(summary, make) {
  const details = element("details", { class: "behind" }, element("summary", {}, summary));
  details.addEventListener("toggle", () => {
    if (details.open && details.childElementCount === 1) details.append(make());
  });
  return details;
}

// Radio buttons in a row; `options` are [value, label, ...further elements].
function choice(name, legend, options, chosen, change) {
  const buttons = options.map(([value, ...label]) => {
    const input = element("input", { type: "radio", name, value, onchange: () => change(value) });
    input.checked = value === chosen;
    return element("label", {}, input, element("span", {}, ...label));
  });
  return element("fieldset", { class: "choice" }, element("legend", {}, legend), ...buttons);
}

function number(value, digits = 4) {
  if (value === null || value === undefined) return "not finite";
  if (typeof value !== "number") return String(value);
  const size = Math.abs(value);
  if (Number.isInteger(value) && size < 1e6) return minus(value.toLocaleString("en-US"));
  if (size >= 1e6 || (size && size < 1e-4)) return minus(value.toExponential(2));
  return minus(size >= 100 ? value.toFixed(Math.max(1, digits - 3)) : value.toPrecision(digits).replace(/(\.\d*?)0+$/, "$1").replace(/\.$/, ""));
}

const minus = (text) => text.replace("-", "\u2212");
const percent = (share) => (share === null ? "never" : share > 0 && share < 0.0005 ? "< 0.1 %" : `${(100 * share).toFixed(1)} %`);
const counted = (count, noun) => `${count.toLocaleString("en-US")} ${noun}${count === 1 ? "" : "s"}`;

function theme(name) {
  return getComputedStyle(document.documentElement).getPropertyValue(`--${name}`).trim();
}

// Draw on a canvas in CSS pixels, as sharp as the screen.
function canvasOf(canvas, width, height) {
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  canvas.style.width = `${width}px`;
  canvas.style.height = `${height}px`;
  const pen = canvas.getContext("2d");
  pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  pen.clearRect(0, 0, width, height);
  return pen;
}

// Draw again whenever the width or the theme changes.
function redrawn(container, draw) {
  let width = 0;
  new ResizeObserver(() => {
    if (container.clientWidth && container.clientWidth !== width) {
      width = container.clientWidth;
      draw(width);
    }
  }).observe(container);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => width && draw(width));
}
