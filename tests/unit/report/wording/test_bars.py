from __future__ import annotations

from math import inf, nan

import pytest

from bbsd.report.wording.bars import bar, sparkline


def test_a_sparkline_rises_with_its_values():
    assert sparkline([0, 1, 2, 3, 4, 5, 6, 7], 8) == "▁▂▃▄▅▆▇█"


def test_a_sparkline_of_many_values_is_as_wide_as_it_may_be():
    assert sparkline(range(800), 8) == "▁▂▃▄▅▆▇█"


def test_a_constant_sparkline_is_halfway_up():
    assert sparkline([5, 5, 5], 8) == "▅▅▅"


@pytest.mark.parametrize("values", [[], [nan, inf]])
def test_a_sparkline_of_nothing_known_is_empty(values):
    assert sparkline(values, 8) == ""


def test_values_that_are_not_finite_are_left_out_of_a_sparkline():
    assert sparkline([0, nan, 1, inf], 8) == "▁█"


@pytest.mark.parametrize(
    ("share", "drawn"),
    [(0.0, ""), (nan, ""), (1e-9, "▏"), (0.5, "██"), (0.5625, "██▎"), (1.0, "████"), (2.0, "████")],
)
def test_a_bar_is_as_long_as_its_share(share, drawn):
    assert bar(share, 4) == drawn


@pytest.mark.parametrize(("share", "drawn"), [(0.0, ""), (1e-9, "#"), (0.5, "##"), (1.0, "####")])
def test_a_bar_without_blocks_is_ascii(share, drawn):
    assert bar(share, 4, blocks=False) == drawn
