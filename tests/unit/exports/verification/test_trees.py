import pytest

from bbsd.exports.exported import Options
from bbsd.exports.targets import TARGETS
from bbsd.exports.verification import behaviortree, pytrees
from bbsd.exports.verification.comparing import cells_to_compare
from bbsd.exports.verification.tools import ToolFailed, ToolMissing
from tests.unit.exports.designs import hand_made, library

RUNNERS = [
    pytest.param(behaviortree, behaviortree.run_btcpp, "btcpp", "behaviortreepy", id="btcpp"),
    pytest.param(pytrees, pytrees.run_pytrees, "pytrees", "py_trees", id="pytrees"),
]


def files_of(exported, target):
    return dict(TARGETS[target].write(exported, Options()))


@pytest.mark.parametrize(("module", "run", "target", "name"), RUNNERS)
def test_a_library_that_is_not_installed_is_told_by_its_name(module, run, target, name, monkeypatch):
    monkeypatch.setattr(module, "find_spec", lambda _: None)
    exported = hand_made("object_lifting_hand")
    with pytest.raises(ToolMissing, match=name):
        run(exported, files_of(exported, target), cells_to_compare(exported))


@pytest.mark.parametrize(("module", "run", "target", "name"), RUNNERS)
def test_a_tree_that_the_library_does_not_take_is_told_with_what_it_says(module, run, target, name):
    library(name)
    exported = hand_made("object_lifting_hand")
    ((file, text),) = files_of(exported, target).items()
    damaged = text.replace("ReactiveSequence", "ReactionSequence").replace("memory=False", "memory=No")
    with pytest.raises(ToolFailed, match=r"ReactionSequence|'No' is not defined"):
        run(exported, {file: damaged}, cells_to_compare(exported))


@pytest.mark.parametrize(("module", "run", "target", "name"), RUNNERS)
def test_a_tree_that_decides_otherwise_is_found(module, run, target, name):
    library(name)
    exported = hand_made("object_lifting_hand")
    ((file, text),) = files_of(exported, target).items()
    wrong = text.replace('code="pace == 5"', 'code="pace == 4"').replace('"pace", 5)', '"pace", 4)')
    assert wrong != text
    cells = cells_to_compare(exported)
    right, found = (run(exported, {file: each}, cells) for each in (text, wrong))
    assert {cells[row][0] for row in (right != found).nonzero()[0]} == {4, 5}


def test_large_trees_are_run_in_fewer_cells():
    small, large = hand_made("tasks/mountain_car_hand"), hand_made("forager_hand")
    assert behaviortree.most_cells_of_btcpp(large) < behaviortree.most_cells_of_btcpp(small)
    assert pytrees.most_cells_of_pytrees(large) < behaviortree.most_cells_of_btcpp(large)
