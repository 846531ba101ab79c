"""The cells that a word of a rule names, and those that it probably means."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.errors import nearest

if TYPE_CHECKING:
    from bbsd.language.meaning.tables.labels import Labels

OTHER_TRUTHS = {"yes": "true", "on": "true", "1": "true", "no": "false", "off": "false", "0": "false"}
RANGE = re.compile(r"below (?P<below>.+)|from (?P<from>.+)|(?P<low>.+?) to (?P<high>.+)")


def cells_named(word: str, cells: Labels) -> range | None:
    """Return the cells that a word names: one, or a range of the cells of a cut."""
    if word in cells:
        return range(cells.index(word), cells.index(word) + 1)
    bounds = bounds_of(cells)
    match = RANGE.fullmatch(word)
    if bounds is None or match is None:
        return None
    low = match["from"] or match["low"]
    high = match["below"] or match["high"]
    if not {low, high} <= {None, *bounds}:
        return None
    first = bounds.index(low) + 1 if low else 0
    last = bounds.index(high) + 1 if high else len(cells)
    return range(first, last) if first < last else None


def bounds_of(cells: Labels) -> list[str] | None:
    """Return the bounds of a cut, read off its cells; None for cells of another partition."""
    if not (len(cells) >= 2 and cells[0].startswith("below ") and cells[-1].startswith("from ")):
        return None
    return [cells[0].removeprefix("below "), *(cell.split(" to ", 1)[1] for cell in cells[1:-1])]


NUMBER = r"[-+]?[\w.]+(?: ?[-+*/] ?[\w.]+)*"
PLAIN, UP_TO = r"[-+]?[\w.]*\w", r"(?:\.\.\.?|,|-|–|to|until|and)"
OTHER_RANGES = (
    (rf"(?:<|below|under|less than|smaller than|up to|until)\s*(?P<high>{NUMBER})", True),
    (rf"(?:<=|at most)\s*(?P<high>{NUMBER})", False),
    (rf"(?:>=|from|at least|≥)\s*(?P<low>{NUMBER})", True),
    (rf"(?:>|above|over|more than|greater than|beyond)\s*(?P<low>{NUMBER})", False),
    (rf"(?:between )?[\[(]?(?P<low>{PLAIN})\s*{UP_TO}\s*(?P<high>{PLAIN})[\])]?", True),
    (rf"(?P<low>{NUMBER})\s*<=?\s*\w+\s*<=?\s*(?P<high>{NUMBER})", True),
)
"""Ranges as they are written elsewhere, and whether the one that is meant is certain. Only mistakes compile them."""


def meant_cell(word: str, cells: Labels) -> tuple[str, bool]:
    """Return the cell or range that a word means which names none, '' if it is not known, and whether it is certain."""
    if (truth := OTHER_TRUTHS.get(word.lower(), "")) in cells:
        return truth, True
    bounds = bounds_of(cells)
    for pattern, is_certain in OTHER_RANGES if bounds else ():
        if match := re.fullmatch(pattern, word):
            parts = match.groupdict()
            low, high = (_bound(parts.get(side), bounds or []) for side in ("low", "high"))
            found = _range(low, high)
            if cells_named(found, cells) is not None:
                is_given = all(part in (None, low, high) for part in parts.values())
                return found, is_certain and is_given
    if bounds and (cell := _cell_of(word, bounds, cells)):
        return cell, False
    return nearest(word, cells), False


def _cell_of(word: str, bounds: list[str], cells: Labels) -> str:
    """Return the cell in which a number lies, '' for other words."""
    try:
        number, numbers = float(word), [float(bound) for bound in bounds]
    except ValueError:
        return ""
    return cells[sum(bound <= number for bound in numbers)]


def _range(low: str | None, high: str | None) -> str:
    if low is not None and high is not None:
        return f"{low} to {high}"
    return f"below {high}" if high is not None else f"from {low}"


def _bound(text: str | None, bounds: list[str]) -> str | None:
    """Return the bound that a text means: itself, the same number, or the nearest one."""
    if text is None or text in bounds:
        return text
    try:
        number, numbers = float(text), [float(bound) for bound in bounds]
    except ValueError:
        return text
    # Of two that are as near, the larger one, as it is listed behind.
    return min(reversed(list(zip(bounds, numbers, strict=True))), key=lambda pair: abs(pair[1] - number))[0]
