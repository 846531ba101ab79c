"""A situation as somebody describes it: world and state by name, and the sensors that do not follow from these."""

from __future__ import annotations

from math import isfinite
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from bbsd.errors import UsageError, did_you_mean
from bbsd.explanation.why.situation import Listed, Situation, require_robot, values_of_robot
from bbsd.expression.graph import evaluate, needed
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.language.meaning.situation import modules_in_a_situation, uncertain_sensors

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from bbsd.evaluation.tracing.traced import Value
    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module

Given: TypeAlias = "float | int | bool | str | list[Given]"
"""A value, or a list: one for each robot, or of what a sensor gives, or both."""
STEP = "step"


class BadSituation(UsageError):
    """A situation that is described wrongly, or too little of it."""


def described_situation(
    meaning: Meaning, given: Mapping[str, Given], robot: int, generation: int
) -> Situation:
    """Return the situation of a robot where world, state and sensors have values given by name.

    A value of the state or of a sensor is for all robots, or a list with one for each. Sensors that are not given are
    computed from world and state.

    Raises:
        BadSituation: a name is unknown, a value has a wrong form, or some that are needed are missing.
        NoSuchMoment: the team has no such robot.
    """
    environment = meaning.spec.environment
    require_robot(robot, environment.robots)
    known = [*environment.world, *environment.of_each_robot, *environment.sensors, STEP]
    for name in given:
        if name not in known:
            raise BadSituation(_unknown(meaning, name, known))
    modules = modules_in_a_situation(meaning, [name for name in given if name in environment.sensors])
    nodes = [node for module in modules for node in (module.excited[robot], *module.cells[robot])]
    stored = _stored(meaning, given)
    _require_all(meaning, nodes, stored, given)
    shown = {slot: _shown(meaning, slot, value) for slot, value in stored.items()}
    values = _evaluated(nodes, stored, given.get(STEP, 0), meaning.constants.vector(generation))
    return _situation(modules, values, values_of_robot(shown, robot))


def _unknown(meaning: Meaning, name: str, known: Sequence[str]) -> str:
    owners = [module.name for module in meaning.episode.modules if name in module.inputs]
    if owners:
        return f"{name} is an input of {owners[0]}, computed from world, state and sensors: give those"
    return f"{name} is no state, world or sensor{did_you_mean(name, known)}"


def _situation(modules: Sequence[Module], values: Sequence[Any], shown: Mapping[str, Listed]) -> Situation:
    """Read from the values whether each behavior is excited, and the index of its cell: row-major over the inputs."""
    excited, cells, left = list[bool](), list[int](), [*values]
    for module in modules:
        excited.append(bool(left.pop(0)))
        cell = 0
        for labels in module.inputs.values():
            cell = cell * len(labels) + int(left.pop(0))
        cells.append(cell)
    return Situation(tuple(excited), tuple(cells), shown)


def _evaluated(
    nodes: Iterable[Node], stored: Mapping[Slot, float], step: Given, constants: Sequence[float]
) -> list[Any]:
    def leaf(node: Node, operands: list[Any]) -> Any:  # noqa: ANN401 - a number, a truth or a cell index
        match node.operation:
            case "slot":
                value = stored[node.slot]
                return {Kind.TRUTH: bool, Kind.CELL: int}.get(node.kind, float)(value)
            case "step":
                return float(step) if isinstance(step, int | float) else float("nan")
        return node.read(constants, operands)

    with np.errstate(all="ignore"):
        return evaluate(nodes, leaf)


def _stored(meaning: Meaning, given: Mapping[str, Given]) -> dict[Slot, float]:
    """Return the given values by slot; labels as indices of their cells, truths as 0 and 1."""
    episode, robots = meaning.episode, meaning.spec.environment.robots
    stored: dict[Slot, float] = {}
    for name, value in given.items():
        if name == STEP:
            if not _is_number(value):
                raise BadSituation(f"step: {value!r} is no number")
            continue
        slots = [slot for slot in episode.after if slot.name == name and not slot.robot]
        depth, is_own = len(slots[0].place), slots[0].robot is not None
        for robot, own in enumerate(_by_robot(name, value, robots, depth) if is_own else [value]):
            for each in slots:
                slot = each._replace(robot=robot) if is_own else each
                stored[slot] = _number(meaning, slot, _item(name, own, slot.place))
            if depth and _size(own) != len(slots):
                raise BadSituation(f"{name}: {own!r} must have {len(slots)} values")
    return stored


def _by_robot(name: str, value: Given, robots: int, n_dimensions: int) -> Sequence[Given]:
    """Return each robot's value: the one that is for all, or its own from a list that is deeper by one."""
    depth, inner = 0, value
    while isinstance(inner, list) and inner:
        depth, inner = depth + 1, inner[0]
    if depth == n_dimensions:
        return [value] * robots
    if depth == n_dimensions + 1 and isinstance(value, list):
        if len(value) != robots:
            raise BadSituation(f"{name}: there are {robots} robots, and {len(value)} values are given")
        return value
    form = "one value" if not n_dimensions else "one list"
    raise BadSituation(f"{name}: {form} for all robots is needed, or a list with one for each")


def _size(value: Given) -> int:
    return sum(map(_size, value)) if isinstance(value, list) else 1


def _item(name: str, value: Given, place: tuple[int, ...]) -> Given:
    for index in place:
        if not isinstance(value, list) or index >= len(value):
            raise BadSituation(f"{name}: {value!r} has too few values")
        value = value[index]
    return value


def _is_number(value: Given) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool)


def _number(meaning: Meaning, slot: Slot, value: Given) -> float:
    """Return a given value as it is stored. Raises BadSituation where it is of another kind."""
    labels = _labels(meaning, slot)
    if labels:
        label = str(value).lower() if isinstance(value, bool) else str(value)
        if label not in labels:
            few = ", ".join(labels[:8])
            what = "values" if slot.name in meaning.episode.named else "cells"
            raise BadSituation(
                f"{slot.name}: {label!r} is none of its {what}{did_you_mean(label, labels)}: {few}"
            )
        return float(labels.index(label))
    if meaning.episode.after[slot].kind is Kind.TRUTH:
        if not isinstance(value, bool):
            raise BadSituation(f"{slot.name}: {value!r} is neither true nor false")
        return float(value)
    if not isinstance(value, int | float) or isinstance(value, bool):
        raise BadSituation(f"{slot.name}: {value!r} is no number")
    if not isfinite(value):
        raise BadSituation(f"{slot.name}: {value!r} is not finite")
    return float(value)


def _labels(meaning: Meaning, slot: Slot) -> Sequence[str]:
    return meaning.episode.labels(slot.name)


def _shown(meaning: Meaning, slot: Slot, value: float) -> Value:
    if labels := _labels(meaning, slot):
        return labels[int(value)]
    return bool(value) if meaning.episode.after[slot].kind is Kind.TRUTH else value


def _require_all(
    meaning: Meaning, nodes: Iterable[Node], stored: Mapping[Slot, float], given: Mapping[str, Given]
) -> None:
    """Raise BadSituation where a value that decides is not given, and tell all of these by name."""
    leaves = [node for node in needed(nodes) if node.operation in ("slot", "step")]
    missing = dict.fromkeys(
        node.slot.name for node in leaves if node.operation == "slot" and node.slot not in stored
    )
    if STEP not in given and any(node.operation == "step" for node in leaves):
        missing[STEP] = None
    if not missing:
        return
    uncertain = [name for name in missing if name in uncertain_sensors(meaning.spec)]
    why = f" (of sensors, those that draw or use before: {', '.join(uncertain)})" if uncertain else ""
    error = BadSituation(f"what decides is not all given: {', '.join(missing)}{why}")
    error.advice = "add " + " ".join(f"--at {name}=..." for name in missing)
    raise error
