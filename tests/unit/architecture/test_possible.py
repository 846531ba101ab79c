import numpy as np
import pytest

from bbsd.architecture import architecture_of, joint_space
from bbsd.architecture.policy import own_cells
from bbsd.architecture.possible import possible_cells
from bbsd.evaluation.visits import visits_of
from bbsd.language.loading import load
from bbsd.text import Source
from tests.unit.architecture.designs import SPECS, meaning_of, small


def possible(inputs, excited=""):
    meaning = meaning_of(small(f"  one: {{inputs: {{{inputs}}}, {excited}actions: {{a: {{x: 1}}}}}}\n"))
    return possible_cells(meaning, joint_space(meaning)).astype(int).tolist()


def test_what_looks_at_one_value_excludes_each_other():
    assert possible("low: x < 1, high: x > 2") == [[1, 1], [1, 0]]
    assert possible("low: x < 1, high: x >= 1") == [[0, 1], [1, 0]]
    assert possible('low: x < 1, zone: "cut(x, 1, 2)"') == [[0, 1, 1], [1, 0, 0]]


def test_what_looks_at_different_values_excludes_nothing():
    assert possible("low: x < 1, high: cos(x) > 2") == [[1, 1], [1, 1]]


def test_whole_numbers_lie_between_no_bounds():
    assert possible('at: "values(floor(x), 0, 2)", low: floor(x) < 1') == [[0, 1], [1, 0], [1, 0]]
    assert possible('at: "values(floor(x), 1, 3)", low: floor(x) < 1') == [[1, 1], [1, 0], [1, 0]]


def test_pairs_of_values_are_in_one_order():
    assert possible("less: x < sin(x), more: x > sin(x), same: x == sin(x)") == [
        [[0, 1], [1, 0]],
        [[1, 0], [0, 0]],
    ]


def test_a_condition_that_excites_counts_too():
    assert possible("low: x < 1", "excited: x > 2, ") == [[1, 1], [1, 0]]


def test_named_cells_that_exclude_each_other_are_one_value():
    assert possible("zone: {near: x < 1, far: x > 2, between: otherwise}, far: x > 3") == [
        [1, 0],
        [1, 1],
        [1, 0],
    ]


def test_too_many_cases_prove_nothing(monkeypatch):
    monkeypatch.setattr("bbsd.architecture.possible.MOST_EVALUATIONS", 1)
    assert possible("low: x < 1, high: x > 2") == [[1, 1], [1, 1]]


@pytest.mark.parametrize(
    "name", ["grid_world_hand", "object_lifting_hand", "pursuit_hand", "tasks/door_and_key_hand"]
)
def test_what_occurs_is_possible(name):
    meaning = load(Source.read(SPECS / f"{name}.yaml")).meaning
    space = joint_space(meaning)
    cells = possible_cells(meaning, space)
    asked = visits_of(meaning, architecture_of(meaning), 0, 4).asked
    for behavior, counts in enumerate(asked):
        own = np.broadcast_to(own_cells(space, behavior), space.sizes)
        assert not counts[np.setdiff1d(np.arange(len(counts)), own[cells])].any()
