"""The trace of one episode, step by step: stored and defined values, controlling behaviors, reward terms."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.compiler.details import traced_columns
from bbsd.evaluation.decisions import decisions_of
from bbsd.evaluation.scene import Scene, scene, starting_values
from bbsd.expression.node_data import Slot
from bbsd.language.meaning.partitions import is_partition

if TYPE_CHECKING:
    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.compiler.details import Column
    from bbsd.evaluation.decisions import Decisions
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.tables.labels import Labels

EXPECTATION = ("", "failed", "held")
"""The meaning of the numbers 0, 1, 2 in a record."""

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Trace:
    """An episode as columns of equal length, one entry a step.

    `values` are world, state, sensors and definitions after the step, `controlling[robot]` the names of the controlling
    behaviors, `actions[robot]` their actions, `rewards[term][robot]` what each term gave, `decisions` what every
    behavior perceived and wanted.
    """

    steps: npt.NDArray[np.int64]
    values: dict[Slot, list[float | str]]
    controlling: list[list[str]]
    actions: list[list[str]]
    rewards: dict[str, list[Floats]]
    robots: int
    decisions: Decisions
    expectations: list[list[str]] = field(default_factory=list)
    """For each robot whether the expectation of its controlling behavior `held` or `failed`, '' where it has none.

    Empty where no behavior of the spec expects anything.
    """
    scene: Scene | None = None
    """The scene of the spec's view, if it has one."""

    @property
    def columns(self) -> list[str]:
        """The columns' names, `step` first; with several robots each name ends in the robot's index."""
        robots = range(self.robots)
        return [
            "step",
            *(slot.text(self.robots) for slot in self.values),
            *(Slot(what, robot).text(self.robots) for robot in robots for what in ("controlling", "action")),
            *(Slot("expectation", robot).text(self.robots) for robot in range(len(self.expectations))),
            *(Slot(f"reward_{term}", robot).text(self.robots) for term in self.rewards for robot in robots),
        ]

    @property
    def rows(self) -> list[tuple[int | float | str, ...]]:
        """One tuple a step, in the order of the columns."""
        control = [
            column
            for robot in range(self.robots)
            for column in (self.controlling[robot], self.actions[robot])
        ]
        rewards = [values.tolist() for robots in self.rewards.values() for values in robots]
        columns = (*self.values.values(), *control, *self.expectations, *rewards)
        return list(zip(self.steps.tolist(), *columns, strict=True))


def trace(problem: Problem, architecture: Architecture, key: int, generation: int) -> Trace:
    """Run one episode as plain Python and record everything."""
    meaning, steps = problem.meaning, problem.meaning.spec.environment.steps
    columns = traced_columns(meaning)
    record = np.full((steps, len(columns)), np.nan)
    pools = tuple(table[None] for table in architecture.tables)
    members = np.zeros((1, problem.n_behaviors), np.int64)
    team = problem.assemble(pools, members, generation)
    steps_taken = team.traced_episode(key, architecture.structure, record)
    decisions = decisions_of(problem, architecture, columns, record[:steps_taken])
    traced = _read(problem, columns, record[:steps_taken], decisions)
    return replace(traced, scene=_scene(traced, problem.meaning, key, generation))


def _scene(traced: Trace, meaning: Meaning, key: int, generation: int) -> Scene | None:
    if meaning.episode.picture is None:
        return None
    constants = meaning.constants.vector(generation)
    later = [dict(zip(traced.values, row, strict=True)) for row in zip(*traced.values.values(), strict=True)]
    moments = [starting_values(meaning, key, constants), *later]
    return scene(meaning.episode.picture, moments, constants)


def _read(problem: Problem, columns: list[Column], record: Floats, decisions: Decisions) -> Trace:
    names = [("nobody", "")]
    names += [
        (behavior.name, action) for behavior in problem.meaning.episode.modules for action in behavior.actions
    ]
    values: dict[Slot, list[float | str]] = {}
    controlling: list[list[str]] = []
    actions: list[list[str]] = []
    rewards: dict[str, list[Floats]] = {}
    expectations: list[list[str]] = []
    for (content, slot), column in zip(columns, record.T, strict=True):
        if content == "choice":
            controlling.append([names[int(number)][0] for number in column])
            actions.append([names[int(number)][1] for number in column])
        elif content == "expectation":
            expectations.append([EXPECTATION[int(number)] for number in column])
        elif content == "reward":
            rewards.setdefault(slot[0], []).append(column)
        elif content in {"slot", "definition"}:
            cells = _cells_of(problem, slot)
            values[slot] = (
                [cells[int(value)] for value in column] if cells else [float(value) for value in column]
            )
    robots = problem.meaning.spec.environment.robots
    steps = np.arange(1, len(record) + 1)
    return Trace(steps, values, controlling, actions, rewards, robots, decisions, expectations)


def _cells_of(problem: Problem, slot: Slot) -> Labels:
    """Return the names of the cells of a sensor that is a partition, none of any other slot."""
    written = problem.meaning.spec.environment.sensors.get(slot[0])
    if written is None or not is_partition(written):
        return ()
    return problem.meaning.episode.partitions.get(slot[0], ())
