"""Small pictures made of characters."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Sequence

LEVELS = "▁▂▃▄▅▆▇█"
EIGHTHS = ("", "▏", "▎", "▍", "▌", "▋", "▊", "▉")


def sparkline(values: Sequence[float], width: int) -> str:
    """Return a curve of at most `width` characters.

    Where there are more values, each character stands for the mean of several. What is not finite is left
    out; a constant curve is drawn halfway up.
    """
    known = [value for value in values if isfinite(value)]
    size = min(width, len(known))
    means = [
        _mean(known[len(known) * place // size : len(known) * (place + 1) // size]) for place in range(size)
    ]
    low, high = min(means, default=0.0), max(means, default=0.0)
    return "".join(LEVELS[_level(mean, low, high)] for mean in means)


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)


def _level(value: float, low: float, high: float) -> int:
    if low == high:
        return len(LEVELS) // 2
    return round((value - low) / (high - low) * (len(LEVELS) - 1))


def bar(share: float, width: int, *, blocks: bool = True) -> str:
    """Return a bar as long as the share of `width` characters, in eighths; without blocks in ASCII."""
    if not share > 0:
        return ""
    eighths = round(min(share, 1.0) * width * 8)
    if not blocks:
        return "#" * max(1, round(eighths / 8))
    return "█" * (eighths // 8) + EIGHTHS[max(eighths, 1) % 8]
