import numpy as np

from bbsd.architecture import Architecture, architecture_of
from bbsd.architecture.visits import Visits
from bbsd.explanation import explain_architecture, explanation_text
from bbsd.explanation.useless import depends_on
from tests.unit.architecture.designs import meaning_of, small
from tests.unit.explanation.test_layers import TWO_INPUTS, UPPER_NEAR, explained, visits, with_visits


def found(explanation):
    return [(each.kind, each.behavior, each.what, each.is_certain) for each in explanation.useless]


def test_a_behavior_that_never_acts_is_named():
    useless = explained(UPPER_NEAR, [[0, 1, 2, 1, 1, 1], [0, 0]], [0, 1]).useless[0]
    assert (useless.kind, useless.behavior) == ("behavior", "upper")
    assert useless.why == "it has no action in any cell, and can be removed"


def test_a_behavior_that_never_controls_is_named_with_those_above():
    useless = explained(TWO_INPUTS, [[1] * 6, [0, 1], [1], [1]], [0, 2, 1]).useless
    assert ("lower", "never controls: upper or always above always does; it can be removed") in [
        (each.behavior, each.why) for each in useless
    ]


def test_what_is_needed_is_not_named():
    assert found(explained(UPPER_NEAR, [[0, 1, 2, 0, 0, 0], [0, 1]], [0, 1])) == [
        ("input", "lower", "near", True)
    ]


def test_behaviors_that_did_not_control_or_hardly_are_named():
    never = visits([[5, 0, 0, 0, 0, 0], [9_000, 0]], [[0] * 6, [0, 0]], 10_000)
    hardly = visits([[5, 5, 5, 0, 0, 0], [9_000, 9]], [[0, 5, 5, 0, 0, 0], [0, 9]], 10_000)
    tables = [[0, 1, 2, 1, 1, 1], [0, 1]]
    assert ("upper", "never controlled in 10 episodes") in [
        (each.behavior, each.why) for each in with_visits(UPPER_NEAR, tables, [0, 1], never).useless
    ]
    assert ("upper", "hardly ever controlled: 0.09 % of the steps of 10 episodes") in [
        (each.behavior, each.why) for each in with_visits(UPPER_NEAR, tables, [0, 1], hardly).useless
    ]


RULES = """
  lower:
    inputs: {near: x > 1, pace: "values(floor(x), 0, 2)"}
    actions: {a: {x: 1}, b: {x: 2}}
    rules:
      - {when: {near: true}, do: a}
      - {when: {pace: 1}, do: b}
      - {when: {pace: 0}, do: a}
      - otherwise: b
  upper: {inputs: {near: x > 1}, actions: {a: {x: 2}}, rules: [{when: {near: true}, do: a}, otherwise: no action]}
structure: [upper, lower]
"""


def test_rules_of_the_file_that_never_decide_are_named():
    meaning = meaning_of(small(RULES))
    design = architecture_of(meaning)
    assert found(explain_architecture(meaning, design))[0] == (
        "rule",
        "lower",
        "rule 1: a where near is true",
        True,
    )
    counted = visits([[0, 0, 9, 0, 0, 0], [9, 9]], [[0, 0, 9, 0, 0, 0], [0, 9]])
    rules = [each for each in found(explain_architecture(meaning, design, counted)) if each[0] == "rule"]
    assert rules == [
        ("rule", "lower", "rule 1: a where near is true", True),
        ("rule", "lower", "rule 2: b where pace is 1", False),
        ("rule", "lower", "rule 3: a where pace is 0", False),
    ]


def test_inputs_are_named_together_only_if_all_of_them_can_go():
    one = """  one: {inputs: {near: x > 1, far: cos(x) > 0}, actions: {a: {x: 1}}}\n"""
    both = explained(one, [[1, 1, 1, 1]], [0]).useless[0]
    assert (both.what, both.why) == ("near and far", "never matter, and can be removed")
    meaning = meaning_of(small(one))
    alike = Visits(10, 100, (np.array([5, 0, 0, 5]),), (np.array([0, 0, 0, 5]),))
    design = Architecture((np.array([0, 0, 0, 1], np.uint8),), np.array([0]))
    assert found(explain_architecture(meaning, design, alike)) == [
        ("input", "one", "near", False),
        ("input", "one", "far", False),
    ]


def test_an_input_matters_if_cells_that_count_differ_along_it():
    table, sizes = np.array([0, 1, 0, 1]), [2, 2]
    assert depends_on(table, np.ones(4, bool), sizes) == [False, True]
    assert depends_on(table, np.array([True, False, False, True]), sizes) == [False, False]


def test_many_rules_of_a_behavior_are_one_sentence():
    rules = "".join(f"      - {{when: {{pace: {pace}}}, do: {'ab'[pace % 2]}}}\n" for pace in range(5))
    behaviors = f"""
  one:
    inputs: {{pace: "values(floor(x), 0, 5)"}}
    actions: {{a: {{x: 1}}, b: {{x: 2}}}}
    rules:
{rules}      - otherwise: a
structure: [one]
"""
    meaning = meaning_of(small(behaviors))
    counted = visits([[5, 5, 0, 0, 0, 0]], [[5, 5, 0, 0, 0, 0]], 10)
    text = explanation_text(explain_architecture(meaning, architecture_of(meaning), counted))
    assert "  one, rules 3, 4 and 5: not used in 10 episodes\n" in text
    assert "  (bbsd explain --worth measures what the design would earn without them.)\n" in text
