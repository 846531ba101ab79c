from math import prod

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.explanation.conditions import condition_text, join_words, places_in_words
from bbsd.explanation.words import PlaceInWords

INPUTS = {
    "tilted": ("false", "true"),
    "place": ("lowest", "highest", "middle"),
    "pace": ("0", "1", "2", "3", "4", "5"),
    "tilt": ("below 2", "2 to 5", "5 to 9", "from 9"),
}
ALL = {name: tuple(range(len(cells))) for name, cells in INPUTS.items()}


@pytest.mark.parametrize(
    ("chosen", "words"),
    [
        ({}, ""),
        ({"tilted": (1,)}, "tilted"),
        ({"tilted": (0,)}, "not tilted"),
        ({"place": (0,), "tilted": (1,)}, "tilted and place is lowest"),
        ({"place": (0, 2)}, "place is not highest"),
        ({"pace": (0, 2, 5)}, "pace is 0, 2 or 5"),
        ({"pace": (0, 1, 2, 5)}, "pace is neither 3 nor 4"),
        ({"tilt": (1, 2)}, "tilt is 2 to 9"),
        ({"tilt": (0, 3)}, "tilt is not 2 to 9"),
        ({"tilt": (0, 1, 2)}, "tilt is below 9"),
    ],
)
def test_a_box_is_a_condition_in_words(chosen, words):
    assert condition_text(tuple((ALL | chosen).values()), INPUTS) == words


def test_places_name_all_cells_wanted_and_no_others():
    where = np.array([[0, 1], [0, 1], [0, 0]], bool).ravel()
    inputs = {"place": INPUTS["place"], "tilted": INPUTS["tilted"]}
    (place,) = places_in_words(where, np.zeros(6, bool), inputs)
    assert place.where == "place is not middle and tilted"
    assert [(each.input, each.cells) for each in place.when] == [("place", (0, 1)), ("tilted", (1,))]


def test_places_reach_over_what_is_allowed_where_that_is_shorter():
    where, allowed = np.array([1, 1, 0], bool), np.array([0, 0, 1], bool)
    assert places_in_words(where, allowed, {"place": INPUTS["place"]}) == (PlaceInWords("", ()),)


@given(st.data())
def test_there_is_a_place_if_and_only_if_a_cell_is_wanted(data):
    inputs = dict(data.draw(st.lists(st.sampled_from([*INPUTS.items()]), unique=True, max_size=2)))
    size = prod(len(cells) for cells in inputs.values())
    where = np.array(data.draw(st.lists(st.booleans(), min_size=size, max_size=size)))
    assert bool(places_in_words(where, ~where, inputs)) == where.any()


def test_words_are_listed():
    assert join_words(["a"], "or") == "a"
    assert join_words(["a", "b"], "or") == "a or b"
    assert join_words(["a", "b", "c"], "and") == "a, b and c"
