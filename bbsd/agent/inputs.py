"""What an agent must be given: names, kinds, cells; and how a value that a program gives becomes one."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product
from math import isfinite, prod
from typing import TYPE_CHECKING, Any, Literal, SupportsFloat

from bbsd.architecture.sayings import one_line, partition_text, start_text
from bbsd.errors import UsageError, did_you_mean
from bbsd.expression.kinds import Kind
from bbsd.language.meaning.tables.labels import Numbers

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping

    from bbsd.architecture.needs import Given
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.tables.labels import Labels

InputKind = Literal["number", "whole number", "truth", "cell", "name"]
FEW = 8
"""Cells that a message lists."""


class BadInput(UsageError):
    """A value that an agent was given and that is missing, unknown, or of a wrong kind."""


@dataclass(frozen=True, slots=True)
class AgentInput:
    """A value that an agent must be given before each decision.

    A `cell` is given by its label, or by its index where labels are no numbers; a `name` by itself, or by its index.
    """

    name: str
    kind: InputKind
    shape: tuple[int, ...]
    """() for a single value, else the lengths of the lists."""
    cells: Labels
    """The labels of a cell, or the names of which the value is one; empty for other kinds."""
    low: float | None
    """The least that it can be; None where the spec does not say so."""
    high: float | None
    text: str
    """What it is, as the spec writes it."""
    slots: tuple[Slot, ...]
    """Where it is stored in an episode, in row-major order."""

    @property
    def size(self) -> int:
        """The number of its values."""
        return prod(self.shape)

    @property
    def places(self) -> list[tuple[int, ...]]:
        """The indices of its values in the lists, in order."""
        return [*product(*map(range, self.shape))]

    @property
    def called(self) -> list[str]:
        """What its values are called, in order: `sonar[3]` where it is a list."""
        return [self.name + "".join(f"[{index}]" for index in place) for place in self.places]

    def read(self, value: object, called: str) -> float | bool | int:
        """Return one of its values as it is stored. Raises BadInput where it is of another kind."""
        match self.kind:
            case "truth":
                return _truth(value, called)
            case "cell":
                return self._cell(value, called)
            case "name":
                return float(self._cell(value, called))
        return self._number(value, called)

    def _number(self, value: object, called: str) -> float:
        is_list = getattr(value, "shape", ()) != ()
        if is_list or isinstance(value, bool | str | bytes) or not isinstance(value, SupportsFloat):
            raise BadInput(f"{called}: {value!r} is no number")
        try:
            number = float(value)
        except (TypeError, ValueError) as error:
            raise BadInput(f"{called}: {value!r} is no number") from error
        except OverflowError as error:
            raise BadInput(f"{called}: a number is given that is beyond binary64") from error
        if self.kind == "whole number" and isfinite(number) and not number.is_integer():
            raise BadInput(f"{called}: {value!r} is no whole number")
        return number

    def _cell(self, value: object, called: str) -> int:
        plain = plain_value(value)
        label = str(plain).lower() if isinstance(plain, bool) else str(plain)
        if label in self.cells:
            return self.cells.index(label)
        if isinstance(plain, float) and plain.is_integer() and self.kind == "name":
            plain = int(plain)
        if isinstance(plain, int) and not isinstance(plain, bool) and self._has_named(plain):
            return plain
        few = ", ".join(self.cells[:FEW]) + (", ..." if len(self.cells) > FEW else "")
        what = "values" if self.kind == "name" else "cells"
        raise BadInput(
            f"{called}: {plain!r} is none of its {what}{did_you_mean(label, self.cells[:100])}: {few}"
        )

    def _has_named(self, index: int) -> bool:
        return not isinstance(self.cells, Numbers) and 0 <= index < len(self.cells)


def _truth(value: object, called: str) -> bool:
    plain = plain_value(value)
    if isinstance(plain, bool | int | float) and plain in (0, 1):
        return bool(plain)
    raise BadInput(f"{called}: {value!r} is neither true nor false")


def plain_value(value: object) -> object:
    """Return a scalar of numpy as one of Python, anything else as it is."""
    item = getattr(value, "item", None)
    return item() if callable(item) and getattr(value, "shape", None) == () else value


def inputs_of(
    meaning: Meaning, given: tuple[Given, ...], read: Collection[Slot], whole: Collection[Slot], robot: int
) -> dict[str, AgentInput]:
    """Return the inputs of a robot by name: what is given, as far as it is read."""
    inputs = (_input(meaning, each, whole, robot) for each in given)
    return {each.name: each for each in inputs if any(slot in read for slot in each.slots)}


def _input(meaning: Meaning, given: Given, whole: Collection[Slot], robot: int) -> AgentInput:
    slots = tuple(
        slot if given.of_team or slot.robot is None else slot._replace(robot=robot) for slot in given.slots
    )
    lengths = [max(place) + 1 for place in zip(*(slot.place for slot in slots), strict=True)]
    team = [meaning.spec.environment.robots] if given.of_team else []
    low, high = _range(meaning, given.name)
    cells = meaning.episode.labels(given.name)
    kind: InputKind = "whole number" if slots[0] in whole else "number"
    if cells:
        kind = "name" if given.name in meaning.episode.named else "cell"
    elif meaning.episode.after[slots[0]].kind is Kind.TRUTH:
        kind = "truth"
    return AgentInput(
        given.name, kind, (*team, *lengths), cells, low, high, _text(meaning, given.name), slots
    )


def _range(meaning: Meaning, name: str) -> tuple[float | None, float | None]:
    """Return the bounds of an observation that is one of so many numbers; None where nothing is known."""
    outside = meaning.spec.environment.outside
    sizes: Mapping[str, int | None] = (
        {} if outside is None else {each.name: each.size for each in outside.fields}
    )
    size = sizes.get(name)
    return (None, None) if size is None else (0.0, size - 1.0)


def _text(meaning: Meaning, name: str) -> str:
    environment = meaning.spec.environment
    if name in environment.sensors:
        return partition_text(environment.sensors[name])
    if environment.outside is not None and name in environment.outside.names:
        return f"observation of {environment.outside.target}"
    is_world = name in environment.world
    start = start_text((environment.world if is_world else environment.state)[name])
    then = f", then {one_line(environment.dynamics[name])}" if name in environment.dynamics else ""
    return f"{'world' if is_world else 'state'}: {start}{then}"


def complaint(
    inputs: Mapping[str, AgentInput], known: Collection[str], given: Mapping[str, Any]
) -> BadInput | None:
    """Return what is wrong with the names and the shapes of what an agent is given; None if nothing is."""
    if problem := complaint_of_names(inputs, known, given):
        return problem
    for each in inputs.values():
        if each.shape and not _has_shape(given[each.name], each.shape):
            lengths = " by ".join(map(str, each.shape))
            return BadInput(f"{each.name}: {lengths} values are needed, not {given[each.name]!r}")
    return None


def complaint_of_names(
    inputs: Mapping[str, AgentInput], known: Collection[str], given: Mapping[str, Any]
) -> BadInput | None:
    """Return what is wrong with the names of what an agent is given; None if nothing is."""
    if not hasattr(given, "keys"):
        return BadInput(f"a mapping of names to values is needed, not {given!r}")
    for name in given:
        if name not in known:
            return _named(f"there is no {name!r}{did_you_mean(str(name), inputs)}", inputs)
    if missing := [name for name in inputs if name not in given]:
        return _named(f"missing: {', '.join(missing)}", inputs)
    return None


def _named(message: str, inputs: Mapping[str, AgentInput]) -> BadInput:
    error = BadInput(message)
    error.advice = f"the inputs are {', '.join(inputs) or 'none'}"
    return error


def _has_shape(value: Any, shape: tuple[int, ...]) -> bool:  # noqa: ANN401 - whatever was given
    if not shape:
        return True
    try:
        items = [*value]
    except TypeError:
        return False
    return len(items) == shape[0] and all(_has_shape(item, shape[1:]) for item in items)
