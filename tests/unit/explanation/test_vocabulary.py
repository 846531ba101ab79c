from bbsd.explanation.vocabulary import actions_of, inputs_of
from tests.unit.architecture.designs import meaning_of, shipped, small

BEHAVIORS = """
  one: {inputs: {near: x > 1}, actions: {go: {x: 1}, wait: {}}}
  two: {inputs: {near: x > 2}, actions: {go: {x: 2}}}
  three: {inputs: {near: x > 2}, actions: {go: {x: 2}}}
"""


def spec_of(text):
    return meaning_of(text).spec


def test_inputs_are_shown_as_the_designer_wrote_them():
    assert dict(
        inputs_of(spec_of(shipped("object_lifting")), ["do_not_go_fast", "stop_at_goal", "hurry_up"])
    ) == {
        "pace": "values(speed, 0, 5)",
        "reached": "height >= goal",
        "place": "lowest: height == min(height[r] for r in team); highest: height == max(height[r] for r in team); "
        "middle: otherwise",
        "tilted": "tilt > small_tilt",
    }


def test_a_word_with_several_meanings_says_whose_it_is():
    spec = spec_of(small(BEHAVIORS))
    assert inputs_of(spec, spec.behaviors) == (("near of one", "x > 1"), ("near of two, three", "x > 2"))


def test_actions_say_what_they_set():
    spec = spec_of(small(BEHAVIORS))
    assert actions_of(spec, ["one"]) == (("go", "x: 1"), ("wait", "nothing"))


def test_a_truth_of_the_state_is_told_from_a_sensor():
    text = small("  one: {inputs: [lit, seen], actions: {go: {x: 1}}}\n")
    spec = spec_of(text.replace("state: {x: 0}", "state: {x: 0, lit: x > 3}, sensors: {seen: x > 1}"))
    assert inputs_of(spec, ["one"]) == (("lit", "state, starts as x > 3"), ("seen", "x > 1"))


def test_a_number_of_an_observation_is_told_as_such():
    spec = spec_of(shipped("gymnasium/lake"))
    assert dict(inputs_of(spec, ["sideways"])) == {"row": "observed", "column": "observed"}


def test_a_sensor_that_an_input_repeats_by_its_name_is_not_observed():
    text = small("  one: {inputs: {seen: seen}, actions: {go: {x: 1}}}\n")
    spec = spec_of(text.replace("state: {x: 0}", "state: {x: 0}, sensors: {seen: x > 1}"))
    assert dict(inputs_of(spec, ["one"])) == {"seen": "seen"}
