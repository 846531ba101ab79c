import pytest

from bbsd.explanation.comparison.common import (
    definition_differences,
    reward_differences,
    sense_differences,
    world_differences,
)
from tests.unit.explanation.comparison.designs import HAND, design_of, edited


def pair(*changes):
    return design_of(HAND).loaded, design_of(edited(HAND, *changes)).loaded


def test_layout_and_comments_make_no_difference():
    one, other = pair(
        ("height: height + speed * dt", "height: (height + speed*dt)  # anew"),
        ("stop_at_goal:\n    inputs", "stop_at_goal:\n    # soon\n    inputs"),
    )
    assert (
        world_differences(one, other) == sense_differences(one, other) == reward_differences(one, other) == ()
    )


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ("robots: 3", "robots: 4", "robots"),
        ("steps: 300", "steps: 30", "steps"),
        ("speed: 0\n  dynamics", "speed: 1\n  dynamics", "state speed"),
        ("height: height + speed * dt", "height: height + speed", "dynamics of height"),
    ],
)
def test_what_moves_makes_worlds_differ(old, new, what):
    assert world_differences(*pair((old, new))) == (what,)


def test_what_is_sensed_makes_no_other_world():
    one, other = pair(
        ("small_tilt: 5 ", "small_tilt: 4 "),
        ("tilted: tilt >", "tilted: 2 * tilt >"),
        ("    place:\n", "    new: height\n    place:\n"),
    )
    assert world_differences(one, other) == ()
    assert sense_differences(one, other) == ("sensor tilted", "constant small_tilt")


def test_reward_terms_that_differ_are_named():
    assert reward_differences(*pair(("speeding: -0.1", "speeding: -0.2"))) == ("speeding",)
    assert reward_differences(*pair(("overshoot: -1", "over: -1"))) == ("overshoot", "over")


def test_a_behavior_is_another_with_other_inputs_excitement_or_actions():
    one, other = pair(
        ("reached: height >= goal", "reached: height > goal"),
        ("stop:\n        speed: 0", "stop:\n        speed: 1"),
    )
    behaviors = one.spec.behaviors, other.spec.behaviors
    assert definition_differences(*(each["stop_at_goal"] for each in behaviors)) == ("inputs", "actions")
    assert definition_differences(*(each["slow_down"] for each in behaviors)) == ()


def test_rules_make_no_other_behavior():
    one, other = pair(("when: {pace: 5}", "when: {pace: 4}"))
    behaviors = one.spec.behaviors["do_not_go_fast"], other.spec.behaviors["do_not_go_fast"]
    assert definition_differences(*behaviors) == ()
