"""Columns of a page: what is packed can be unpacked, by the reading that the page's script has of it."""

from itertools import chain, repeat

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.report.page.columns import packed, shortened


def unpacked(column):
    stretches = zip(column.get("r", [])[::2], column.get("r", [])[1::2], strict=True)
    values = column.get("v") or [*chain.from_iterable(repeat(*stretch) for stretch in stretches)]
    return [column["w"][value] for value in values] if "w" in column else values


@given(
    st.one_of(
        st.lists(st.integers(-3, 3)), st.lists(st.booleans()), st.lists(st.sampled_from(["near", "far", ""]))
    )
)
def test_a_column_is_unpacked_as_it_was(values):
    assert unpacked(packed(values)) == values
    assert [*map(type, unpacked(packed(values)))] == [*map(type, values)]


def test_equal_values_are_a_stretch():
    assert packed([0.0] * 5) == {"r": [0, 5]}
    assert packed(["a", "a", "a", "a", "b"]) == {"r": [0, 4, 1, 1], "w": ["a", "b"]}
    assert packed([1, 2]) == {"v": [1, 2]}


def test_truths_are_not_numbers():
    assert packed([True, 1, 1, 1, 1])["r"][0] is True


@pytest.mark.parametrize(
    ("value", "short"),
    [
        (0.1 + 0.2, 0.3),
        (3.0, 3),
        (-123456.789, -123457),
        (float("nan"), None),
        (float("inf"), None),
        (1e300, 1e300),
    ],
)
def test_numbers_are_short(value, short):
    assert shortened(value) == short
