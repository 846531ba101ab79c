from math import prod

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.architecture.boxes import FREE, KEEP, MAX_GREEDY_CELLS, cover, first_match


@st.composite
def tables(draw):
    sizes = draw(st.lists(st.integers(1, 4), max_size=3))
    values = draw(st.lists(st.integers(FREE, 2), min_size=prod(sizes), max_size=prod(sizes)))
    return np.array(values, np.int64), sizes


def assert_covers(boxes, values, sizes):
    found = first_match([box for box, _ in boxes], sizes)
    decided = np.array([*(value for _, value in boxes), KEEP])[found]
    assert np.array_equal(decided[values >= 0], values[values >= 0])
    assert (found[values == KEEP] == -1).all()


@given(tables())
def test_the_first_box_that_holds_a_cell_has_its_value(table):
    values, sizes = table
    assert_covers(cover(values, sizes), values, sizes)


@given(tables())
def test_every_box_decides_a_cell_that_those_before_it_do_not(table):
    values, sizes = table
    boxes = [box for box, _ in cover(values, sizes)]
    assert set(range(len(boxes))) <= set(first_match(boxes, sizes)[values >= 0].tolist())


@pytest.mark.parametrize("sizes", [(10, 10, 10), (2,) * 10, (40, 30), (1000,)])
def test_large_tables_are_divided_into_boxes(sizes):
    values = np.random.default_rng(1).integers(FREE, 3, prod(sizes))
    assert len(values) > MAX_GREEDY_CELLS
    assert_covers(cover(values, sizes), values, sizes)


def test_a_large_table_of_one_decision_is_one_box():
    assert cover(np.ones(1000, np.int64), (10, 100)) == [((tuple(range(10)), tuple(range(100))), 1)]


def test_an_input_that_does_not_matter_belongs_to_the_box_as_a_whole():
    values = np.array([[1, 1, 1], [KEEP, KEEP, KEEP]]).ravel()
    assert cover(values, (2, 3)) == [(((0,), (0, 1, 2)), 1)]


def test_a_box_may_reach_over_what_is_decided_already():
    values = np.array([[1, 1, 1], [2, KEEP, KEEP], [2, KEEP, KEEP]]).ravel()
    assert cover(values, (3, 3)) == [(((0,), (0, 1, 2)), 1), (((0, 1, 2), (0,)), 2)]


def test_a_box_does_not_name_free_cells_that_make_it_no_simpler():
    assert cover(np.array([1, FREE, KEEP]), (3,)) == [(((0,),), 1)]


def test_a_table_without_inputs_is_one_cell():
    assert cover(np.array([1]), ()) == [((), 1)]
    assert cover(np.array([KEEP]), ()) == []
