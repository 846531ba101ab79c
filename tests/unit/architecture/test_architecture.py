import numpy as np
import pytest

from bbsd.architecture import HolesLeft, given_architecture, holes
from bbsd.compiler import compile_meaning
from tests.unit.architecture.designs import meaning_of, shipped, small


def problem_of(text):
    return compile_meaning(meaning_of(text), compiled=False)


def test_a_spec_without_holes_gives_its_architecture():
    found = given_architecture(problem_of(shipped("object_lifting_hand")))
    assert found.structure.tolist() == [0, 1, 3, 4, 2]
    assert [table.tolist() for table in found.tables] == [
        [1],
        [0, 0, 0, 0, 0, 1],
        [0, 1],
        [0, 1, 0, 0, 0, 0],
        [0, 0, 0, 1, 0, 0],
    ]
    assert {table.dtype for table in found.tables} == {np.dtype(np.uint8)}


def test_what_is_left_open_is_named():
    with pytest.raises(HolesLeft, match=r"stop_at_goal: 2 of 2 cells open; .*; 5 of 5 layers open"):
        given_architecture(problem_of(shipped("object_lifting")))


TWO = """
  one: {{actions: {{a: {{x: 1}}}}{rules}}}
  two: {{actions: {{a: {{x: 2}}}}, rules: [{{otherwise: a}}]}}
structure: {structure}
"""


def test_a_behavior_that_the_structure_leaves_out_is_no_hole():
    problem = problem_of(small(TWO.format(rules="", structure="[two]")))
    assert holes(problem) == []
    assert given_architecture(problem).tables[0].tolist() == [0]


def test_a_behavior_that_may_fill_an_open_layer_is_one():
    problem = problem_of(small(TWO.format(rules="", structure="[open]")))
    assert holes(problem) == ["one: 1 of 1 cell open", "1 of 1 layer open"]
