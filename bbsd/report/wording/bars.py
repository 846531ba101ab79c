"""Bars and curves made of characters."""

from __future__ import annotations

from itertools import pairwise
from math import isfinite
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

LEVELS = "▁▂▃▄▅▆▇█"
EIGHTHS = ("", "▏", "▎", "▍", "▌", "▋", "▊", "▉")


def sparkline(values: Sequence[float], width: int) -> str:
    """Return a curve of at most `width` characters.

    If there are more values, each character stands for the mean of several. Values that are not finite are
    left out; a constant curve is drawn at half height.
    """
    numbers = [value for value in values if isfinite(value)]
    size = min(width, len(numbers))
    bounds = [len(numbers) * index // size for index in range(size + 1)] if size else []
    means = [_mean(numbers[begin:end]) for begin, end in pairwise(bounds)]
    low, high = min(means, default=0.0), max(means, default=0.0)
    return "".join(LEVELS[_level(mean, low, high)] for mean in means)


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)


def _level(value: float, low: float, high: float) -> int:
    if low == high:
        return len(LEVELS) // 2
    return round((value - low) / (high - low) * (len(LEVELS) - 1))


def bar(share: float, width: int, *, blocks: bool = True) -> str:
    """Return a bar whose length is a share of `width` characters, in eighths; without `blocks` in ASCII."""
    if not share > 0:
        return ""
    eighths = round(min(share, 1.0) * width * 8)
    if not blocks:
        return "#" * max(1, round(eighths / 8))
    return "█" * (eighths // 8) + EIGHTHS[max(eighths, 1) % 8]
