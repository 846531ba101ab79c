import pytest

from bbsd.language.recovery import UNKNOWN, recover
from bbsd.language.validation import validate
from bbsd.text import read
from tests.unit.language.specs import codes, source


def rest(part: str):
    data = read(source(part)).data
    _, errors = validate(data)
    return recover(data, errors)


def test_wrong_values_are_stood_in_for_and_the_rest_is_kept() -> None:
    found = rest("environment: {robots: many, steps: -1, state: {speed: [1]}}\nstructure: [3, stop]")
    assert found.spec.environment.robots == 2
    assert found.spec.environment.steps == 1
    assert found.spec.environment.state["speed"].text == UNKNOWN
    assert found.spec.environment.state["height"].text == "uniform(2, 3)"
    assert found.spec.structure == ["open", "stop"]


def test_names_that_are_lost_are_remembered() -> None:
    found = rest(
        "environment: {state: {Speed: 0}, sensor: {far: tilt > 3}}\nbehaviors: {Go: {actions: {go: {}}}}"
    )
    assert {"Speed", "speed", "far", "Go", "go"} <= found.broken


def test_the_data_are_left_as_they_were() -> None:
    data = read(source("environment: {robots: many}")).data
    _, errors = validate(data)
    recover(data, errors)
    assert data["environment"]["robots"] == "many"


@pytest.mark.parametrize(
    "part", ["environment: 3", "constants: [1]", "environment: {state: x}", "environment: {sensors: [a]}"]
)
def test_without_the_names_nothing_is_said_of_the_rest(part: str) -> None:
    assert rest(part) is None


@pytest.mark.parametrize(
    "part",
    [
        "behaviors: {stop: {inputs: 3, rules: [{when: {reached: true}, do: halt}]}}",
        "behaviors: {stop: {actions: 3, rules: [{otherwise: halt}]}}",
        "behaviors: {stop: {actions: {Halt: {speed: 0}, halt: null}, rules: [{otherwise: Halt}]}}",
        "behaviors: {stop: {inputs: {reached: [1]}, rules: [{when: {reached: true}, do: halt}]}}",
        "behaviors: {stop: {rules: [{when: {reached: {}}, do: halt}, {otherwise: halt}]}}",
        "behaviors: 3\nstructure: [stop]",
        "behaviors: {stop: 3}\nstructure: [stop]",
        "environment: {sensors: {zone: {low: {}, high: otherwise}}}\nbehaviors: {stop: {inputs: [zone]}}",
        "environment: {sensors: {Far: tilt > 2}}\nbehaviors: {stop: {inputs: [Far]}}",
        "design: {learning: {episodes: many, rate: 1 - episode / 40}}",
        "constants: {goal: {}}\nreward: {near: 'goal - height[goal]'}",
        "reward: 3",
        "view: 3",
        "view: {}",
        "view: {at: {}, marks: {end: [1, 2]}}",
        "view: {at: [robot, height], marks: {End: [1, 2]}}",
        "view: {at: [robot, height], area: [0, 0, {}, 1]}",
    ],
)
def test_one_mistake_of_form_has_no_others_in_its_train(part: str) -> None:
    assert len(codes(part)) == 1
