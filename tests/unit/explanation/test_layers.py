import json

import numpy as np
import pytest

from bbsd.architecture import Architecture, joint_space, policy
from bbsd.explanation import RuleInWords, explain_architecture
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
    assert lower.rules == (
        RuleInWords("a", "near and pace is not 0", overruled=False),
        RuleInWords("b", "pace is 1", overruled=False),
        RuleInWords("no action", "", overruled=False),
    )


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


UPPER_NEAR = """
  lower: {inputs: {near: x > 1, pace: "values(floor(x), 0, 2)"}, actions: {a: {x: 1}, b: {x: 2}}}
  upper: {inputs: {near: x > 1}, actions: {a: {x: 2}}}
"""


def test_a_rule_that_is_always_overruled_is_marked():
    lower = explained(UPPER_NEAR, [[0, 0, 2, 1, 1, 0], [0, 1]], [0, 1]).layers[-1]
    assert [(rule.decision, rule.overruled) for rule in lower.rules] == [
        ("a", True),
        ("b", False),
        ("no action", False),
    ]
    assert (lower.overruled, lower.overruled_by) == ((), ("upper",))


def test_cells_in_which_a_rule_is_always_overruled_are_named():
    lower = explained(UPPER_NEAR, [[1, 1, 1, 1, 1, 1], [0, 1]], [0, 1]).layers[-1]
    assert (lower.overruled, lower.effective, lower.overruled_by) == (("near",), ("not near",), ("upper",))


def test_a_rule_of_which_any_cell_may_control_is_not_called_overruled():
    behaviors = """
  lower: {inputs: {tilt: "cut(x, 1, 2)", pace: "values(floor(x), 0, 3)"}, actions: {a: {x: 1}}}
  upper: {inputs: {tilt: "cut(x, 1, 2)"}, actions: {a: {x: 2}}}
"""
    lower = explained(behaviors, [[0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1, 1], [1, 1, 0]], [0, 1]).layers[-1]
    assert [(rule.where, rule.overruled) for rule in lower.rules] == [
        ("tilt is from 2", False),
        ("pace is 3", False),  # not where the rule before it holds as well
        ("", False),
    ]
    assert (lower.overruled, lower.effective) == (("tilt is below 2",), ("tilt is from 2",))


@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.parametrize("seed", range(3))
def test_the_joint_cells_are_shared_out(name, seed):
    meaning = meaning_of(shipped(name))
    architecture = random_architecture(meaning, seed)
    explanation, space = explain_architecture(meaning, architecture), joint_space(meaning)
    control = policy(space, architecture)
    assert sum(layer.cells for layer in explanation.layers) + explanation.nobody_cells == space.joint_size
    assert explanation.nobody_cells == np.count_nonzero(control == 0)
    assert bool(explanation.nobody) == (0 in control)


def test_an_explanation_is_plain_data():
    meaning = meaning_of(shipped("object_lifting_hand"))
    plain = json.loads(json.dumps(explain_architecture(meaning, random_architecture(meaning, 0)).to_plain()))
    assert plain["layers"][1]["rules"][0] == {
        "decision": "slower",
        "where": "place is highest and tilted",
        "overruled": False,
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
    assert lower.rules[0] == RuleInWords("a", "fine is 3 or 70000", overruled=False)
