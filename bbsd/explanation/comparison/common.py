"""What two specs have in common: whether they move in the same world, and which behaviors are the same."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from pydantic import BaseModel

from bbsd.expression.syntax.text import render
from bbsd.language.field_types import Expression

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from bbsd.language.loading import Loaded
    from bbsd.language.models import Behavior

PARTS = ("robots", "steps", "ends")
WORLD = {"world": "world", "state": "state", "dynamics": "dynamics of"}
SENSES = {"sensors": "sensor", "definitions": "definition"}
"""Blocks of an environment with entries, and what an entry is called."""
DECISION_PARTS = ("inputs", "excited", "actions")
"""What makes a behavior the same as another, whatever its rules say."""


def world_differences(one: Loaded, other: Loaded) -> tuple[str, ...]:
    """Return in words what makes two specs worlds of their own; empty where the same episode begins and goes on alike.

    What robots sense, and what constants are, is no part of it.
    """
    return tuple(_environment_differences(one, other, WORLD, PARTS))


def sense_differences(one: Loaded, other: Loaded) -> tuple[str, ...]:
    """Return the sensors, definitions and constants, in words, that two specs both have and that are not the same."""
    values = [_constants(loaded) for loaded in (one, other)]
    constants = (f"constant {name}" for name in _different(*values, may_have_more=True))
    return (*_environment_differences(one, other, SENSES, ()), *constants)


def _environment_differences(
    one: Loaded, other: Loaded, blocks: Mapping[str, str], parts: Sequence[str]
) -> Iterator[str]:
    environments = one.spec.environment, other.spec.environment
    for part in parts:
        if len({_meant(getattr(environment, part)) for environment in environments}) > 1:
            yield part
    for block, noun in blocks.items():
        entries = [getattr(environment, block) for environment in environments]
        for name in _different(*entries, may_have_more=block in SENSES):
            yield f"{noun} {name}"


def reward_differences(one: Loaded, other: Loaded) -> tuple[str, ...]:
    """Return the reward terms that are not the same in two specs."""
    return tuple(_different(one.spec.reward, other.spec.reward, may_have_more=False))


def definition_differences(one: Behavior, other: Behavior) -> tuple[str, ...]:
    """Return in which of inputs, excitement and actions two behaviors differ."""
    return tuple(
        part for part in DECISION_PARTS if _meant(getattr(one, part)) != _meant(getattr(other, part))
    )


def _different(one: Mapping[str, Any], other: Mapping[str, Any], *, may_have_more: bool) -> Iterator[str]:
    for name in dict.fromkeys([*one, *other]):
        if name in one and name in other:
            if _meant(one[name]) != _meant(other[name]):
                yield name
        elif not may_have_more:
            yield name


def _constants(loaded: Loaded) -> dict[str, str]:
    """Return the values of constants as texts, those that depend on the generation as they are written."""
    constants, written = loaded.meaning.constants, loaded.spec.constants
    values = {name: constants.plain(name) for name in constants.values}
    return {
        name: repr(_meant(written[name]) if "None" in repr(value) else value)
        for name, value in values.items()
    }


def _meant(value: object) -> object:
    """Return what a part of a spec says, without layout, as something that can be compared and hashed."""
    match value:
        case Expression():
            return render(value.tree)
        case BaseModel():
            return tuple((name, _meant(getattr(value, name))) for name in type(value).model_fields)
        case dict():
            return tuple((name, _meant(item)) for name, item in value.items())
        case list() | tuple():
            return tuple(map(_meant, value))
        case _:
            return value
