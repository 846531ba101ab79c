from __future__ import annotations

from math import inf, nan

import pytest

from bbsd.evaluation import Interval
from bbsd.report.wording.numbers import changes, column, count, duration, number, percent, with_halves


@pytest.mark.parametrize(
    ("value", "text"),
    [
        (301.3734, "301.37"),
        (-0.716518, "-0.7165"),
        (12345678.0, "12345678"),
        (0.0, "0.0000"),
        (2.5e-7, "2.5000e-07"),
        (-3e12, "-3.0000e+12"),
        (nan, "unknown"),
        (inf, "infinite"),
        (-inf, "-infinite"),
    ],
)
def test_a_number_has_five_digits(value, text):
    assert number(value) == text


def test_a_column_has_as_many_decimals_everywhere_as_its_largest_number():
    assert column([301.3734, -1.5, 0.004]) == ["301.37", "-1.50", "0.00"]


def test_what_rounds_to_zero_has_no_sign():
    assert column([100.0, -1e-9]) == ["100.00", "0.00"]


def test_an_empty_column_is_empty():
    assert column([]) == []


def test_unknown_numbers_do_not_spoil_the_decimals_of_the_others():
    assert column([nan, 12.0]) == ["unknown", "12.000"]


def test_shares_times_and_counts_read_as_people_say_them():
    assert (percent(0.1234), percent(nan)) == ("12.3 %", "unknown")
    assert [duration(s) for s in (8.14, 185.0, 7800.0)] == ["8.1 s", "3 min 5 s", "2 h 10 min"]
    assert [count(n, "agent") for n in (0, 1, 20000)] == ["0 agents", "1 agent", "20,000 agents"]


def test_differences_have_a_sign_where_they_are_not_zero():
    assert changes([12.5, -3.0, 0.0, -1e-9]) == ["+12.500", "-3.000", "0.000", "0.000"]


def test_means_have_half_their_intervals_behind_them():
    intervals = [Interval(-549.08, 1.0, -550.2, -547.96, 9), Interval(2.5, 1.0, -8.0, 13.0, 9)]
    assert with_halves(intervals) == ["-549.08 ±1.12 ", "+2.50 ±10.50"]
    assert with_halves(intervals, signed=False)[1] == "2.50 ±10.50"
    assert with_halves([]) == []
    missing = Interval(nan, nan, nan, nan, 9)
    assert with_halves([missing, intervals[0]]) == ["not finite", "-549.08 ±1.12"]


def test_changes_have_a_sign_where_they_are_not_0():
    assert changes([2.5, -1.0, 0.0]) == ["+2.5000", "-1.0000", "0.0000"]
    assert changes([inf, -inf, nan, 1.0]) == ["+infinite", "-infinite", "unknown", "+1.0000"]
