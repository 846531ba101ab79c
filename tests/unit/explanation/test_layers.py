import json

import numpy as np
import pytest

from bbsd.architecture import Architecture, architecture_of, joint_space, policy
from bbsd.architecture.visits import Visits
from bbsd.explanation import Condition, explain_architecture
from tests.unit.architecture.designs import SHIPPED, meaning_of, random_architecture, shipped, small

TWO_INPUTS = """
  lower: {inputs: {near: x > 1, pace: "values(floor(x), 0, 2)"}, actions: {a: {x: 1}, b: {x: 2}}}
  upper: {inputs: {near: x > 1}, excited: x > 9, actions: {a: {x: 2}}}
  always: {actions: {a: {x: 3}}}
  spare: {actions: {a: {x: 4}}}
"""


def explained(behaviors, tables, structure):
    tables = tuple(np.array(table, np.uint8) for table in tables)
    return explain_architecture(meaning_of(small(behaviors)), Architecture(tables, np.array(structure)))


def test_layers_come_from_the_highest_down():
    layers = explained(TWO_INPUTS, [[0] * 6, [0, 1], [1], [1]], [0, 1]).layers
    assert [(layer.layer, layer.behavior, layer.excited) for layer in layers] == [
        (2, "upper", "x > 9"),
        (1, "lower", None),
    ]


def test_rules_are_in_words():
    lower = explained(TWO_INPUTS, [[0, 2, 0, 0, 1, 1], [0, 1], [1], [1]], [0]).layers[0]
    assert [(rule.decision, rule.where) for rule in lower.rules] == [
        ("a", "near and pace is not 0"),
        ("b", "pace is 1"),
        ("no action", ""),
    ]
    assert lower.rules[0].when == (Condition("near", (1,), ("true",)), Condition("pace", (1, 2), ("1", "2")))
    assert (lower.is_shortest, lower.words) == (True, 7)


def test_behaviors_outside_the_structure_are_named():
    assert explained(TWO_INPUTS, [[0] * 6, [0, 1], [1], [1]], [0, 1]).left_out == ("always", "spare")


def test_a_behavior_below_one_that_always_acts_never_controls():
    explanation = explained(TWO_INPUTS, [[1] * 6, [0, 1], [1], [1]], [0, 2, 1])
    lower = explanation.layers[-1]
    assert (lower.cells, lower.overruled_by) == (0, ("upper", "always"))
    assert all(rule.overruled for rule in lower.rules)


def test_what_is_sometimes_excited_does_not_always_overrule():
    lower = explained(TWO_INPUTS, [[1] * 6, [1, 1], [1], [1]], [0, 1]).layers[-1]
    assert lower.overruled_by == ()
    assert not lower.rules[0].overruled


def texts(places):
    return [place.where for place in places]


UPPER_NEAR = """
  lower: {inputs: {near: x > 1, pace: "values(floor(x), 0, 2)"}, actions: {a: {x: 1}, b: {x: 2}}}
  upper: {inputs: {near: x > 1}, actions: {a: {x: 2}}}
"""


def test_what_is_always_overruled_makes_no_rule():
    lower = explained(UPPER_NEAR, [[0, 0, 2, 1, 1, 0], [0, 1]], [0, 1]).layers[-1]
    assert [(rule.decision, rule.where) for rule in lower.rules] == [("b", "pace is 2"), ("no action", "")]
    assert (lower.kinds.count, lower.kinds.covered) == (3, 3)
    assert lower.table == ("no action", "no action", "b", "", "", "")


def test_cells_in_which_a_rule_is_always_overruled_are_named():
    lower = explained(UPPER_NEAR, [[1, 1, 1, 1, 1, 1], [0, 1]], [0, 1]).layers[-1]
    assert (texts(lower.covered), texts(lower.effective)) == (["near"], ["not near"])
    assert lower.covered[0].when == (Condition("near", (1,), ("true",)),)
    assert lower.overruled_by == ("upper",)
    assert [(rule.decision, rule.where) for rule in lower.rules] == [("a", "")]


def test_rules_reach_over_cells_that_do_not_count():
    behaviors = """
  lower: {inputs: {tilt: "cut(x, 1, 2)", pace: "values(floor(x), 0, 3)"}, actions: {a: {x: 1}}}
  upper: {inputs: {tilt: "cut(x, 1, 2)"}, actions: {a: {x: 2}}}
"""
    lower = explained(behaviors, [[0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1], [1, 1, 0]], [0, 1]).layers[-1]
    assert [rule.where for rule in lower.rules] == [""]
    assert (texts(lower.covered), texts(lower.effective)) == (["tilt is below 2"], ["tilt is from 2"])


@pytest.mark.parametrize("seed", range(20))
def test_rules_say_what_the_table_says_wherever_it_counts(seed):
    meaning = meaning_of(shipped("object_lifting"))
    architecture = random_architecture(meaning, seed)
    by_name = {module.name: index for index, module in enumerate(meaning.episode.modules)}
    for layer in explain_architecture(meaning, architecture).layers:
        module = meaning.episode.modules[by_name[layer.behavior]]
        words = ["no action", *module.actions]
        for cell, indices in enumerate(np.ndindex(*(len(cells) for cells in module.inputs.values()))):
            at = dict(zip(module.inputs, indices, strict=True))
            rule = next(
                rule for rule in layer.rules if all(at[each.input] in each.cells for each in rule.when)
            )
            said = words[architecture.tables[by_name[layer.behavior]][cell]]
            assert layer.table[cell] in ("", said)
            assert rule.decision == said or not layer.table[cell]


def test_the_hand_made_controller_is_the_five_rules_that_act():
    meaning = meaning_of(shipped("object_lifting_hand"))
    explanation = explain_architecture(meaning, architecture_of(meaning))
    acting = [
        (layer.behavior, rule.decision, rule.where)
        for layer in explanation.layers
        for rule in layer.rules
        if rule.decision != "no action"
    ]
    assert acting == [
        ("stop_at_goal", "stop", "reached"),
        ("slow_down", "slower", "place is highest and tilted"),
        ("hurry_up", "faster", "place is lowest and tilted"),
        ("do_not_go_fast", "cap", "pace is 5"),
        ("push_more", "push", ""),
    ]
    assert [(row.behavior, row.decision, row.where) for row in explanation.rows] == acting
    assert all(layer.is_shortest for layer in explanation.layers)
    assert not explanation.useless


LINKED = """
  lower: {inputs: {tilt: "cut(x, 1, 2)", upright: x < 1}, actions: {a: {x: 1}, b: {x: 2}}}
"""


def test_cells_that_cannot_occur_make_no_rule():
    explanation = explained(LINKED, [[1, 2, 1, 2, 1, 1]], [0])
    lower = explanation.layers[0]
    assert (explanation.joint_size, explanation.possible_cells) == (6, 3)
    assert (lower.kinds.count, lower.kinds.impossible) == (3, 3)
    assert [(rule.decision, rule.where) for rule in lower.rules] == [("b", "tilt is below 1"), ("a", "")]
    assert lower.table == ("", "b", "a", "", "a", "")
    assert lower.cells == 3


def visits(asked, controlled, robot_steps=100):
    arrays = ([np.array(each) for each in counts] for counts in (asked, controlled))
    return Visits(10, robot_steps, *map(tuple, arrays))


def with_visits(behaviors, tables, structure, visits):
    tables = tuple(np.array(table, np.uint8) for table in tables)
    meaning = meaning_of(small(behaviors))
    return explain_architecture(meaning, Architecture(tables, np.array(structure)), visits)


def test_cells_that_were_never_asked_make_no_rule_and_are_listed_apart():
    counted = visits([[5, 0, 70, 0, 0, 0], [5, 20]], [[0, 0, 70, 0, 0, 0], [0, 20]])
    explanation = with_visits(UPPER_NEAR, [[0, 1, 2, 1, 1, 1], [0, 1]], [0, 1], counted)
    lower = explanation.layers[-1]
    assert [(rule.decision, rule.where, rule.asked, rule.controlled) for rule in lower.rules] == [
        ("b", "pace is 2", 70, 70),
        ("no action", "", 5, 0),
    ]
    assert [(each.decision, each.where, each.agrees) for each in lower.never_asked] == [
        ("a", "pace is 1", False)
    ]
    assert explanation.watched == (10, 100, 10)


def test_the_whole_is_ordered_by_how_often_a_row_decided():
    counted = visits([[5, 0, 70, 0, 0, 0], [5, 20]], [[0, 0, 70, 0, 0, 0], [0, 20]])
    rows = with_visits(UPPER_NEAR, [[0, 1, 2, 1, 1, 1], [0, 1]], [0, 1], counted).rows
    assert [(row.behavior, row.decision, row.where, row.controlled) for row in rows] == [
        ("lower", "b", "pace is 2", 70),
        ("upper", "a", "near", 20),
        ("lower", "a", "pace is 1", 0),
    ]


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.parametrize("seed", range(5))
def test_the_rows_are_the_whole_policy(name, seed):
    meaning = meaning_of(shipped(name))
    architecture, space = random_architecture(meaning, seed), joint_space(meaning)
    modules = meaning.episode.modules
    rows = explain_architecture(meaning, architecture).rows
    expected = policy(space, architecture)
    actions = [("nobody", ""), *((module.name, action) for module in modules for action in module.actions)]
    projections = {module.name: each for module, each in zip(modules, space.projections, strict=True)}
    for number, cell in zip(expected.tolist(), np.ndindex(*space.sizes), strict=True):
        found = ("nobody", "")
        for row in sorted(rows, key=lambda row: row.layer):
            inputs = modules[[module.name for module in modules].index(row.behavior)].inputs
            axes = dict(zip(inputs, projections[row.behavior].axes, strict=True))
            if all(cell[axes[each.input]] in each.cells for each in row.when):
                found = (row.behavior, row.decision)
        assert found == actions[number]


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.parametrize("seed", range(3))
def test_the_joint_cells_are_shared_out(name, seed):
    meaning = meaning_of(shipped(name))
    architecture = random_architecture(meaning, seed)
    explanation, space = explain_architecture(meaning, architecture), joint_space(meaning)
    control = policy(space, architecture)
    assert explanation.possible_cells == space.joint_size
    assert sum(layer.cells for layer in explanation.layers) + explanation.nobody_cells == space.joint_size
    assert explanation.nobody_cells == np.count_nonzero(control == 0)
    assert bool(explanation.nobody) == (0 in control)


def test_an_explanation_is_plain_data():
    meaning = meaning_of(shipped("object_lifting_hand"))
    plain = json.loads(json.dumps(explain_architecture(meaning, random_architecture(meaning, 0)).to_plain()))
    assert plain["layers"][1]["rules"][0] == {
        "decision": "slower",
        "where": "place is highest and tilted",
        "when": [
            {"input": "place", "cells": [1], "labels": ["highest"]},
            {"input": "tilted", "cells": [1], "labels": ["true"]},
        ],
        "overruled": False,
        "asked": None,
        "controlled": None,
    }
    assert plain["inputs"][0] == ["reached", "height >= goal"]


LARGE = """
  one: {inputs: {a: "values(floor(x), 0, 999)"}, actions: {go: {x: 1}}}
  two: {inputs: {b: "values(floor(x) * 2, 0, 999)"}, actions: {go: {x: 2}}}
"""


def test_in_a_space_that_is_too_large_nothing_is_counted():
    explanation = explained(LARGE, [[1] * 1000, [1] * 1000], [0, 1])
    assert explanation.joint_size == 1_000_000
    assert explanation.nobody_cells is None
    assert all(layer.cells is None and not layer.overruled_by for layer in explanation.layers)


FINE = """
  lower: {inputs: {fine: "values(floor(x), 0, 99999)"}, actions: {a: {x: 1}, b: {x: 2}}}
  upper: {inputs: {near: x > 1}, actions: {a: {x: 2}}}
"""


def test_a_table_that_nobody_reads_is_counted():
    table = np.random.default_rng(0).choice(3, 100_000, p=[0.2, 0.5, 0.3])
    explanation = explained(FINE, [table, [0, 1]], [0, 1])
    upper, lower = explanation.layers
    counts = np.bincount(table).tolist()
    assert (lower.rules, upper.counted) == ((), ())
    assert {each.decision: each.cells for each in lower.counted} == dict(
        zip(("no action", "a", "b"), counts, strict=True)
    )
    assert len(json.dumps(explanation.to_plain())) < 2000


def test_few_rules_of_a_large_table_are_in_words():
    table = np.zeros(100_000, int)
    table[[3, 70_000]] = 1
    lower = explained(FINE, [table, [0, 1]], [0]).layers[0]
    assert (lower.rules[0].decision, lower.rules[0].where) == ("a", "fine is 3 or 70000")
    assert lower.rules[0].when == (Condition("fine", (3, 70_000), ("3", "70000")),)
