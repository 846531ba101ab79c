"""Whether a spec's observation and actions fit the spaces of its environment, and what to write where they do not."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, NamedTuple

from bbsd.environments.spaces.kinds import (
    Box,
    Discrete,
    Mapping,
    MultiDiscrete,
    Several,
    Space,
    count,
    is_one_number,
    leaves,
    path_text,
)
from bbsd.environments.spaces.misfits import Misfit, Path
from bbsd.environments.spaces.naming import observation_text
from bbsd.environments.spaces.sending import n_sent, taken_text, takes
from bbsd.errors import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from bbsd.language.outside import Field, ObservationPath, Outside

OBSERVATION: Path = ("environment", "observation")
ACTION: Path = ("environment", "action")
MOST_NAMED = 8
"""Parts of a space that a message names."""


class Setting(NamedTuple):
    """A literal value that the spec gives to a name, and where it does so."""

    name: str
    value: float
    path: Path


def misfits(
    outside: Outside, observed: Space, taken: Space | None, settings: Iterable[Setting], label: str = ""
) -> list[Misfit]:
    """Return where a spec does not fit the spaces of its environment; none where all fits.

    Args:
        outside: what the spec says of the environment.
        observed: the space of observations.
        taken: the space of actions; None where the environment names none.
        settings: the literal values that the spec gives to state.
        label: the environment's name without version, for names that are proposed.
    """
    found = [*_observation_misfits(outside.fields, observed, label), *_action_misfits(outside.actions, taken)]
    if taken is not None and n_sent(taken) == len(outside.actions):
        found += _value_misfits(outside.actions, taken, settings)
    return found


def _observation_misfits(fields: Sequence[Field], space: Space, label: str) -> Iterator[Misfit]:
    with_path = [field for field in fields if field.path is not None]
    with_size = [field for field in fields if field.size is not None]
    if with_path:
        for field in with_size:
            yield Misfit(
                "BB115", (*OBSERVATION, field.name), "sizes and paths cannot be mixed", "give its path"
            )
        for field in with_path:
            yield from _path_misfits(field.name, field.path or (), space)
    elif with_size:
        yield from _size_misfits(fields, space, label)
    else:
        yield from _list_misfits(len(fields), space, label)


def _list_misfits(n_names: int, space: Space, label: str) -> Iterator[Misfit]:
    n_numbers = count(space)
    proposal = f"write observation: {observation_text(space, label)}"
    if n_numbers is None:
        yield Misfit("BB116", OBSERVATION, f"an observation is {space}, which is not all numbers", proposal)
    elif n_numbers != n_names:
        names = f"{n_names} name{'s' * (n_names != 1)}"
        message = (
            f"an observation has {n_numbers} number{'s' * (n_numbers != 1)}, {space}, and there are {names}"
        )
        yield Misfit("BB113", OBSERVATION, message, proposal)


def _size_misfits(fields: Sequence[Field], space: Space, label: str) -> Iterator[Misfit]:
    sizes = [field.size or 1 for field in fields]
    wanted = _sizes_of(space)
    proposal = f"write observation: {observation_text(space, label)}"
    if isinstance(space, Discrete):
        if prod(sizes) != space.n:
            product = " * ".join(map(str, sizes)) + (f" = {prod(sizes)}" if len(sizes) > 1 else "")
            message = f"an observation is one of {space.n} numbers, and the sizes are for {product}"
            yield Misfit(
                "BB115", OBSERVATION, message, "the product of the sizes must be the number of values"
            )
    elif wanted is None:
        message = f"an observation is {space}, of which no whole numbers with a size can be made"
        yield Misfit("BB115", OBSERVATION, message, proposal)
    elif wanted != sizes:
        message = f"the numbers of an observation have the sizes {wanted}, not {sizes}"
        yield Misfit("BB115", OBSERVATION, message, proposal)


def _sizes_of(space: Space) -> list[int] | None:
    """Return the sizes of a space of whole numbers from 0; None for any other."""
    match space:
        case MultiDiscrete() if not any(space.starts):
            return list(space.ns)
        case Several(parts) if all(isinstance(part, Discrete) and not part.start for part in parts):
            return [part.n for part in parts if isinstance(part, Discrete)]
    return None


def _path_misfits(name: str, path: ObservationPath, space: Space) -> Iterator[Misfit]:
    problem = _path_problem(path, space)
    if problem is not None:
        message, advice = problem
        yield Misfit("BB114", (*OBSERVATION, name), message, advice)


def _path_problem(path: ObservationPath, space: Space) -> tuple[str, str] | None:
    """Return why a path leads to no number, and what to do; None where it leads to one."""
    for place, segment in enumerate(path):
        before, known = path_text(path[:place]) or "an observation", _parts(space)
        match space:
            case Mapping(parts):
                if segment not in dict(parts):
                    hint = did_you_mean(str(segment), known)
                    return f"{before} has no part {segment!r}{hint}", f"its parts are {_listed(known)}"
                space = dict(parts)[str(segment)]
            case Several(several):
                if not isinstance(segment, int) or segment >= len(several):
                    return f"{before} has no part {segment!r}", f"its parts are {_listed(known)}"
                space = several[segment]
            case Box(shape) | MultiDiscrete(shape=shape):
                return _index_problem(path[place:], shape, before)
            case _:
                return f"{before} is {space}, which has no parts", "end the path there"
    if is_one_number(space):
        return None
    return (
        f"{path_text(path)} is {space}, not a number",
        f"lead on to one, such as {_first_number(path, space)}",
    )


def _index_problem(rest: ObservationPath, shape: tuple[int, ...], before: str) -> tuple[str, str] | None:
    indices = [segment for segment in rest if isinstance(segment, int)]
    if len(indices) < len(rest) or len(rest) != len(shape):
        text = path_text(tuple(rest))
        return f"{before} has the shape {shape}, in which {text} is no number", f"give {len(shape)} indices"
    for index, length in zip(indices, shape, strict=True):
        if index >= length:
            return f"{before} has the shape {shape}, in which there is no [{index}]", "indices count from 0"
    return None


def _parts(space: Space) -> list[str]:
    match space:
        case Mapping(parts):
            return [key for key, _ in parts]
        case Several(several):
            return [f"[{index}]" for index in range(len(several))]
    return []


def _listed(names: Sequence[str]) -> str:
    more = len(names) - MOST_NAMED
    return ", ".join(names[:MOST_NAMED]) + (f" and {more} more" if more > 0 else "")


def _first_number(path: ObservationPath, space: Space) -> str:
    for inner, leaf in leaves(space, tuple(path)):
        if isinstance(leaf, Discrete):
            return path_text(inner)
        if isinstance(leaf, Box | MultiDiscrete):
            return path_text((*inner, *(0 for _ in leaf.shape)))
    return "another part"


def _action_misfits(actions: Sequence[str], space: Space | None) -> Iterator[Misfit]:
    n_values = n_sent(space)
    if n_values == 0:
        yield Misfit("BB119", ACTION, f"the environment takes {space}, which is not made of numbers")
    elif n_values is not None and n_values != len(actions):
        values = "one number" if n_values == 1 else f"{n_values} numbers"
        names = f"{len(actions)} name{'s' * (len(actions) != 1)}"
        advice = "name one state" if n_values == 1 else f"write a list of {n_values} names of state"
        yield Misfit(
            "BB117", ACTION, f"the environment takes {values}, {space}, and there are {names}", advice
        )


def _value_misfits(actions: Sequence[str], space: Space, settings: Iterable[Setting]) -> Iterator[Misfit]:
    for setting in settings:
        if setting.name not in actions:
            continue
        index = actions.index(setting.name)
        if not takes(space, index, setting.value):
            taken = taken_text(space, index)
            message = f"{setting.name} is {setting.value:.7g} here, and the environment takes {taken}"
            yield Misfit("BB118", setting.path, message)
