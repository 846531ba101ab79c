"""The arithmetic of intervals: where a result lies, if each operand lies between two numbers.

Two proofs go by it, and are two since one for both would be worse for each. What is warned of is proven with exact
numbers: sines from -1 to 1, conditions as 0 and 1, values that are no numbers (NaN) left out
(`bbsd.language.warnings.bounds`). What a kernel relies on must hold for numbers as they are rounded: sines may leave
these bounds by a rounding, and what may be NaN is known to be so (`bbsd.compiler.passes.ranges`).
"""

from __future__ import annotations

from math import inf, isnan
from typing import TYPE_CHECKING

from bbsd.kernel import functions

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

Interval = tuple[float, float]
"""The least and the greatest value."""

ALL: Interval = (-inf, inf)

GROWING: Mapping[str, Callable[[float], float]] = {
    "floor": functions.floor,
    "ceil": functions.ceil,
    "degrees": functions.degrees,
    "radians": functions.radians,
}
"""Operations whose value grows with their operand's everywhere, so that bounds become bounds."""


def size(interval: Interval) -> float:
    """Return the greatest magnitude."""
    return max(abs(interval[0]), abs(interval[1]))


def hull(one: Interval, other: Interval) -> Interval:
    """Return the least interval that holds what lies in either."""
    return min(one[0], other[0]), max(one[1], other[1])


def hull_of(intervals: Iterable[Interval]) -> Interval:
    """Return the least interval that holds what lies in any of some, at least one."""
    lows, highs = zip(*intervals, strict=True)
    return min(lows), max(highs)


def without_moving(before: Interval, after: Interval) -> Interval:
    """Return an interval without the bounds that moved, which may go on to move: they are infinite."""
    return after[0] if after[0] == before[0] else -inf, after[1] if after[1] == before[1] else inf


def plus(left: Interval, right: Interval) -> Interval:
    """Return the interval of sums."""
    return left[0] + right[0], left[1] + right[1]


def minus(left: Interval, right: Interval) -> Interval:
    """Return the interval of differences."""
    return left[0] - right[1], left[1] - right[0]


def negated(value: Interval) -> Interval:
    """Return the interval of values with the other sign."""
    return -value[1], -value[0]


def product(left: Interval, right: Interval) -> Interval:
    """Return the interval of products; of zero times infinity nothing is known."""
    return _around([one * other for one in left for other in right])


def quotient(dividend: Interval, divisor: Interval) -> Interval:
    """Return the interval of quotients; where the divisor may be zero, nothing is known."""
    if divisor[0] <= 0 <= divisor[1]:
        return ALL
    return _around([one / other for one in dividend for other in divisor])


def remainder(divisor: Interval) -> Interval:
    """Return the interval of remainders, which lie between zero and the divisor."""
    return hull(divisor, (0.0, 0.0))


def magnitude(value: Interval) -> Interval:
    """Return the interval of absolute values."""
    return max(value[0], -value[1], 0.0), size(value)


def lesser(one: Interval, other: Interval) -> Interval:
    """Return the interval of the lesser of two values."""
    return min(one[0], other[0]), min(one[1], other[1])


def greater(one: Interval, other: Interval) -> Interval:
    """Return the interval of the greater of two values."""
    return max(one[0], other[0]), max(one[1], other[1])


def _around(found: list[float]) -> Interval:
    return ALL if any(map(isnan, found)) else (min(found), max(found))
