"""A run that goes on as a page, which looks again every second until the run is done."""

from __future__ import annotations

from base64 import b64encode
from hashlib import sha256
from html import escape as escape_html
from typing import TYPE_CHECKING

from bbsd.errors import escape
from bbsd.report.watching.words import fitness_text, position_text, share_done, state_line, who_text
from bbsd.report.wording.numbers import column

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.runs.storage.watching import Line, Watched, WatchedRun

WIDTH, HEIGHT, MARGIN = 640, 240, 8
"""Of the curves, in units of the drawing, which is as wide as the page at most."""
DASHES = ("none", "6 3", "2 3", "8 3 2 3", "12 4", "4 6")
"""Runs differ by the dashes of their lines, and by color."""
COLORS = 6

STYLE = """
:root { color-scheme: light dark; --c0: light-dark(#0b5394, #7ab8f5); --c1: light-dark(#a64d00, #ffb066);
  --c2: light-dark(#1b7a3d, #7ddb9b); --c3: light-dark(#8e1b6f, #f09ad8); --c4: light-dark(#5a3fb0, #b9a6ff);
  --c5: light-dark(#4d4d4d, #c8c8c8); }
body { font: 1rem/1.5 system-ui, sans-serif; margin: 0 auto; padding: 1rem; max-width: 44rem; }
h1 { font-size: 1.25rem; overflow-wrap: anywhere; }
progress { width: 100%; height: 0.75rem; }
h2 { font-size: 1rem; margin: 0; }
svg { width: 100%; height: auto; }
svg.key { width: 5rem; height: 0.5rem; margin-inline-end: 0.5rem; }
polyline { fill: none; stroke-width: 2; }
section { margin-block: 1rem; }
p { margin: 0.125rem 0; overflow-wrap: anywhere; }
.scroll { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { padding: 0 1rem 0 0; text-align: right; }
.c0 { stroke: var(--c0); } .c1 { stroke: var(--c1); } .c2 { stroke: var(--c2); }
.c3 { stroke: var(--c3); } .c4 { stroke: var(--c4); } .c5 { stroke: var(--c5); }
"""
SCRIPT = """
setInterval(async () => {
  try {
    const text = await (await fetch("/")).text();
    // The page on the whole design has a policy of its own, under which this one must not even read it.
    if (!text.includes("<main data-watched=")) return location.reload();
    const now = new DOMParser().parseFromString(text, "text/html").querySelector("main");
    const before = document.querySelector("main");
    if (now.dataset.watched === before.dataset.watched) return;
    const open = new Set([...before.querySelectorAll("details[open]")].map((each) => each.id));
    now.querySelectorAll("details").forEach((each) => { each.open = open.has(each.id); });
    before.replaceWith(document.adoptNode(now));
  } catch { /* whoever served this has ended; what was seen last stays */ }
}, 1000);
"""


def live_page(now: Watched, generations: int = 0) -> str:
    """Return a page of HTML on how far all runs are; a name in it is never more than a text."""
    heading = state_line(now)
    runs = "".join(_run(index, run, now, generations) for index, run in enumerate(now.runs))
    curves = _curves(now) if any(len(run.lines) > 1 for run in now.runs) else ""
    changed = sha256(repr((heading, now.runs)).encode("utf-8", "replace")).hexdigest()[:16]
    policy = (
        f"default-src 'none'; script-src {_hash(SCRIPT)}; style-src {_hash(STYLE)}; connect-src 'self'; "
        "img-src data:; base-uri 'none'; form-action 'none'"
    )
    return (
        '<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8">'
        f'<meta http-equiv="Content-Security-Policy" content="{policy}">'
        '<meta name="viewport" content="width=device-width, initial-scale=1"><link rel="icon" href="data:,">'
        f"<title>{_text(str(now.folder))}</title><style>{STYLE}</style></head>\n"
        f'<body><main data-watched="{changed}"><h1>{_text(heading)}</h1>{runs}{curves}</main>'
        f"<script>{SCRIPT}</script></body></html>\n"
    )


def _hash(text: str) -> str:
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"


def _text(text: str) -> str:
    return escape_html(escape(text))


def _run(index: int, run: WatchedRun, now: Watched, generations: int) -> str:
    line, name = run.lines[-1], who_text(run, now).removesuffix(", ") or "the run"
    share = f"{share_done(line, now, generations):.4f}"
    structure = " ".join(map(str, line["structure"]))
    return (
        f'<section aria-labelledby="run-{index}"><h2 id="run-{index}">{_text(name)}</h2>'
        f'<progress value="{share}" aria-label="done"></progress>'
        f"<p>{_text(position_text(line, now, generations))}</p><p>{_text(fitness_text(line))}</p>"
        f"<p>{_text(structure)}</p></section>"
    )


def _curves(now: Watched) -> str:
    """Return a curve of the mean of each run, and the numbers as a table that opens below."""
    xs = [_step(line) for run in now.runs for line in run.lines]
    means = [float(line["mean"]) for run in now.runs for line in run.lines]
    low, high = min(means), max(means)
    lines = "".join(
        f'<polyline class="c{index % COLORS}" stroke-dasharray="{DASHES[index % len(DASHES)]}" '
        f'points="{_points(run.lines, max(xs), low, high)}"/>'
        for index, run in enumerate(now.runs)
    )
    bottom, top = column([low, high])
    names = [who_text(run, now).removesuffix(", ") or "the run" for run in now.runs]
    legend = "".join(
        f'<p><svg class="key" viewBox="0 0 80 8" aria-hidden="true"><polyline class="c{index % COLORS}" '
        f'stroke-dasharray="{DASHES[index % len(DASHES)]}" points="0,4 80,4"/></svg>{_text(name)}</p>'
        for index, name in enumerate(names)
    )
    return (
        f'<section aria-labelledby="curve"><h2 id="curve">mean, from {bottom} to {top}, over {max(xs):,} '
        f"{_unit(now)}</h2>"
        f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="the mean of each run so far">{lines}</svg>'
        f"{legend if len(names) > 1 else ''}{_numbers(now, names)}</section>"
    )


def _step(line: Line) -> int:
    return int(line["generation"] if "generation" in line else line.get("episodes", 0))


def _unit(now: Watched) -> str:
    has_generations = any("generation" in line for run in now.runs for line in run.lines)
    return "generations" if has_generations else "episodes"


def _points(lines: Sequence[Line], last: int, low: float, high: float) -> str:
    def place(line: Line) -> str:
        x = MARGIN + _step(line) / max(1, last) * (WIDTH - 2 * MARGIN)
        y = (float(line["mean"]) - low) / (high - low) if high > low else 0.5
        return f"{x:.1f},{HEIGHT - MARGIN - y * (HEIGHT - 2 * MARGIN):.1f}"

    return " ".join(map(place, lines))


def _numbers(now: Watched, names: Sequence[str]) -> str:
    rows = "".join(
        f"<tr><td>{_text(name)}</td><td>{_step(line):,}</td><td>{float(line['mean']):.6g}</td></tr>"
        for name, run in zip(names, now.runs, strict=True)
        for line in run.lines
    )
    head = f'<tr><th scope="col">run</th><th scope="col">{_unit(now)}</th><th scope="col">mean</th></tr>'
    return (
        f'<details id="numbers"><summary>The numbers</summary><div class="scroll" tabindex="0"><table>'
        f"<thead>{head}</thead><tbody>{rows}</tbody></table></div></details>"
    )
