import ast

import numpy as np
import pytest
from hypothesis import given, settings

from bbsd.architecture import joint_space
from bbsd.architecture.deciding import policy_at
from bbsd.exports.exported import Options
from bbsd.exports.pytrees import CLIENT, write
from bbsd.exports.verification.comparing import cells_to_compare
from bbsd.exports.verification.pytrees import run_pytrees
from tests.unit.exports.controllers import controllers, exported, joint_cells
from tests.unit.exports.designs import (
    ODD_NAME,
    ODD_WORDS,
    SHIPPED,
    answers,
    drawn,
    hand_made,
    library,
    written,
)


def text_of(design):
    (text,) = write(design, Options()).values()
    return text


def module(design):
    names = {}
    exec(text_of(design), names)
    return names


@pytest.mark.parametrize("name", ["mobile_robot", "tasks/four_rooms", *SHIPPED])
def test_a_tree_decides_in_all_joint_cells_as_the_design(name):
    design = hand_made(name) if name in SHIPPED else drawn(name, 1)
    cells = cells_to_compare(design)
    expected = policy_at(joint_space(design.meaning), design.architecture, cells)
    found = answers(run_pytrees, design, write(design, Options()), cells)
    assert found.tolist() == expected.tolist()
    assert len(np.unique(found)) > 1


def test_whatever_things_are_called_it_is_a_tree():
    design = written(ODD_WORDS, name=ODD_NAME)
    cells = cells_to_compare(design)
    expected = policy_at(joint_space(design.meaning), design.architecture, cells)
    assert answers(run_pytrees, design, write(design, Options()), cells).tolist() == expected.tolist()


@given(controllers())
@settings(max_examples=40)
def test_the_library_takes_the_actions_of_any_design(controller):
    library("py_trees")
    cells, expected = joint_cells(controller)
    made = module(exported(controller))["Controller"]()
    assert [made.command(*cell) for cell in cells] == expected


def test_robots_with_namespaces_of_their_own_do_not_disturb_each_other():
    library("py_trees")
    names = module(hand_made("object_lifting_hand"))
    first, second = names["Controller"]("first"), names["Controller"]("second")
    first.command(pace=0, reached=1, place=0, tilted=0)
    second.command(pace=5, reached=0, place=0, tilted=0)
    assert (first.blackboard.action, second.blackboard.action) == (3, 2)


def test_no_key_is_called_as_something_that_clients_of_the_blackboard_have():
    engine = library("py_trees")
    client = engine.blackboard.Client(name="any")
    assert {each for each in dir(client) if not each.startswith("_")} <= set(CLIENT.split())


def test_it_is_plain_python_that_says_what_it_is():
    design = hand_made("object_lifting_hand")
    text = text_of(design)
    ast.parse(text)
    assert "#   2: cap of do_not_go_fast, sets speed: min(speed, top_speed)\n" in text
    assert f'DIGEST = "{design.controller.digest}"\n' in text
    assert max(map(len, text.splitlines())) <= 100
