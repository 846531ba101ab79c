"""The content of a page as plain data, which its script reads."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import escape
from bbsd.report.comparison import comparison_plain
from bbsd.report.faults import faults_plain
from bbsd.report.page.behaviors import behaviors_plain, commands_plain, inputs_plain
from bbsd.report.page.episodes import episode_plain
from bbsd.report.page.origin import repeat_plain, spec_plain
from bbsd.report.page.progress import curves_plain
from bbsd.report.page.returns import earns_plain, histogram_plain
from bbsd.report.worth import worth_plain
from bbsd.version import __version__

if TYPE_CHECKING:
    from bbsd.api.paging import Page
    from bbsd.report.plain import Plain


def page_plain(page: Page, most_steps: int) -> dict[str, Plain]:
    """Return all that a page shows; its replays have at most so many steps."""
    spec = page.loaded.spec
    order = [*spec.behaviors]
    return {
        "name": spec.name,
        "summary": None if spec.summary is None else escape(" ".join(spec.summary.split())),
        "version": __version__,
        "robots": spec.environment.robots,
        "earns": earns_plain(page),
        "returns": histogram_plain(page.returns),
        "behaviors": behaviors_plain(page),
        "whole": [
            {name: getattr(row, name) for name in ("layer", "behavior", "decision", "where", "excited")}
            for row in sorted(page.explanation.rows, key=lambda row: -row.layer)
        ],
        "useless": [
            {"kind": f"useless {each.kind}", "text": f"{each.what} of {each.behavior}: {each.why}"}
            for each in page.explanation.useless
            if each.kind == "input"
        ],
        "layers": [order.index(layer.behavior) for layer in page.explanation.layers],
        "left_out": [*page.explanation.left_out],
        "inputs": inputs_plain(page),
        "commands": commands_plain(page),
        "episodes": [episode_plain(replay, page.loaded.meaning, most_steps) for replay in page.replays],
        "notes": _notes(page, most_steps),
        "worth": None if page.worth is None else worth_plain(page.worth),
        "faults": faults_plain(page.faults),
        "comparison": _comparison_plain(page),
        "curves": curves_plain(page.run.metrics) if page.run else None,
        "spec": spec_plain(page),
        "repeat": repeat_plain(page),
    }


def _comparison_plain(page: Page) -> Plain:
    if page.comparison is None:
        return None
    a, b = page.name, page.other
    plain = comparison_plain(page.comparison)
    return {**plain, "a": f"{a} (A)" if a == b else a, "b": f"{b} (B)" if a == b else b}


def _notes(page: Page, most_steps: int) -> list[Plain]:
    longest = max(len(replay.trace.steps) for replay in page.replays)
    if longest <= most_steps:
        return []
    return [f"To keep the page small, the replays have the first {most_steps:,} of up to {longest:,} steps."]
