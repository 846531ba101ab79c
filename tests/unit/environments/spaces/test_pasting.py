import numpy as np
import pytest

from bbsd.environments.spaces.kinds import Box, Discrete, Mapping, MultiDiscrete, Other
from bbsd.environments.spaces.pasting import environment_text
from bbsd.language.loading import load
from bbsd.language.outside import Outside
from bbsd.text import Source

FOUR = Box((4,), (-4.8, -np.inf, -0.4, -np.inf), (4.8, np.inf, 0.4, np.inf), "float32")
IMAGE = Box((9, 9), (0.0,) * 81, (1.0,) * 81, "uint8")
REST = """
bbsd: 1
name: pasted
behaviors:
  wait:
    actions: {go: {ACTION: START}}
reward: {earned: earned}
"""


def test_a_block_has_a_line_for_each_name():
    told = Outside("gymnasium", "CartPole-v1", {"sutton_barto_reward": True}, (), ())
    assert (
        environment_text(told, FOUR, Discrete(2), 1, 500, "CartPole")
        == """\
environment:
  gymnasium: CartPole-v1
  with:
    sutton_barto_reward: true
  steps: 500
  observation:
    - position                      # -4.8 to 4.8
    - speed                         # any number
    - angle                         # -0.4 to 0.4
    - tip_speed                     # any number
  action: command                   # a whole number from 0 to 1
  state:
    command: 0
"""
    )


@pytest.mark.parametrize(
    ("space", "taken", "start"),
    [
        (FOUR, Discrete(3, start=5), "5"),
        (FOUR, None, "0"),
        (Discrete(9), Box((2,), (2.0, -5.0), (3.0, -4.0), "float32"), "2"),
        (
            Mapping((("image", Box((9, 9), (0.0,) * 81, (1.0,) * 81, "uint8")), ("text", Other("Text")))),
            Discrete(2),
            "0",
        ),
        (FOUR, MultiDiscrete((2, 2), (1, 1), (2,)), "1"),
    ],
)
def test_it_can_be_pasted(space, taken, start):
    told = Outside("pettingzoo", "a.b_v1", {"n": [1, 2], "m": {"k": "text"}}, (), ())
    block = environment_text(told, space, taken, 2, None, "")
    action = "command_1" if "command_1" in block else "command"
    text = block + REST.replace("ACTION", action).replace("START", start)
    spec = load(Source("pasted.yaml", text)).spec
    assert spec.environment.robots == 2
    assert spec.environment.outside.arguments == told.arguments


def test_what_is_not_made_of_numbers_is_said():
    told = Outside("python", "a:B", {}, (), ())
    text = environment_text(told, Other("Graph"), Other("Text"), 1, None, "")
    assert "# nothing of an observation is a number: Graph" in text
    assert "# what it takes is not made of numbers: Text" in text
