"""A list of runs with their states: a line for each, or plain data."""

from __future__ import annotations

import time
from math import isnan
from typing import TYPE_CHECKING

from bbsd.errors import escape
from bbsd.report.plain import finite_or_none
from bbsd.report.wording.endings import ending_lines
from bbsd.report.wording.numbers import column

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.report.plain import Plain
    from bbsd.runs.storage.listing import Listed

HEADINGS = ("run", "state", "method", "seed", "done", "mean return", "last written")
RIGHT = ("seed", "done", "mean return")
GAP = "  "


def listing_text(runs: Sequence[Listed]) -> str:
    """Return a line for each run, below headings; what else there is to say of one stands in a line below it."""
    if not runs:
        return ""
    returns = _returns(runs)
    rows = [HEADINGS, *(_row(run, each) for run, each in zip(runs, returns, strict=True))]
    widths = [max(map(len, texts)) for texts in zip(*rows, strict=True)]
    lines = [_aligned(HEADINGS, widths)]
    for run, row in zip(runs, rows[1:], strict=True):
        lines.append(_aligned(row, widths))
        if notes := _notes(run):
            lines.append(f"{GAP * 2}{notes}")
    return "\n".join(lines)


def listing_plain(runs: Sequence[Listed]) -> list[Plain]:
    """Return the same as plain data; what is not known is null."""
    return [_plain(run) for run in runs]


def _plain(run: Listed) -> dict[str, Plain]:
    mean, low, high, best = map(finite_or_none, (run.mean, run.low, run.high, run.best))
    return {
        "folder": str(run.folder),
        "state": run.state,
        "detail": run.detail,
        "other_version": run.version or None,
        "method": run.method or None,
        "seed": run.seed,
        "runs": run.runs,
        _unit(run): run.done,
        "budget": run.budget or None,
        "return": None if mean is None else {"mean": mean, "ci95": [low, high]},
        "best_so_far": best,
        **({"ended": list(run.ended)} if run.ended else {}),
        "written": time.strftime("%Y-%m-%dT%H:%M:%SZ", time.gmtime(run.written)) if run.written else None,
    }


def _row(run: Listed, returns: str) -> tuple[str, ...]:
    method = f"{escape(run.method)}{f', {run.runs} runs' if run.runs > 1 else ''}"
    seed = "" if run.seed is None else str(run.seed)
    written = time.strftime("%Y-%m-%d %H:%M", time.localtime(run.written)) if run.written else ""
    return escape(str(run.folder)), run.state, method, seed, _done(run), returns, written


def _done(run: Listed) -> str:
    if not run.done:
        return ""
    whole = run.state == "finished" or run.budget < run.done
    return f"{run.done:,}{'' if whole else f' of {run.budget:,}'} {_unit(run)}"


def _unit(run: Listed) -> str:
    return "generations" if run.has_generations else "episodes"


def _returns(runs: Sequence[Listed]) -> list[str]:
    """Return the mean returns of answers, or the best so far, all with the same decimals."""
    values = [run.best if isnan(run.mean) else run.mean for run in runs]
    texts = column(values)
    return [
        "" if isnan(value) else f"{text} so far" if isnan(run.mean) else text
        for run, value, text in zip(runs, values, texts, strict=True)
    ]


def _notes(run: Listed) -> str:
    written_by = f"by {run.version}" if run.version else ""
    early = ending_lines(run.ended, run.runs)
    return escape("; ".join(note for note in (run.detail, *early, written_by) if note))


def _aligned(row: Sequence[str], widths: Sequence[int]) -> str:
    texts = [
        text.rjust(width) if heading in RIGHT else text.ljust(width)
        for heading, text, width in zip(HEADINGS, row, widths, strict=True)
    ]
    return GAP.join(texts).rstrip()
