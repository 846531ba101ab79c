"""The document of a page: one file with its styles, scripts and data, which may load nothing else."""

from __future__ import annotations

import json
import re
from base64 import b64encode
from hashlib import sha256
from html import escape as escape_html
from importlib.resources import files
from string import Template
from typing import TYPE_CHECKING

from bbsd.errors import escape, inert
from bbsd.report.page.content import page_plain

if TYPE_CHECKING:
    from bbsd.api.paging import Page
    from bbsd.report.plain import Plain

MODULES = (
    "elements.js",
    "columns.js",
    "palette.js",
    "why.js",
    "replay.js",
    "architecture.js",
    "bands.js",
    "scene.js",
    "charts.js",
    "worth.js",
    "comparison.js",
    "page.js",
)
"""The parts of the page's script, in this order."""
START = """"use strict";
(() => {
const DATA = JSON.parse(document.getElementById("data").textContent);
"""
END = "})();\n"
UPLOT = "uplot-1.6.32"
"""The folder of the charts' library, with its license."""
MOST_BYTES = 1_900_000
"""The size of a page at most; longer replays are cut."""
UNSAFE = re.compile("[<>&\u2028\u2029]")


def page_text(page: Page) -> str:
    """Return the page as HTML, below 2 MB; the same page gives the same text."""
    most_steps = max(len(replay.trace.steps) for replay in page.replays)
    text = _document(page_plain(page, most_steps))
    while len(text) > MOST_BYTES and most_steps > 1:
        most_steps = max(1, min(most_steps - 1, int(0.9 * most_steps * MOST_BYTES / len(text))))
        text = _document(page_plain(page, most_steps))
    return text


def _document(content: dict[str, Plain]) -> str:
    charts, charts_style = _part(UPLOT, "uPlot.iife.min.js"), _part(UPLOT, "uPlot.min.css")
    style = _part("templates", "style.css")
    script = START + "\n".join(_part("templates", name) for name in MODULES) + END
    return Template(_part("templates", "page.html")).substitute(
        policy=_policy([charts, script], [style, charts_style]),
        title=escape_html(escape(f"{content['name']}: a design by bbsd")),
        style=style,
        charts_style=charts_style,
        data=json_in_html(content),
        charts=charts,
        script=script,
    )


def json_in_html(content: Plain) -> str:
    """Return plain data as JSON in ASCII that can stand in a script element: no markup begins or ends in it."""
    text = json.dumps(_inert(content), allow_nan=False, separators=(",", ":"))
    return UNSAFE.sub(lambda found: f"\\u{ord(found[0]):04x}", text)


def _inert(content: Plain) -> Plain:
    """Return plain data of which no text has characters that steer or hide, as escapes can show them."""
    match content:
        case str():
            return inert(content, commands=True)
        case dict():
            return {inert(key, commands=True): _inert(value) for key, value in content.items()}
        case list() | tuple():
            return [_inert(value) for value in content]
    return content


def _policy(scripts: list[str], styles: list[str]) -> str:
    """Return a content security policy that allows these scripts and styles, and nothing else."""
    return "; ".join(
        [
            "default-src 'none'",
            f"script-src {' '.join(map(_hash, scripts))}",
            f"style-src {' '.join(map(_hash, styles))}",
            "img-src data:",
            "base-uri 'none'",
            "form-action 'none'",
        ]
    )


def _hash(text: str) -> str:
    return f"'sha256-{b64encode(sha256(text.encode()).digest()).decode()}'"


def _part(*names: str) -> str:
    return files("bbsd.report.page").joinpath(*names).read_text(encoding="utf-8")
