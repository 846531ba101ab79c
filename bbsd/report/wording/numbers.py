"""Numbers, shares and durations as texts for people."""

from __future__ import annotations

from math import isfinite, isnan
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.evaluation import Interval

DIGITS = 5
"""The number of significant digits of the largest number in a column."""


def number(value: float) -> str:
    """Return a number with five significant digits."""
    return column([value])[0]


def column(values: Sequence[float]) -> list[str]:
    """Return numbers for a column: all with as many decimals as the largest has with five significant digits."""
    largest = max((abs(value) for value in values if isfinite(value)), default=0.0)
    if largest and not 1e-3 <= largest < 1e9:
        return [_special(value) or f"{value:.{DIGITS - 1}e}" for value in values]
    whole_digits = len(str(int(largest)))
    decimals = max(0, DIGITS - whole_digits)
    return [_special(value) or f"{round(value, decimals) + 0.0:.{decimals}f}" for value in values]


def changes(values: Sequence[float]) -> list[str]:
    """Return differences for a column, as `column` does, with a sign where they are not 0."""
    texts = column(values)
    return [
        f"+{text}" if value > 0 and (not isfinite(value) or float(text)) else text
        for value, text in zip(values, texts, strict=True)
    ]


def with_halves(intervals: Sequence[Interval], *, signed: bool = True) -> list[str]:
    """Return means with half their intervals, such as `-549.08 ±1.12`, all with the same decimals.

    Where rewards were not finite there is no mean.
    """
    means = (changes if signed else column)([each.mean for each in intervals])
    decimals = max((len(text.partition(".")[2]) for text in means), default=0)
    halves = [f"{each.high - each.mean:.{decimals}f}" for each in intervals]
    width = max(map(len, halves), default=0)
    return [
        "not finite" if isnan(each.mean) else f"{text} ±{half:<{width}}"
        for each, text, half in zip(intervals, means, halves, strict=True)
    ]


def _special(value: float) -> str:
    if isfinite(value):
        return ""
    return "unknown" if isnan(value) else "infinite" if value > 0 else "-infinite"


def percent(share: float) -> str:
    """Return a share in percent with one decimal."""
    return "unknown" if isnan(share) else f"{100 * share:.1f} %"


def duration(seconds: float) -> str:
    """Return a duration in words: `8.1 s`, `3 min 5 s`, `2 h 10 min`."""
    if seconds < 60:
        return f"{seconds:.1f} s"
    minutes, rest = divmod(round(seconds), 60)
    if minutes < 60:
        return f"{minutes} min {rest} s"
    return f"{minutes // 60} h {minutes % 60} min"


def count(number_of: int, noun: str, plural: str = "") -> str:
    """Return a number with the noun for what is counted: `1 behavior`, `5,000 behaviors`."""
    return f"{number_of:,} {noun if number_of == 1 else plural or noun + 's'}"
