"""Mistakes in the use of an environment in Python, told in words that say what to do."""

import pytest

from bbsd.errors import Diagnosis
from bbsd.language.loading import check, load
from bbsd.text import Data, Source, read
from bbsd.text.writing.writer import write
from tests.unit.language.specs import merged

BASE = """
bbsd: 1
name: example
constants: {top: 5}
environment:
  gymnasium: CartPole-v1
  steps: 10
  observation: [x, angle]
  action: push
  world: {wind: 0}
  state: {push: 0}
  definitions: {"twice(a)": 2 * a}
  sensors: {tilt: 2 * angle}
behaviors:
  act: {inputs: {left: angle < 0}, actions: {left: {push: 0}, right: {push: 1}}}
reward: {earned: earned}
"""


def found(part: str) -> tuple[Diagnosis, ...]:
    data: Data = merged(read(Source("base", BASE)).data, read(Source("part", part)).data)
    return check(Source("spec.yaml", write(data)))


def messages(part: str) -> list[tuple[str, str]]:
    return [(diagnosis.code, diagnosis.message) for diagnosis in found(part)]


def test_the_base_has_no_mistake() -> None:
    assert found("bbsd: 1") == ()


@pytest.mark.parametrize(
    ("name", "message"),
    [("pusch", '"pusch" is not state; did you mean "push"?'), ("angle", "angle is an observation"),
     ("earned", "earned is what the environment rewards"), ("wind", "wind is a value of the world"),
     ("tilt", "tilt is a sensor"), ("top", "top is a constant"), ("twice", "twice is a definition"),
     ("act", "act is a behavior")],
)  # fmt: skip
def test_what_is_sent_is_state(name: str, message: str) -> None:
    ((code, told),) = messages(f"environment: {{action: {name}}}")
    assert code == "BB106"
    assert told.startswith(message)


def test_each_world_is_told_of_but_the_first() -> None:
    part = "environment: {python: 'a:A', pettingzoo: a.b_v1}"
    assert messages(part) == [
        ("BB101", "the world is already named by gymnasium"),
        ("BB101", "the world is already named by gymnasium"),
    ]


def test_without_observation_nothing_else_is_told_of_the_names_in_it() -> None:
    ((code, message),) = messages("environment: {observation: null}")
    assert (code, message) == (
        "BB104", 'an environment in Python needs the key "observation": names for what it shows',
    )  # fmt: skip


def test_each_key_without_an_environment_is_told_of() -> None:
    part = "environment: {gymnasium: null, with: {a: 1}}"
    assert [code for code, _ in messages(part)] == ["BB105"] * 3


def test_observations_share_the_names_of_all_values() -> None:
    ((code, message),) = messages("constants: {angle: 5}")
    assert (code, message) == (
        "BB025", "angle is already the name of something in environment.observation (line 11)",
    )  # fmt: skip
    ((code, message),) = messages("environment: {sensors: {earned: 5}}")
    assert (code, message) == ("BB025", "earned is already the name of what the environment rewards")


@pytest.mark.parametrize("name", ["angle", "earned"])
def test_only_the_environment_sets_what_it_gives(name: str) -> None:
    what = "an observation" if name == "angle" else "what the environment rewards"
    part = (
        f"environment: {{dynamics: {{{name}: 1}}}}\nbehaviors: {{act: {{actions: {{left: {{{name}: 1}}}}}}}}"
    )
    assert messages(part) == [
        ("BB107", f"{name} is {what}, which has no dynamics"),
        ("BB107", f"{name} is {what}, and an action cannot set it"),
    ]


def test_a_list_of_inputs_takes_what_has_a_size() -> None:
    part = "environment: {observation: {x: 1, angle: 3}}\nbehaviors: {act: {inputs: [angle]}}"
    data = merged(read(Source("base", BASE)).data, read(Source("part", part)).data)
    (module,) = load(Source("spec.yaml", write(data))).meaning.episode.modules
    assert tuple(module.inputs["angle"]) == ("0", "1", "2")
    assert [code for code, _ in messages("behaviors: {act: {inputs: [angle]}}")] == ["BB030"]
    ((code, message),) = messages("behaviors: {act: {inputs: [angel]}}")
    assert (code, message) == ("BB041", '"angel" is neither sensor nor state; did you mean "angle"?')


@pytest.mark.parametrize("block", ["environment: {sensors: {SEEN}}", "behaviors: {act: {inputs: {SEEN}}}"])
def test_named_cells_may_name_every_value_of_what_has_a_size(block: str) -> None:
    sizes = "environment: {observation: {x: 2, angle: 3}}"
    some = "seen: {none: angle == 0, one: angle == 1"
    for cells, codes in ((f"{some}, two: angle == 2}}", []), (f"{some}}}", ["BB032"])):
        base: Data = merged(read(Source("base", BASE)).data, read(Source("part", sizes)).data)
        data: Data = merged(base, read(Source("part", block.replace("SEEN", cells))).data)
        assert [each.code for each in check(Source("spec.yaml", write(data)))] == codes


def test_an_own_value_may_be_called_earned() -> None:
    text = "bbsd: 1\nname: own\nenvironment: {steps: 3, state: {x: 0}, sensors: {earned: x}}\n"
    text += "behaviors: {a: {actions: {b: {x: 1}}}}\nreward: {r: earned}"
    assert check(Source("spec.yaml", text)) == ()
    ((code, advice),) = [
        (each.code, each.advice)
        for each in check(Source("spec.yaml", text.replace(", sensors: {earned: x}", "")))
    ]
    assert code == "BB112"
    assert "under reward" in advice
