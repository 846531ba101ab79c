"""Names that are proposed for what an environment shows and takes."""

from __future__ import annotations

import json
from math import isinf, prod
from typing import TYPE_CHECKING, NamedTuple

from bbsd.environments.spaces.kinds import Box, Discrete, MultiDiscrete, Several, count, leaves, path_text
from bbsd.language.field_types import is_value_name

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from bbsd.environments.spaces.kinds import Space
    from bbsd.language.outside import ObservationPath

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
"""Numbers of an observation up to which each is proposed a name."""


class Proposal(NamedTuple):
    """A name for a number of an observation: its size or its path where the spec says it, and what it may be."""

    name: str
    source: str
    comment: str


def proposals(space: Space, name: str = "") -> list[Proposal]:
    """Return names for the numbers of an observation, in a list or, where they have sources, in a mapping.

    Args:
        space: the space of observations.
        name: the environment's name without version, for names that are known.
    """
    sizes, known, n_numbers = SIZES.get(name, {}), KNOWN.get(name, ()), count(space)
    if isinstance(space, Discrete) and sizes and prod(sizes.values()) == space.n:
        return [Proposal(key, str(size), f"0 to {size - 1}") for key, size in sizes.items()]
    texts = None if n_numbers is None or n_numbers > MOST_LISTED else _range_texts(space)
    if texts is None or not _is_flat(space):
        return _by_path(space)
    names = known if len(known) == len(texts) else [f"value_{index + 1}" for index in range(len(texts))]
    names = ["place"] if isinstance(space, Discrete) and not known else names
    return [Proposal(each, "", text) for each, text in zip(names, texts, strict=True)]


def observation_text(space: Space, name: str = "") -> str:
    """Return what may be written as `observation`, in one line of YAML."""
    found = proposals(space, name)
    if any(proposal.source for proposal in found):
        return f"{{{', '.join(f'{each.name}: {each.source}' for each in found)}}}"
    return f"[{', '.join(each.name for each in found)}]"


def action_names(n_values: int, taken: Sequence[str] = ()) -> list[str]:
    """Return names that are proposed for the state that is sent; none is one of those taken."""
    word = "command" if "command" not in taken else "sent"
    return [word] if n_values == 1 else [f"{word}_{index + 1}" for index in range(n_values)]


def range_text(space: Space, index: int) -> str:
    """Return in words which values a number of a space has."""
    match space:
        case Discrete(n, start):
            return f"{start} to {start + n - 1}"
        case MultiDiscrete(ns, starts):
            return range_text(Discrete(ns[index], starts[index]), 0)
        case Box(_, lows, highs):
            low, high = lows[index], highs[index]
            if isinf(low) and isinf(high):
                return "any number"
            if isinf(low) or isinf(high):
                return f"at most {high:.7g}" if isinf(low) else f"{low:.7g} or more"
            return f"{low:.7g} to {high:.7g}"
    return str(space)


def _is_flat(space: Space) -> bool:
    """Say whether a space is one array, one number, or single numbers one after another."""
    match space:
        case Several(parts):
            return all(isinstance(part, Discrete) for part in parts)
        case Box(shape) | MultiDiscrete(shape=shape):
            return len(shape) <= 1
    return isinstance(space, Discrete)


def _range_texts(space: Space) -> list[str]:
    return [range_text(leaf, index) for _, leaf in leaves(space) for index in range(_size(leaf))]


def _size(leaf: Space) -> int:
    return count(leaf) or 0


def _by_path(space: Space) -> list[Proposal]:
    """Return a name and a path for each part that is a number, and for the first number of each array."""
    found: list[Proposal] = []
    for path, leaf in leaves(space):
        if not _size(leaf):
            continue
        shape = leaf.shape if isinstance(leaf, Box | MultiDiscrete) else ()
        comment = range_text(leaf, 0)
        if shape:
            comment = f"the first of {' x '.join(map(str, shape))} numbers, {comment}"
        name = _name(path, [proposal.name for proposal in found])
        found.append(Proposal(name, json.dumps(path_text((*path, *(0 for _ in shape)))), comment))
    return found


def _name(path: ObservationPath, taken: Sequence[str]) -> str:
    """Return a name that a spec may have, made of a path; another one than those taken."""
    text = "_".join(str(segment).lower() for segment in path) or "first"
    text = "".join(letter if letter.isascii() and letter.isalnum() else "_" for letter in text)
    name = text if is_value_name(text) else f"part_{text}"
    if not is_value_name(name):
        name = "part"
    return name if name not in taken else f"{name}_{len(taken) + 1}"
