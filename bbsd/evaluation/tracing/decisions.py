"""The decisions of an episode: what every behavior perceived and wanted in each step, and who controlled."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np

from bbsd.language.models import NO_ACTION_TEXT

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.compiler import Column, Problem
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.meaning.tables.labels import Labels


@dataclass(frozen=True, slots=True, eq=False)
class Decisions:
    """What every behavior of every robot perceived and wanted in each step, and who controlled."""

    excited: NDArray[np.bool_]
    """(n_steps, n_robots, n_behaviors), behaviors in the spec's order, as in `cells` and `wishes`."""
    cells: NDArray[np.int64]
    """The cell of the behavior's own table, also where it is not excited."""
    wishes: NDArray[np.int64]
    """The number of the action that its table has in that cell, from 1; 0 is No Action."""
    controlling: NDArray[np.int64]
    """(n_steps, n_robots): the index of the behavior, -1 where nobody controls."""


@dataclass(frozen=True, slots=True)
class Layer:
    """The names of what a layer's behavior perceives and does."""

    behavior: str
    index: int
    """The behavior's place in the spec's order, by which decisions are indexed."""
    inputs: Mapping[str, Labels]
    actions: tuple[str, ...]

    def cell_labels(self, cell: int) -> dict[str, str]:
        """Return the label of each input in a cell of the behavior's table."""
        labels = dict[str, str]()
        for name, cells in reversed([*self.inputs.items()]):
            cell, place = divmod(cell, len(cells))
            labels[name] = cells[place]
        return dict(reversed(labels.items()))

    def wish(self, number: int) -> str:
        """Return the name of an action by its number in the table, `no action` for 0."""
        return self.actions[number - 1] if number else NO_ACTION_TEXT


def layers_of(modules: Sequence[Module], structure: NDArray[np.int64]) -> tuple[Layer, ...]:
    """Return the layers of a structure (n_layers,), highest first."""
    return tuple(
        Layer(modules[index].name, index, modules[index].inputs, (*modules[index].actions,))
        for index in reversed(structure.tolist())
    )


def decisions_of(
    problem: Problem, architecture: Architecture, columns: list[Column], record: NDArray[np.float64]
) -> Decisions:
    """Read the decisions from a trace's record (n_steps, n_columns)."""
    n_steps, robots = len(record), problem.meaning.spec.environment.robots

    def recorded(content: str) -> NDArray[np.float64]:
        indices = [index for index, column in enumerate(columns) if column.content == content]
        return record[:, indices].reshape(n_steps, robots, -1)

    cells = recorded("cell").astype(np.int64)
    wishes = np.stack([table[cells[..., index]] for index, table in enumerate(architecture.tables)], axis=-1)
    first_actions = [*accumulate((table.n_actions for table in problem.tables), initial=0)][:-1]
    choices = recorded("choice")[..., 0].astype(np.int64)
    controlling = np.searchsorted(first_actions, choices, side="left") - 1
    return Decisions(recorded("excited") != 0.0, cells, wishes.astype(np.int64), controlling.astype(np.int64))
