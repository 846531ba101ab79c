"""Names that are proposed for what an environment shows and takes."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.environments.spaces.kinds import Box, Discrete, MultiDiscrete, count, leaves, path_text
from bbsd.language.field_types import is_value_name

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.environments.spaces.kinds import Space

KNOWN: Mapping[str, tuple[str, ...]] = {
    "Acrobot": ("cos_1", "sin_1", "cos_2", "sin_2", "speed_1", "speed_2"),
    "Blackjack": ("own_sum", "shown", "ace"),
    "CartPole": ("position", "speed", "angle", "tip_speed"),
    "LunarLander": ("x", "y", "x_speed", "y_speed", "angle", "turning", "left_leg", "right_leg"),
    "LunarLanderContinuous": ("x", "y", "x_speed", "y_speed", "angle", "turning", "left_leg", "right_leg"),
    "MountainCar": ("position", "speed"),
    "MountainCarContinuous": ("position", "speed"),
    "Pendulum": ("cos_angle", "sin_angle", "speed"),
}
"""Names for the numbers of well-known environments, by the name in their ids."""
SIZES: Mapping[str, Mapping[str, int]] = {
    "CliffWalking": {"row": 4, "column": 12},
    "CliffWalkingSlippery": {"row": 4, "column": 12},
    "FrozenLake": {"row": 4, "column": 4},
    "FrozenLake8x8": {"row": 8, "column": 8},
    "Taxi": {"row": 5, "column": 5, "passenger": 5, "goal": 4},
}
"""What the single number of well-known environments is packed of, the first the most significant."""
MOST_LISTED = 32
"""Numbers of an array that are each proposed a name in a mapping of paths."""


def observation_text(space: Space, name: str = "") -> str:
    """Return what may be written as `observation`, in one line of YAML.

    Args:
        space: the space of observations.
        name: the environment's name without version, for names that are known.
    """
    sizes, known, n_numbers = SIZES.get(name, {}), KNOWN.get(name, ()), count(space)
    if isinstance(space, Discrete):
        product = 1
        for size in sizes.values():
            product *= size
        return _mapping(sizes) if product == space.n else "[place]"
    if len(known) == n_numbers:
        return f"[{', '.join(known)}]"
    if isinstance(space, Box | MultiDiscrete):
        if len(space.shape) > 1 and n_numbers is not None and n_numbers > MOST_LISTED:
            first = tuple(0 for _ in space.shape)
            return _mapping({"first": f'"{path_text(first)}"'})
        return _names(n_numbers or 0)
    return _mapping(_paths(space))


def action_names(n_values: int) -> list[str]:
    """Return names that are proposed for the state that is sent."""
    return ["command"] if n_values == 1 else [f"command_{index + 1}" for index in range(n_values)]


def _names(n_numbers: int) -> str:
    return f"[{', '.join(f'value_{index + 1}' for index in range(n_numbers))}]"


def _paths(space: Space) -> dict[str, str]:
    """Return a name and a path for each part that is a number, and for the first number of each array."""
    found: dict[str, str] = {}
    for path, leaf in leaves(space):
        if isinstance(leaf, Discrete):
            found[_name(path, found)] = f'"{path_text(path)}"'
        elif isinstance(leaf, Box | MultiDiscrete):
            found[_name(path, found)] = f'"{path_text((*path, *(0 for _ in leaf.shape)))}"'
    return found


def _name(path: tuple[str | int, ...], taken: dict[str, str]) -> str:
    text = "_".join(str(segment).lower() for segment in path)
    text = "".join(
        letter if letter.isascii() and (letter.isalnum() or letter == "_") else "_" for letter in text
    )
    name = text if is_value_name(text) else f"part_{text}"
    while name in taken or not is_value_name(name):
        name = f"part_{len(taken) + 1}" if not is_value_name(name) else f"{name}_{len(taken) + 1}"
    return name


def _mapping(items: Mapping[str, object]) -> str:
    return f"{{{', '.join(f'{key}: {value}' for key, value in items.items())}}}"
