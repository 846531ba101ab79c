"""Known designs in the terms of another spec, on tables worked by hand."""

import numpy as np
import pytest

from bbsd.architecture.starting import UnfitStart, start_for
from tests.unit.problems import problem_of

SPEC = """
bbsd: 1
name: walk
environment:
  steps: 2
  state: {{at: "integers(0, 3)", said: 0}}
  sensors:
    place: {{low: at < 1, middle: at < 3, high: otherwise}}
    far: at > 2
behaviors:
  go:
    inputs: {inputs}
    actions: {actions}
    {rules}
  wait: {{actions: {{stay: {{said: 0}}}}}}
{structure}
reward: {{right: said}}
"""
ACTIONS = "{ahead: {said: 1}, back: {said: 2}}"
OPEN, NOTHING = 255, 0
LOW = "rules: [{when: {place: low}, do: ahead}, {when: {place: middle}, do: back}, otherwise: no action]"


def spec(inputs="[place]", actions=ACTIONS, rules="", structure="", text=SPEC):
    return problem_of(text.format(inputs=inputs, actions=actions, rules=rules, structure=structure))


def started(spec, start):
    found = start_for(spec, start.meaning, "known.yaml")
    return found.table.tolist(), found.structure.tolist(), found.set_aside


def test_rules_and_layers_are_taken_over_and_holes_stay():
    known = spec(rules=LOW, structure="structure: [wait, go]")
    assert started(spec(), known) == ([1, 2, NOTHING, OPEN], [0, 1], (0, 0))
    assert started(spec(), spec()) == ([OPEN, OPEN, OPEN, OPEN], [-1, -1], (0, 0))


def test_actions_are_matched_by_name_not_by_number():
    wanted = spec(actions="{back: {said: 2}, stop: {said: 0}, ahead: {said: 1}}")
    assert started(wanted, spec(rules=LOW))[0] == [3, 1, NOTHING, OPEN]


def test_a_rule_holds_for_all_cells_of_an_input_that_the_start_does_not_have():
    # of [far, place]: false, then true, each for low, middle, high
    assert started(spec("[far, place]"), spec(rules=LOW))[0] == [1, 2, 0, 1, 2, 0, OPEN]
    assert started(spec("[place, far]"), spec(rules=LOW))[0] == [1, 1, 2, 2, 0, 0, OPEN]
    assert started(spec("[place, far]"), spec("[]", rules="rules: [otherwise: back]"))[0] == [2] * 6 + [OPEN]


def test_inputs_in_another_order_are_the_same_inputs():
    rules = "rules: [{when: {place: low, far: true}, do: ahead}, {when: {place: high}, do: back}, otherwise: no action]"
    assert started(spec("[far, place]"), spec("[place, far]", rules=rules))[0] == [0, 0, 2, 1, 0, 2, OPEN]


def test_cells_that_the_start_does_not_know_stay_open():
    finer = SPEC.replace("high: otherwise", "high: at < 4, top: otherwise")
    assert started(spec(text=finer), spec(rules=LOW))[0] == [1, 2, NOTHING, OPEN, OPEN]
    other = SPEC.replace(
        "low: at < 1, middle: at < 3, high: otherwise", "high: at > 2, middle: at > 0, low: otherwise"
    )
    assert started(spec(text=other), spec(rules=LOW))[0] == [NOTHING, 2, 1, OPEN]


def test_what_the_spec_gives_stays():
    wanted = spec(
        rules="rules: [{when: {place: low}, do: back}, otherwise: open]", structure="structure: [go, open]"
    )
    known = spec(rules=LOW, structure="structure: [wait, go]")
    assert started(wanted, known) == (
        [2, 2, NOTHING, OPEN],
        [1, 0],
        (1, 2),
    )  # only wait is left for the open layer


def test_a_start_with_fewer_layers_has_the_upper_ones():
    known = spec(rules=LOW, structure="structure: [go]")
    assert started(spec(), known)[1] == [-1, 0]
    with pytest.raises(UnfitStart, match=r"known\.yaml has 2 layers, and the spec 1"):
        started(spec(structure="design: {layers: 1}"), spec(rules=LOW))


@pytest.mark.parametrize(
    ("start", "words"),
    [
        (spec("[place, far]", rules=LOW), "the behavior go perceives far, and not so in the spec"),
        (
            spec(text=SPEC.replace("low: at < 1, ", "")),
            None,
        ),
        (
            spec(text=SPEC.replace("low: at < 1", "bottom: at < 1")),
            r"go tells apart place \[bottom, middle, high\], and in the spec \[low, middle, high\]",
        ),
        (
            spec(actions="{forward: {said: 1}}", rules="rules: [otherwise: forward]"),
            "go does forward, and the spec has no such action of it",
        ),
        (spec(actions="{forward: {said: 1}, back: {said: 1}}", rules="rules: [otherwise: back]"), None),
        (spec(text=SPEC.replace("  wait:", "  weit:")), 'has a behavior weit, .* did you mean "wait"'),
        (spec(text=SPEC.replace("  wait:", "  weit:"), structure="structure: [go]"), None),
    ],
)
def test_what_the_spec_does_not_have_is_told(start, words):
    if words is None:
        assert len(started(spec(), start)[0]) == 4
        return
    with pytest.raises(UnfitStart, match=words):
        started(spec(), start)


def test_a_start_that_says_nothing_of_what_is_open_is_known():
    assert not start_for(spec(), spec().meaning, "a").says_something(spec())
    assert start_for(spec(), spec(rules=LOW).meaning, "a").says_something(spec())


def test_cells_of_numbers_are_matched_by_number():
    numbers = SPEC.replace(
        "place: {{low: at < 1, middle: at < 3, high: otherwise}}", 'place: "values(at, {first}, 3)"'
    )
    rules = "rules: [{when: {place: 2}, do: ahead}, otherwise: back]"
    known = spec(rules=rules, text=numbers.replace("{first}", "1"))
    found = started(spec(text=numbers.replace("{first}", "0")), known)[0]
    assert found == [OPEN, 2, 1, 2, OPEN]
    assert np.array(found).shape == (5,)
