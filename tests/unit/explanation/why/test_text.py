from __future__ import annotations

import json

import pytest

import bbsd
from bbsd.explanation.why import answer_text
from bbsd.explanation.why.aim import Act, NoSuchAction, acts_named
from bbsd.explanation.why.described import BadSituation
from bbsd.report.plain import json_text
from tests.unit.architecture.designs import SPECS

LIFTING, GRID = SPECS / "object_lifting_hand.yaml", SPECS / "grid_world_hand.yaml"
HIGH = {"height": [3.1, 2.9, 3], "speed": 2}


def test_a_why_tells_every_layer_from_the_top():
    assert (
        answer_text(bbsd.why(LIFTING, at=HIGH))
        == """\
object-lifting-by-hand: the situation given, robot 0
stop_at_goal controlled: stop.

5  stop_at_goal    controlled: stop
                   perceived: reached true
4  slow_down       wanted slower, suppressed by stop_at_goal
                   perceived: place highest, tilted true
3  hurry_up        no action
                   perceived: place highest, tilted true
2  do_not_go_fast  no action
                   perceived: pace 2
1  push_more       wanted push, suppressed by stop_at_goal

Given: height 3.1, speed 2
"""
    )


def test_a_why_tells_by_which_condition_a_behavior_was_excited_or_not():
    text = answer_text(bbsd.why(GRID, step=3))
    assert text.startswith("grid-world-by-hand: episode 0, step 3\nseek_goal controlled: straight.\n")
    assert "3  seek_goal     controlled: straight\n                 excited: distance < nearest\n" in text
    assert "not excited; would have wanted right" in text
    assert "does not hold: wall_ahead or wall_left or wall_right" in text


def test_a_why_tells_what_would_have_changed_the_answer():
    text = answer_text(bbsd.why(LIFTING, at=HIGH, unwanted=["stop_at_goal"], wanted=["hurry_up", "nobody"]))
    assert (
        text[text.index("What would") :]
        == """\
What would have kept stop_at_goal from control:
  Perceiving reached false instead of true; then slow_down.slower (all 72
    situations were tried).
  One change of rules or order, any of:
    - slow_down exchanges layers with stop_at_goal; then slow_down.slower
      (changes 6 of 72 situations)
    - hurry_up exchanges layers with stop_at_goal; then slow_down.slower
      (changes 12 of 72 situations)
    - do_not_go_fast exchanges layers with stop_at_goal; then slow_down.slower
      (changes 18 of 72 situations)
    - stop_at_goal decides no action instead of stop where reached true; then
      slow_down.slower (changes 36 of 72 situations)
    - push_more exchanges layers with stop_at_goal; then push_more.push (changes
      52 of 72 situations)

What would have let hurry_up control:
  Perceiving reached false instead of true and place lowest instead of highest;
    then hurry_up.faster (all 72 situations were tried).
  2 changes of rules or order together:
    - hurry_up decides faster instead of no action where place highest, tilted
      true and also hurry_up exchanges layers with stop_at_goal; then
      hurry_up.faster (changes 18 of 72 situations)

What would have let nobody control:
  No change of what it perceived (all 72 situations were tried).
  3 changes of rules or order together:
    - stop_at_goal decides no action instead of stop where reached true,
      slow_down decides no action instead of slower where place highest, tilted
      true and also push_more decides no action instead of push; then nobody
      (changes 62 of 72 situations)
"""
    )


def test_of_what_is_not_excited_no_rule_can_help():
    text = answer_text(bbsd.why(GRID, step=3, wanted=["follow_wall"]))
    assert "No change of rules or order: follow_wall was not excited." in text
    # Where no wall is near it cannot be excited: a wall must be perceived too.
    assert "Perceiving wall_right true instead of false" in text
    assert "all 80 situations were tried; of 6 ways with 3 inputs this is the nearest" in " ".join(
        text.split()
    )


def test_a_why_is_plain_data():
    plain = json.loads(json_text(bbsd.why(LIFTING, at=HIGH, wanted=["hurry_up"]).to_plain()))
    assert (plain["behavior"], plain["action"], plain["episode"], plain["step"]) == (
        "stop_at_goal",
        "stop",
        None,
        None,
    )
    assert plain["layers"][0]["perceived"] == {"reached": "true"}
    assert [layer["role"] for layer in plain["layers"]] == [
        "controlled", "suppressed", "no action", "no action", "suppressed",
    ]  # fmt: skip
    (found,) = plain["otherwise"]
    assert [change["input"] for change in found["inputs"]] == ["reached", "place"]
    assert found["then"] == "hurry_up.faster"


def test_values_that_are_not_finite_are_none_in_plain_data(tmp_path):
    path = tmp_path / "growing.yaml"
    path.write_text(
        """
bbsd: 1
name: growing
environment:
  steps: 4
  state: {x: 1, near: false}
  dynamics: {x: x * 1e200}
behaviors:
  go:
    inputs: {far: x > 2}
    actions: {stay: {near: true}}
    rules: [{otherwise: stay}]
structure: [go]
reward: {near: 1 if near else 0}
"""
    )
    before = [bbsd.why(path, step=step).to_plain()["values"]["x"] for step in (1, 2, 3)]
    assert before == [1, 1e200, None]


def test_a_given_value_has_to_be_finite():
    with pytest.raises(BadSituation, match="height: inf is not finite"):
        bbsd.why(LIFTING, at={"height": [float("inf"), 2, 2], "speed": 2})


def test_a_name_stands_for_an_action_a_behavior_or_an_action_of_a_behavior():
    modules = bbsd.load(LIFTING).meaning.episode.modules
    for name in ("hurry_up", "faster", "hurry_up.faster"):
        assert acts_named(name, modules) == {Act(3, 1)}
    assert acts_named("nobody", modules) == {Act(-1, 0)}
    with pytest.raises(NoSuchAction, match='no action or behavior hury_up; did you mean "hurry_up"'):
        acts_named("hury_up", modules)


def test_an_action_that_two_behaviors_share_stands_for_both():
    modules = bbsd.load(SPECS / "pursuit_hand.yaml").meaning.episode.modules
    shared = acts_named("straight", modules)
    assert len(shared) > 1
    assert {acts_named(f"{modules[act.behavior].name}.straight", modules) for act in shared} == {
        frozenset({act}) for act in shared
    }
