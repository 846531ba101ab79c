"""Intervals hold the results of all numbers that they stand for."""

import operator
from collections.abc import Callable
from math import inf, isnan

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.expression import intervals
from bbsd.expression.intervals import ALL, Interval

BOUNDS = st.floats(-1e6, 1e6)


@st.composite
def inside(draw: st.DrawFn) -> tuple[Interval, float]:
    """An interval, and a number in it."""
    low, number, high = sorted(draw(st.tuples(BOUNDS, BOUNDS, BOUNDS)))
    return (low, high), number


@pytest.mark.parametrize(
    ("rule", "operation"),
    [
        (intervals.plus, operator.add),
        (intervals.minus, operator.sub),
        (intervals.product, operator.mul),
        (intervals.lesser, min),
        (intervals.greater, max),
    ],
)
@given(one=inside(), other=inside())
def test_results_are_inside_and_the_bounds_are_reached(
    rule: Callable[..., Interval],
    operation: Callable[..., float],
    one: tuple[Interval, float],
    other: tuple[Interval, float],
) -> None:
    low, high = rule(one[0], other[0])
    assert low <= operation(one[1], other[1]) <= high
    ends = [operation(a, b) for a in one[0] for b in other[0]]
    assert (low, high) == (min(ends), max(ends))


@given(one=inside(), other=inside())
def test_quotients_are_inside_where_the_divisor_is_not_zero(
    one: tuple[Interval, float], other: tuple[Interval, float]
) -> None:
    low, high = intervals.quotient(one[0], other[0])
    if other[1]:
        assert low <= one[1] / other[1] <= high
    assert ((low, high) == ALL) == (other[0][0] <= 0 <= other[0][1])


@given(value=inside(), divisor=inside())
def test_values_of_one_operand_are_inside(
    value: tuple[Interval, float], divisor: tuple[Interval, float]
) -> None:
    (interval, number), (of, by) = value, divisor
    for found, result in [
        (intervals.negated(interval), -number),
        (intervals.magnitude(interval), abs(number)),
        (intervals.remainder(of), number % by if by else 0.0),
        *(((grow(interval[0]), grow(interval[1])), grow(number)) for grow in intervals.GROWING.values()),
    ]:
        assert found[0] <= result <= found[1]
    assert abs(number) <= intervals.size(interval)


def test_what_cannot_be_known_is_everything() -> None:
    assert intervals.product((0, 1), (1, inf)) == ALL
    assert intervals.quotient((1, inf), (1, inf)) == ALL
    assert intervals.quotient((1, 2), (4, inf)) == (0, 0.5)
    assert not any(isnan(bound) for bound in intervals.product(ALL, ALL))


def test_a_bound_that_moved_is_given_up_and_the_other_kept() -> None:
    assert intervals.without_moving((0, 1), (0, 2)) == (0, inf)
    assert intervals.without_moving((0, 1), (-1, 1)) == (-inf, 1)
    assert intervals.without_moving((0, 1), (0, 1)) == (0, 1)


def test_a_hull_holds_all_of_its_intervals() -> None:
    assert intervals.hull((0, 1), (-1, 0.5)) == (-1, 1)
    assert intervals.hull_of([(3, 4), (0, 1), (2, 2)]) == (0, 4)
