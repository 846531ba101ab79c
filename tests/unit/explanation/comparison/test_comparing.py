import importlib

import numpy as np
import pytest

from bbsd.evaluation import agents_of, evaluation_keys, returns_of, trace
from bbsd.explanation.comparison import sources as sources_module
from bbsd.explanation.comparison.results import Command
from tests.unit.explanation.comparison.designs import WALK, compared_designs, design_of, edited

KEYS = evaluation_keys(0, 12)

OTHER_RULES = edited(
    WALK, ("rules: [otherwise: right]", "rules: [{when: {odd: true}, do: stay}, {otherwise: right}]")
)
NO_BACK = edited(WALK, ("do: left}", "do: no action}"))
REORDERED = edited(OTHER_RULES, ("[back, go]", "[go, back]"))
REDEFINED = edited(WALK, ("far: x > 2", "far: x > 4"))
FASTER = edited(WALK, ("right: {x: x + 1}", "right: {x: x + 2}"))


def compared(a, b, keys=KEYS):
    return compared_designs(design_of(a, "a.yaml"), design_of(b, "b.yaml"), keys)


def commands_in_traces(host, guest):
    """How many robot-steps of a host there are, and in which the guest would have set other values, by their traces."""
    total = differ = 0
    for key in KEYS.tolist():
        traced = trace(host.problem, host.architecture, key, 1)
        x, y = ([list(values) for slot, values in traced.values.items() if slot[0] == name] for name in "xy")
        for robot in range(2):
            for step in range(1, len(traced.steps)):
                situation = {"x": x[robot][step - 1], "y": y[robot][step - 1]}
                total += 1
                differ += effect(host, situation) != effect(guest, situation)
    return total, differ


def effect(design, at):
    """What a design of the walk sets x to in a situation."""
    far, odd = at["x"] > (4 if "x > 4" in design.loaded.source.text else 2), at["y"] % 2 == 1
    wishes = {}
    tables = dict(zip(design.problem.names, design.architecture.tables, strict=True))
    step = 2 if "x + 2" in design.loaded.source.text else 1
    wishes["back"] = {0: None, 1: -1}[int(tables["back"][int(far)])]
    wishes["go"] = {0: None, 1: step, 2: 0}[int(tables["go"][int(odd)])]
    return next((wishes[name] for name in design.order if wishes[name] is not None), None)


@pytest.mark.parametrize("other", [OTHER_RULES, NO_BACK, REORDERED, REDEFINED, FASTER])
def test_commands_differ_where_the_traces_say_so(other):
    a, b = design_of(WALK), design_of(other)
    found = compared_designs(a, b, KEYS).commands
    for share, steps, (host, guest) in (
        (found.share_a, found.steps_a, (a, b)),
        (found.share_b, found.steps_b, (b, a)),
    ):
        total, differ = commands_in_traces(host, guest)
        first = steps - total  # a trace does not have the situation of the first step
        assert first == 2 * len(KEYS)
        assert differ <= round(share * steps) <= differ + first
        assert share > 0


def test_differences_add_up_to_the_shares():
    found = compared(WALK, REORDERED).commands
    assert sum(each.share_a for each in found.differences) == pytest.approx(found.share_a)
    assert sum(each.share_b for each in found.differences) == pytest.approx(found.share_b)


def test_commands_are_named_with_the_situations():
    found = compared(WALK, NO_BACK).commands
    assert [(each.a, each.b, each.where) for each in found.differences] == [
        (Command("back", "left"), Command("go", "right"), ("far",))
    ]


def test_an_action_that_sets_the_same_is_no_other_command():
    renamed = edited(
        WALK, ("stay: {x: x}}, rules: [otherwise: right]", "ahead: {x: x + 1}}, rules: [otherwise: ahead]")
    )
    comparison = compared(edited(WALK, ("stay: {x: x}", "ahead: {x: x + 1}")), renamed)
    assert [(each.before, each.after) for each in comparison.rules] == [("right", "ahead")]
    assert comparison.commands.share_a == comparison.commands.share_b == 0.0


@pytest.mark.parametrize("other", [OTHER_RULES, REDEFINED, REORDERED])
def test_the_difference_is_that_of_pairs(other):
    comparison = compared(WALK, other)
    returns = [
        returns_of(each.problem, agents_of([each.architecture]), KEYS, 1)[0]
        for each in map(design_of, (WALK, other))
    ]
    assert comparison.is_paired
    assert comparison.difference.mean == pytest.approx(float(np.mean(returns[1] - returns[0])))
    assert comparison.difference.sd == pytest.approx(float(np.std(returns[1] - returns[0], ddof=1)))
    assert sum(term.difference.mean for term in comparison.terms) == pytest.approx(comparison.difference.mean)


def test_other_worlds_are_not_paired():
    comparison = compared(WALK, edited(WALK, ("integers(0, 3)", "integers(1, 4)")))
    assert not comparison.is_paired
    one, two = comparison.return_a, comparison.return_b
    half = 1.959964 * np.sqrt((one.sd**2 + two.sd**2) / 12)
    assert comparison.difference.low == pytest.approx(two.mean - one.mean - half, rel=1e-5)
    assert "state x" in comparison.notes[0]


def test_other_rewards_are_said_to_be_others():
    comparison = compared(WALK, edited(WALK, ("late: -y", "slow: -y")))
    assert [(each.term, each.a is None, each.b is None) for each in comparison.terms] == [
        ("here", False, False),
        ("late", False, True),
        ("slow", True, False),
    ]
    assert any("the rewards differ" in note for note in comparison.notes)


def test_a_design_is_the_same_as_itself():
    comparison = compared(WALK, WALK)
    assert comparison.is_same
    assert comparison.difference.low == comparison.difference.high == 0.0
    assert comparison.sources == comparison.rules == ()


def test_a_single_change_needs_no_share_of_the_difference():
    assert compared(WALK, OTHER_RULES).sources == ()


def sources_of(a, b):
    return {(each.kind, each.behavior, each.after): each for each in compared(a, b).sources}


def test_each_change_is_measured_alone_and_taken_back():
    both = edited(OTHER_RULES, ("do: left}", "do: no action}"))
    found = sources_of(WALK, both)
    assert set(found) == {("rules", "back", "no action"), ("rules", "go", "stay")}
    alone = compared(WALK, NO_BACK).difference
    back = compared(OTHER_RULES, both).difference
    assert found["rules", "back", "no action"].in_a == alone
    assert found["rules", "back", "no action"].in_b == back


def test_the_order_is_a_change_of_its_own():
    found = sources_of(WALK, REORDERED)
    assert (
        found["order", "", ""].in_a == compared(WALK, edited(WALK, ("[back, go]", "[go, back]"))).difference
    )


def test_a_behavior_with_another_definition_is_a_change_of_its_own():
    both = edited(OTHER_RULES, ("far: x > 2", "far: x > 4"))
    found = sources_of(WALK, both)
    assert found["definition", "back", ""].in_a == compared(WALK, REDEFINED).difference
    assert found["definition", "back", ""].in_b == compared(OTHER_RULES, both).difference


def test_behaviors_that_only_one_has_belong_to_the_order():
    more = edited(
        OTHER_RULES,
        ("structure: [back, go]", "structure: [jump, back, go]"),
        ("structure:", ("  jump: {inputs: {low: x < 1}, actions: {up: {x: x + 3}}, "
         "rules: [{when: {low: true}, do: up}, {otherwise: no action}]}\nstructure:")),
    )  # fmt: skip
    found = sources_of(WALK, more)
    plain = edited(more, ("[{when: {odd: true}, do: stay}, {otherwise: right}]", "[otherwise: right]"))
    assert found["order", "", ""].in_a == compared(WALK, plain).difference


def test_too_many_changes_are_not_all_measured(monkeypatch):
    monkeypatch.setattr(sources_module, "MOST_CHANGES", 1)
    monkeypatch.setattr("bbsd.explanation.comparison.comparing.MOST_CHANGES", 1)
    comparison = compared(WALK, REORDERED)
    assert (len(comparison.sources), comparison.unmeasured) == (1, 1)


def test_behaviors_without_meaning_in_the_other_world_are_named():
    other = WALK.replace("x", "z")
    comparison = compared(WALK, other)
    assert comparison.commands is None
    assert comparison.sources == ()
    assert any("cannot act in the other environment" in note for note in comparison.notes)
    assert comparison.return_b.count == 12


def test_a_change_whose_rewards_would_not_be_finite_has_no_worth():
    """The rules alone lead where the reward is infinite; with the other order they do not."""
    risky = edited(WALK, ("late: -y", "late: 1 / (x - 90)"))
    jump = edited(risky, ("stay: {x: x}", "stay: {x: 90}"))
    other = edited(
        jump,
        ("rules: [otherwise: right]", "rules: [{when: {odd: true}, do: stay}, {otherwise: right}]"),
        ("rules: [{when: {far: true}, do: left}, {otherwise: no action}]", "rules: [otherwise: left]"),
    )
    found = sources_of(jump, other)
    assert found["rules", "go", "stay"].in_a is None
    assert found["rules", "back", "left"].in_a is not None
    assert found["rules", "back", "left"].in_b is None


def test_a_space_too_large_to_go_through_is_compared_where_it_was_visited(monkeypatch):
    whole = compared(WALK, REORDERED)
    module = importlib.import_module("bbsd.architecture.policy")  # the name is that of a function too
    monkeypatch.setattr(module, "MAX_JOINT_CELLS", 1)
    assert compared(WALK, REORDERED) == whole
