"""The columns of an episode as the page holds them: in stretches of equal values where that is shorter."""

from __future__ import annotations

from itertools import groupby
from math import isfinite
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bbsd.report.plain import Plain

DIGITS = 6
"""Significant digits of numbers."""


def packed(values: Iterable[float | str | bool | None]) -> dict[str, Plain]:
    """Return a column as `v`, its values, or `r`, values and lengths of stretches; texts as places in words `w`."""
    column = [_shortened(value) for value in values]
    if any(isinstance(value, str) for value in column):
        words = list(dict.fromkeys(column))
        return {**_numbers([words.index(value) for value in column]), "w": words}
    return _numbers(column)


def _numbers(column: Sequence[Plain]) -> dict[str, Plain]:
    # The type is part of the key, since True == 1.
    stretches = [(value, len(list(group))) for (_, value), group in groupby(column, key=_typed)]
    if 2 * len(stretches) < len(column):
        return {"r": [part for stretch in stretches for part in stretch]}
    return {"v": column}


def _typed(value: Plain) -> tuple[type, Plain]:
    return type(value), value


def shortened(value: float) -> Plain:
    """Return a number with a few significant digits, a whole one without a fraction; None if it is not finite."""
    if not isfinite(value):
        return None
    short = float(f"{value:.{DIGITS}g}")
    return int(short) if short.is_integer() and abs(short) < 1e15 else short


def _shortened(value: float | str | bool | None) -> Plain:
    return value if value is None or isinstance(value, str | bool | int) else shortened(float(value))
