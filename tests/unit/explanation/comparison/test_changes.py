import itertools

import pytest

from bbsd.explanation.comparison.changes import moved, order, redefined, rule_changes
from bbsd.explanation.comparison.results import Redefined
from tests.unit.explanation.comparison.designs import HAND, design_of, edited


def test_rules_that_differ_are_named_with_their_cells():
    other = edited(HAND, ("when: {pace: 5}", "when: {pace: [3, 5]}"), ("do: slower", "do: no action"))
    changes = [change for change, _ in rule_changes(design_of(HAND), design_of(other))]
    assert [(each.behavior, each.before, each.after, each.cells, each.where) for each in changes] == [
        ("do_not_go_fast", "no action", "cap", 1, ("pace is 3",)),
        ("slow_down", "slower", "no action", 1, ("place is highest and tilted",)),
    ]


def test_other_words_for_the_same_cells_are_no_change():
    other = edited(
        HAND,
        (
            "- when: {reached: true}\n        do: stop\n      - otherwise: no action",
            "- when: {reached: false}\n        do: no action\n      - otherwise: stop",
        ),
    )
    assert not list(rule_changes(design_of(HAND), design_of(other)))


def test_a_behavior_with_other_cells_is_redefined():
    other = edited(HAND, ("pace: values(speed, 0, 5)", "pace: values(speed, 0, 6)"))
    one, two = design_of(HAND), design_of(other)
    assert redefined(one, two) == (Redefined("do_not_go_fast", ("inputs",)),)
    assert not list(rule_changes(one, two))


def test_a_sensor_with_other_cells_redefines_the_behaviors_that_share_it():
    other = edited(HAND, ("      middle: otherwise", "      middle: height > 0\n      deep: otherwise"))
    assert [each.behavior for each in redefined(design_of(HAND), design_of(other))] == [
        "slow_down",
        "hurry_up",
    ]


def test_what_moved_is_the_least_that_explains_the_order():
    other = edited(HAND, ("[stop_at_goal, slow_down, hurry_up,", "[stop_at_goal, hurry_up, slow_down,"))
    found = order(design_of(HAND), design_of(other))
    assert len(found.moved) == 1
    assert found.moved[0] in {"slow_down", "hurry_up"}
    assert moved("abcde", "eabcd") == ("e",)
    assert moved("abc", "xcy") == ()


@pytest.mark.parametrize("names", list(itertools.permutations("abcd")))
def test_fewest_names_moved(names):
    fewest = min(
        4 - size
        for size in range(5)
        for kept in itertools.combinations("abcd", size)
        if list(kept) == [name for name in names if name in kept]
    )
    out = moved("abcd", names)
    assert len(out) == fewest
    assert [name for name in "abcd" if name not in out] == [name for name in names if name not in out]
