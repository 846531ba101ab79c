import keyword

import pytest

from bbsd.compiler.writing.naming import Namer
from bbsd.kernel import functions, memory, streams
from tests.unit.problems import episode_of, problem_of

CALLED_AS_THE_KERNEL = """
bbsd: 1
name: names
environment:
  steps: 3
  state: {{{name}: 1.5}}
  definitions: {{{name}_2: "{name} + {name}"}}
  dynamics:
    {name}: max({name}_2, 2) / 2 + ({name} // 0.4) % 3 + floor({name}) ** 2 + round({name}) ** 0.5
  sensors: {{looked: "list(1, 2, 3)[step - 1] + ({name} if chance(1) else step)"}}
behaviors:
  {name}: {{inputs: {{cell: "cut(looked, 2)"}}, actions: {{{name}: {{{name}: "{name} * step"}}}}}}
reward: {{{name}_2: "{name} + looked"}}
"""


def test_each_name_is_given_out_once():
    name = Namer()
    assert [name("height"), name("height"), name("height_")] == ["height", "height_", "height__"]


def test_numbered_names_pass_over_those_that_are_taken():
    name = Namer()
    assert [name("part_1"), name.numbered("part"), name.numbered("part")] == ["part_1", "part_2", "part_3"]


@pytest.mark.parametrize("word", [*keyword.kwlist, "np", "float", "lane", "rollout"])
def test_python_s_and_the_rollout_s_own_words_are_not_given_out(word):
    assert Namer()(word) == f"{word}_"


def test_what_a_rollout_calls_is_not_given_out():
    known = (*functions.COMPILABLE, memory.part, memory.as_words, *streams.COMPILABLE)
    names = (function.__name__ for function in known)
    called = [name for name in names if not name.startswith("_")]
    assert [Namer()(name) for name in called] == [f"{name}_" for name in called]


@pytest.mark.parametrize(
    "name",
    [
        "select", "maximum", "minimum", "divide", "floor_divide", "modulo", "whole_power", "power", "clamp_index",
        "round_half_even", "fold", "word_of", "unit", "float", "bool", "np", "total", "lane", "key", "key_", "numbers",
        "cells", "part", "zeros", "as_words", "add_where", "maximum_where", "cell_of",
        "part_1", "draw_1", "share", "credit_nobody", "running_", "record",
    ],
)  # fmt: skip
def test_a_spec_may_use_the_names_of_the_kernel(name):
    tables, structure = [[1, 0]], [0]
    expected = episode_of(problem_of(CALLED_AS_THE_KERNEL.format(name="unlike")), tables, structure)
    outcome = episode_of(problem_of(CALLED_AS_THE_KERNEL.format(name=name)), tables, structure)
    assert outcome.returns == expected.returns


def test_a_behavior_an_action_and_a_reward_may_be_python_s_words():
    text = """
    bbsd: 1
    name: words
    environment: {steps: 2, state: {x: 0}}
    behaviors:
      class: {actions: {return: {x: x + 1}}}
      lambda_: {actions: {pass: {x: x + 2}}}
    reward: {import: x}
    """
    assert episode_of(problem_of(text), [[1], [1]], [0, 1]).returns == 2 + 4


def test_a_state_called_like_another_s_element_of_a_robot_is_its_own():
    text = """
    bbsd: 1
    name: names
    environment:
      robots: 2
      steps: 1
      world: {height_0: 100, height_1: 200}
      state: {height: robot + 1}
      dynamics: {height_0: height_0 + 1, height: height + 10}
    behaviors: {idle: {actions: {do: {height: height}}}}
    reward: {each: height_0 + height_1 + height}
    """
    assert episode_of(problem_of(text), [[0]], [0]).returns == 101 + 200 + (11 + 12) / 2
