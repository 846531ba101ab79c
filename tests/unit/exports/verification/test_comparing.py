import numpy as np
import pytest

from bbsd.architecture import joint_space
from bbsd.architecture.deciding import asked_at, policy_at
from bbsd.exports.verification.comparing import cells_to_compare, verify
from bbsd.exports.verification.tools import Runner, ToolFailed, ToolMissing
from tests.unit.exports.designs import hand_made, written


def by_policy(exported, files, cells):
    """A target that is right."""
    return policy_at(joint_space(exported.meaning), exported.architecture, cells)


def verified(exported, run):
    (found,) = verify(exported, {}, [Runner("tool", run)])
    return found


def test_all_joint_cells_are_compared_and_that_is_a_proof():
    exported = hand_made("mobile_robot_hand")
    cells = cells_to_compare(exported)
    assert len(np.unique(cells, axis=0)) == len(cells) == exported.controller.joint_size == 160
    found = verified(exported, by_policy)
    assert (found.compared, found.equal, found.is_proof, found.is_equal) == (160, 160, True, True)


@pytest.mark.parametrize("row", [0, 77, 159])
def test_a_single_wrong_cell_is_found_and_shown(row):
    def nearly(exported, files, cells):
        answers = by_policy(exported, files, cells)
        answers[row] = 0 if answers[row] else 1
        return answers

    exported = hand_made("mobile_robot_hand")
    found = verified(exported, nearly)
    assert (found.equal, found.is_equal) == (159, False)
    cells = cells_to_compare(exported)[row]
    shown = dict(found.first_difference.cells)
    assert shown["brightest"] == exported.controller.dimensions[0].cells[cells[0]]
    assert found.first_difference.target == "nobody"
    assert " of " in found.first_difference.design


def test_a_tool_that_is_missing_or_fails_verifies_nothing():
    def missing(*_):
        raise ToolMissing("tool")

    def failing(*_):
        raise ToolFailed("no space")

    exported = hand_made("object_lifting_hand")
    found = verified(exported, missing)
    assert (found.missing, found.is_equal, found.equal) == (True, False, 0)
    found = verified(exported, failing)
    assert (found.failure, found.is_equal, found.equal) == ("no space", False, 0)


LARGE = """
  high:
    inputs: {a: "values(floor(x), 0, 99)", b: "values(floor(x * 2), 0, 99)"}
    excited: x > 5
    actions: {go: {x: 1}}
    rules: [{when: {a: 3, b: 4}, do: no action}, {otherwise: go}]
  low:
    inputs: {c: "values(floor(x * 3), 0, 999)"}
    actions: {stop: {x: 2}}
    rules: [{when: {c: 500}, do: stop}, {otherwise: no action}]
structure: [high, low]
"""


def test_of_a_large_space_every_cell_of_a_table_decides_somewhere_in_the_sample():
    exported = written(LARGE)
    assert exported.controller.joint_size == 20_000_000
    cells = cells_to_compare(exported)
    assert len(cells) == 200_000 + 10_000 + 1_000
    asked = dict(asked_at(joint_space(exported.meaning), exported.architecture, cells))
    high = cells[asked[0]]
    assert len(np.unique(high[:, 0] * 100 + high[:, 1])) == 10_000
    assert len(np.unique(cells[asked[1]][:, 2])) == 1_000
    found = verified(exported, by_policy)
    assert (found.is_proof, found.is_equal) == (False, True)


def test_a_wrong_cell_of_a_large_table_is_found():
    def nearly(exported, files, cells):
        answers = by_policy(exported, files, cells)
        answers[cells[:, 2] == 500] = 0
        return answers

    found = verified(written(LARGE), nearly)
    assert not found.is_equal
    assert dict(found.first_difference.cells)["c"] == "500"


def test_the_sample_is_the_same_each_time():
    assert (cells_to_compare(written(LARGE)) == cells_to_compare(written(LARGE))).all()


@pytest.mark.parametrize(("most", "compared"), [(100, 50 + 14), (20, 10 + 9), (1, 1 + 3)])
def test_a_slow_tool_goes_through_a_sample_and_that_is_no_proof(most, compared):
    exported = hand_made("mobile_robot_hand")
    assert sum(len(layer.table) for layer in exported.controller.layers) == 14
    (found,) = verify(exported, {}, [Runner("slow", by_policy, most_cells=lambda _: most)])
    assert (found.compared, found.is_equal, found.is_proof) == (compared, True, False)
