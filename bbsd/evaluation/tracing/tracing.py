"""How the trace of one episode is made."""

from __future__ import annotations

from dataclasses import replace
from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.compiler.details import traced_columns
from bbsd.evaluation.tracing.decisions import decisions_of, layers_of
from bbsd.evaluation.tracing.scene import scene, starting_values, values_of
from bbsd.evaluation.tracing.traced import Trace
from bbsd.expression.kinds import Kind
from bbsd.language.meaning.proofs.whole_numbers import whole_values
from bbsd.language.meaning.situation import definitions_at_the_start

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.compiler.details import Column
    from bbsd.evaluation.tracing.scene import Scene
    from bbsd.evaluation.tracing.traced import Floats, Value
    from bbsd.expression.node_data import Slot
    from bbsd.language.meaning import Meaning

EXPECTATION = ("", "failed", "held")
"""The meaning of the numbers 0, 1, 2 in a record."""


def trace(problem: Problem, architecture: Architecture, key: int, generation: int) -> Trace:
    """Run one episode as plain Python and record everything."""
    meaning, steps = problem.meaning, problem.meaning.spec.environment.steps
    columns = traced_columns(meaning)
    record = np.full((steps, len(columns)), np.nan)
    pools = tuple(table[None] for table in architecture.tables)
    members = np.zeros((1, problem.n_behaviors), np.int64)
    team = problem.assemble(pools, members, generation)
    record = record[: team.traced_episode(key, architecture.structure, record)]
    constants = meaning.constants.vector(generation)
    start = starting_values(meaning, key, constants, _observed(problem, key))
    traced = Trace(
        steps=np.arange(1, len(record) + 1),
        **_read(problem, columns, record, _with_definitions(start, meaning, constants)),
        robots=meaning.spec.environment.robots,
        named=meaning.episode.named,
        decisions=decisions_of(problem, architecture, columns, record),
        layers=layers_of(meaning.episode.modules, architecture.structure),
    )
    return replace(traced, scene=_scene(columns, record, meaning, start, constants))


def _observed(problem: Problem, key: int) -> dict[Slot, float]:
    """Return what an environment that is stepped in Python shows at the start of an episode; nothing without one."""
    slots = problem.meaning.episode.outside
    if not slots or problem.stepper is None:
        return {}
    outside = np.zeros((len(slots), 1))
    problem.stepper().reset(np.array([0]), np.array([key], np.uint64), outside)
    return dict(zip(slots, outside[:, 0].tolist(), strict=True))


def _with_definitions(
    start: dict[Slot, float], meaning: Meaning, constants: Sequence[float]
) -> dict[Slot, float]:
    nodes = definitions_at_the_start(meaning)
    return {**start, **dict(zip(nodes, values_of([*nodes.values()], start, 0, constants), strict=True))}


def _scene(
    columns: list[Column],
    record: Floats,
    meaning: Meaning,
    start: dict[Slot, float],
    constants: Sequence[float],
) -> Scene | None:
    if meaning.episode.picture is None:
        return None
    stored = {column.slot: index for index, column in enumerate(columns) if column.content == "slot"}
    later = [dict(zip(stored, row, strict=True)) for row in record[:, [*stored.values()]].tolist()]
    return scene(meaning.episode.picture, [start, *later], constants)


def _read(
    problem: Problem, columns: list[Column], record: Floats, start: dict[Slot, float]
) -> dict[str, Any]:
    """Return the columns of a record and the starting values, as the arguments of a trace."""
    names = [("nobody", "")]
    names += [
        (behavior.name, action) for behavior in problem.meaning.episode.modules for action in behavior.actions
    ]
    as_value = _reader(problem.meaning)
    read: dict[str, Any] = {"values": {}, "start": {}, "controlling": [], "actions": [], "rewards": {}}
    read["expectations"] = []
    for (content, slot), column in zip(columns, record.T, strict=True):
        match content:
            case "choice":
                read["controlling"].append([names[int(number)][0] for number in column])
                read["actions"].append([names[int(number)][1] for number in column])
            case "expectation":
                read["expectations"].append([EXPECTATION[int(number)] for number in column])
            case "reward":
                read["rewards"].setdefault(slot.name, []).append(column)
            case "slot" | "definition":
                read["values"][slot] = [as_value(slot, number) for number in column.tolist()]
                read["start"][slot] = as_value(slot, start[slot])
    return read


def _reader(meaning: Meaning) -> Callable[[Slot, float], Value]:
    """Return the function that makes a recorded number what it is: a truth, a cell's label, a name, a whole number."""
    episode = meaning.episode
    kinds = {slot: node.kind for slot, node in (*episode.after.items(), *episode.definitions.items())}
    whole = whole_values(episode, meaning.constants)

    def as_value(slot: Slot, number: float) -> Value:
        if kinds[slot] is Kind.TRUTH:
            return bool(number)
        if labels := episode.labels(slot.name):
            return labels[int(number)]
        return int(number) if slot in whole and isfinite(number) else number

    return as_value
