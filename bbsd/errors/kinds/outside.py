"""The kinds of mistakes in the use of an environment that is stepped in Python: BB101 to BB112."""

from __future__ import annotations

from bbsd.errors.kinds.kind import DiagnosisKind

_WORLD = "environment:\n  pettingzoo: mpe2.simple_spread_v3\n"
_SHOWN = "  observation: [x, y]\n"
_TOLD = "  action: speed\n"

OUTSIDE_KINDS = (
    DiagnosisKind(
        code="BB101",
        title="two worlds",
        explanation=(
            "The world of a spec is its own, or one environment that is stepped in Python: gymnasium, pettingzoo and "
            "python each name one."
        ),
        example=f"{_WORLD}  python: arenas:Arena\n{_SHOWN}{_TOLD}",
        mend=f"{_WORLD}{_SHOWN}{_TOLD}",
    ),
    DiagnosisKind(
        code="BB102",
        title="not the name of an environment",
        explanation=(
            "A Gymnasium environment is named by its id with its version, CartPole-v1 or namespace/Name-v1, after the "
            "module that registers it where that is not installed as a plugin: module:Name-v1. A PettingZoo one is "
            "named by its module and its name with its version, mpe2.simple_spread_v3; a class of your own by its "
            "module and its name, my_module:Arena. No other form is looked up, and nothing is imported to check it."
        ),
        example=f"environment:\n  python: arenas/arena.py\n{_SHOWN}{_TOLD}",
        mend=f"environment:\n  python: arenas.arena:Arena\n{_SHOWN}{_TOLD}",
    ),
    DiagnosisKind(
        code="BB103",
        title="an argument that cannot be given",
        explanation=(
            "What stands under with becomes keyword arguments of the environment's making: each has a name that "
            "Python allows, and plain data as its value: numbers, truths, texts, lists and mappings."
        ),
        example=f"{_WORLD}  with:\n    max-cycles: 25\n{_SHOWN}{_TOLD}",
        mend=f"{_WORLD}  with:\n    max_cycles: 25\n{_SHOWN}{_TOLD}",
    ),
    DiagnosisKind(
        code="BB104",
        title="an environment without observation or action",
        explanation=(
            "Nothing is imported to check a spec, so the spec itself names what the environment shows, and the state "
            "whose value the environment is told at each step. bbsd spaces shows both and proposes names."
        ),
        example=f"{_WORLD}{_SHOWN}",
        mend=f"{_WORLD}{_SHOWN}{_TOLD}",
    ),
    DiagnosisKind(
        code="BB105",
        title="a key of an environment in Python, without one",
        explanation=(
            "with, observation and action say what is exchanged with an environment that is stepped in Python. A world "
            "that the spec itself describes has state, dynamics and sensors instead."
        ),
        example=f"environment:\n{_SHOWN}",
        mend=f"{_WORLD}{_SHOWN}{_TOLD}",
    ),
    DiagnosisKind(
        code="BB106",
        title="an action that is not a robot's state",
        explanation=(
            "The environment is told the values of state: behaviors' actions set it, and it stays where none controls. "
            "Each number that is sent is a state of its own, and a number, not a truth."
        ),
        example=f"{_WORLD}{_SHOWN}  action: tilt\n",
        mend=f"{_WORLD}{_SHOWN}{_TOLD}",
    ),
    DiagnosisKind(
        code="BB107",
        title="an observation that is set",
        explanation=(
            "Observations and earned come from the environment at each step. Actions and dynamics cannot set them; "
            "they can set state of the spec's own, and dynamics can keep in it what was observed."
        ),
        example=f"{_WORLD}{_SHOWN}{_TOLD}  dynamics:\n    x: x + 1",
        mend=f"{_WORLD}{_SHOWN}{_TOLD}  dynamics:\n    height: x + 1",
    ),
    DiagnosisKind(
        code="BB109",
        title="a size that is none",
        explanation=(
            "By sizes a discrete observation is taken apart into digits: {row: 5, column: 5} is row * 5 + column, each "
            "from 0 to 4. A size is a whole number, and where one name has a size, all have."
        ),
        example=f"{_WORLD}  observation:\n    row: 0\n    column: 5\n{_TOLD}",
        mend=f"{_WORLD}  observation:\n    row: 5\n    column: 5\n{_TOLD}",
    ),
    DiagnosisKind(
        code="BB110",
        title="not a path into an observation",
        explanation=(
            "A path leads to one number of an observation that is a mapping or a tuple: keys, with dots between them, "
            "and indices in brackets, counted from 0: image[3,5,0], pose.x, [0]. A text with brackets needs quotes "
            "within braces."
        ),
        example=f"{_WORLD}  observation:\n    ahead: image[3,-5,0]\n{_TOLD}",
        mend=f"{_WORLD}  observation:\n    ahead: image[3,5,0]\n{_TOLD}",
    ),
    DiagnosisKind(
        code="BB111",
        title="too many robots for the environment",
        explanation=(
            "A Gymnasium environment has one agent, and a robot is an agent. Several robots are the agents of a "
            "PettingZoo environment, or of a class of your own that is one."
        ),
        example=f"environment:\n  gymnasium: CartPole-v1\n{_SHOWN}{_TOLD}",
        mend=f"{_WORLD}{_SHOWN}{_TOLD}",
    ),
    DiagnosisKind(
        code="BB112",
        title="the reward of an environment that there is not",
        explanation=(
            "earned is what an environment that is stepped in Python rewards in a step. The world of this spec is its "
            "own, and what a step in it earns is written in reward."
        ),
        example="reward:\n  near: earned",
        mend="reward:\n  near: 1 if abs(height - 3) < 1 else 0",
    ),
)
