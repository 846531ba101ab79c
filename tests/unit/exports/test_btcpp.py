import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from hypothesis import given, settings

from bbsd.architecture import joint_space
from bbsd.architecture.controller import Action, Controller, Dimension, Layer
from bbsd.architecture.deciding import policy_at
from bbsd.exports.btcpp import CELLS, MOST_PARTS, leaves_of, script_of, write
from bbsd.exports.exported import Options
from bbsd.exports.verification.behaviortree import run_btcpp
from bbsd.exports.verification.comparing import cells_to_compare
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

FORMS = ("script", "custom")
REACTIVE = {"ReactiveSequence", "ReactiveFallback"}


def xml_of(design, form="script"):
    (text,) = write(design, Options(leaves=form)).values()
    return text


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("name", ["mobile_robot", "tasks/four_rooms", *SHIPPED])
def test_a_tree_decides_in_all_joint_cells_as_the_design(name, form):
    design = hand_made(name) if name in SHIPPED else drawn(name, 1)
    cells = cells_to_compare(design)
    expected = policy_at(joint_space(design.meaning), design.architecture, cells)
    found = answers(run_btcpp, design, write(design, Options(leaves=form)), cells)
    assert found.tolist() == expected.tolist()
    assert len(np.unique(found)) > 1


@pytest.mark.parametrize("form", FORMS)
def test_whatever_things_are_called_it_is_a_tree(form):
    design = written(ODD_WORDS, name=ODD_NAME)
    cells = cells_to_compare(design)
    expected = policy_at(joint_space(design.meaning), design.architecture, cells)
    assert (
        answers(run_btcpp, design, write(design, Options(leaves=form)), cells).tolist() == expected.tolist()
    )


@given(controllers())
@settings(max_examples=60)
def test_the_library_takes_the_actions_of_any_design(controller):
    engine = library("behaviortreepy")
    cells, expected = joint_cells(controller)
    board, names = engine.Blackboard.create(), leaves_of(controller).inputs
    for name in names:
        board.set_int(name, 0)
    tree = engine.BehaviorTreeFactory().create_tree_from_text(xml_of(exported(controller)), board)
    found = []
    for cell in cells:
        for name, index in zip(names, cell, strict=True):
            board.set_int(name, index)
        assert tree.tick_exactly_once() == engine.NodeStatus.SUCCESS
        found.append(board.get_int("action"))
    assert found == expected


@given(controllers())
@settings(max_examples=60)
def test_custom_leaves_have_models_and_their_ports_are_what_the_models_list(controller):
    root = ET.fromstring(xml_of(exported(controller), "custom"))
    model = {node.get("ID"): {port.get("name") for port in node} for node in root.find("TreeNodesModel")}
    tree = root.find("BehaviorTree")
    ids = [*model, tree.get("ID")]
    assert len(set(ids)) == len(ids)
    assert all(re.fullmatch("[a-z][a-z0-9_]*", each) and each not in ("root", "name") for each in ids)
    used = {}
    for node in tree.iter():
        if node.tag not in REACTIVE | {"BehaviorTree", "Inverter", "AlwaysSuccess"}:
            used.setdefault(node.tag, set()).update(set(node.keys()) - {"name"})
    assert used == model


def many(size, choose):
    """A design of one behavior that perceives so many cells and acts in some of them."""
    table = bytes(bool(choose(cell)) for cell in range(size))
    cells = tuple(f"cell {index}" for index in range(size))
    return Controller(
        "many",
        "0" * 32,
        (Dimension("x", cells, "x", False),),
        (Layer(1, "b", None, (0,), (size,), None, 1, table, 0, 1),),
        (Action("go", "b", {"v": "2"}),),
    )


@pytest.mark.parametrize("form", FORMS)
def test_a_condition_of_very_many_cells_is_one_that_the_library_can_read(form):
    controller = many(3000, lambda cell: cell % 3 == 0)
    design = exported(controller)
    cells = np.arange(3000)[:, None]
    found = answers(run_btcpp, design, write(design, Options(leaves=form)), cells)
    assert found.tolist() == [int(cell % 3 == 0) for cell in range(3000)]


@pytest.mark.parametrize(
    ("cells", "size", "expected"),
    [
        ((1,), 2, ["v == 1"]),
        ((0, 1, 2), 5, ["v <= 2"]),
        ((3, 4), 5, ["v >= 3"]),
        ((1, 2), 5, ["v == 1 || v == 2"]),
        ((1, 2, 3), 5, ["v >= 1 && v <= 3"]),
        ((0, 1, 3, 4), 5, ["v != 2"]),
        ((0, 2, 3, 4, 6), 8, ["v == 0 || (v >= 2 && v <= 4) || v == 6"]),
    ],
)
def test_scripts_are_short_and_have_brackets_where_the_library_needs_them(cells, size, expected):
    assert script_of("v", cells, size) == expected


def test_scripts_have_no_more_alternatives_than_the_parser_takes():
    scripts = script_of("v", range(0, 1000, 2), 1001)
    assert max(script.count("||") for script in scripts) == MOST_PARTS - 1
    assert sum(script.count("==") for script in scripts) == 500


def test_it_says_what_entries_and_actions_mean():
    text = xml_of(hand_made("object_lifting_hand"))
    assert f"digest\n      {hand_made('object_lifting_hand').controller.digest}" in text
    assert "    reached: 1 where height >= goal, 0 elsewhere\n" in text
    assert "    2: cap of do_not_go_fast, sets speed: min(speed, top_speed)\n" in text
    assert '<ScriptCondition name="place is highest" code="place == 1"/>' in text
    assert '<Script name="cap" code="action := 2"/>' in text


def test_custom_leaves_say_in_which_cells_they_succeed_and_what_they_set():
    text = xml_of(hand_made("mobile_robot_hand"), "custom")
    assert f'<brightest name="brightest is right or back_right" {CELLS}="3;4"/>' in text
    assert '<avoid_obstacles_left name="left" forward="0.1" turn="1.5"/>' in text
    assert '<input_port name="forward" type="double" default="0.1"/>' in text
    assert '<input_port name="turn" type="std::string" default="whim"/>' in text


def test_the_same_design_gives_the_same_bytes():
    assert xml_of(hand_made("forager_hand"), "custom") == xml_of(hand_made("forager_hand"), "custom")


def test_a_running_action_is_halted_when_a_higher_layer_acts():
    engine = library("behaviortreepy")
    text, status, present, told = (
        xml_of(hand_made("object_lifting_hand"), "custom"),
        engine.NodeStatus,
        {},
        [],
    )
    factory = engine.BehaviorTreeFactory()
    root = ET.fromstring(text)
    for node in [*root.find("BehaviorTree").iter()]:
        node.attrib = {key: value for key, value in node.items() if key in ("name", "ID")}
    for node in root.find("TreeNodesModel"):
        name = node.get("ID")
        if node.tag == "Condition":
            factory.register_simple_condition(name, lambda _, name=name: present.get(name, False))
        else:
            factory.register_simple_stateful_action(
                name,
                lambda _, name=name: (told.append(f"{name} starts"), status.RUNNING)[1],
                lambda _, name=name: (told.append(f"{name} goes on"), status.RUNNING)[1],
                lambda _, name=name: told.append(f"{name} is halted"),
            )
    tree = factory.create_tree_from_text(ET.tostring(root, encoding="unicode"))
    for change in ({}, {}, {"pace": True}, {"reached": True}, {"reached": False, "pace": False}):
        present.update(change)
        assert tree.tick_exactly_once() == status.RUNNING
    assert told == [
        *("push starts", "push goes on", "cap starts", "push is halted"),
        *("stop starts", "cap is halted", "stop is halted", "push starts"),
    ]
