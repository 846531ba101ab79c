"""From values of joint choices to a design: tables that do well by these values, given an order of the layers."""

from __future__ import annotations

from dataclasses import dataclass
from math import fsum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.language.meaning.tables.table import OPEN_CELL

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler.joint_control import JointControl

MOST_SWEEPS = 10
"""Times that all behaviors are fitted to the others."""


class Projection(NamedTuple):
    """A design's tables, one after the other, and what its choices are worth less than the best, on average."""

    table: NDArray[np.uint8]
    loss: float


def projection(
    control: JointControl,
    given: NDArray[np.uint8],
    values: NDArray[np.float64],
    weights: NDArray[np.float64],
    structure: NDArray[np.int64],
) -> Projection:
    """Return the tables of a design that chooses well by the values of joint choices.

    From the top layer down, behaviors choose what is worth most, where No Action counts as the best that layers below
    could do; then each is fitted to what the others really do until nothing changes. Without loss where some tables
    make a best choice in every joint cell that has a weight.

    Args:
        control: the joint partition.
        given: the given cells of all tables, OPEN_CELL where one is open.
        values: the value of every joint choice in every joint cell, (n_joint_cells, n_choices), all finite.
        weights: how often each joint cell is met, (n_joint_cells,).
        structure: lowest layer first.
    """
    met = np.flatnonzero(weights > 0)
    fit = _Fit(control, given, values[met], weights[met], met, structure.tolist())
    for layer in reversed(range(len(structure))):
        fit.choose(layer, fit.best_below(layer))
    for _ in range(MOST_SWEEPS):
        before = fit.table.copy()
        for layer in range(len(structure)):
            fit.choose(layer, fit.earned_below(layer))
        if (fit.table == before).all():
            break
    best = np.where(control.possible[met], fit.values, -np.inf).max(axis=1)
    lost = fit.weights * (best - fit.earned_below(len(structure)))
    return Projection(fit.table, fsum(lost.tolist()) / max(fsum(fit.weights.tolist()), 1e-300))


@dataclass
class _Fit:
    """Tables that are fitted, and the joint cells that are met."""

    control: JointControl
    given: NDArray[np.uint8]
    values: NDArray[np.float64]
    weights: NDArray[np.float64]
    met: NDArray[np.int64]
    structure: list[int]

    def __post_init__(self) -> None:
        shapes = self.control.problem.tables
        self.first_cells = np.cumsum([0, *(shape.n_cells for shape in shapes)])
        self.table = np.where(self.given == OPEN_CELL, 0, self.given).astype(np.uint8)
        self.cells = self.control.cells[:, self.met]
        self.excited = self.control.excited[:, self.met]

    def best_below(self, layer: int) -> NDArray[np.float64]:
        """Return the value of the best choice that layers below one have in each joint cell, nobody's among them."""
        best = self.values[:, 0]
        for behavior in self.structure[:layer]:
            own = self._own_values(behavior).max(axis=1)
            best = np.where(self.excited[behavior], np.maximum(best, own), best)
        return best

    def earned_below(self, layer: int) -> NDArray[np.float64]:
        """Return the value of what layers below one really choose in each joint cell."""
        earned = self.values[:, 0]
        for behavior in self.structure[:layer]:
            choices = self._choices(behavior)
            own = self._own_values(behavior)[np.arange(len(choices)), np.maximum(choices, 1) - 1]
            earned = np.where(self._acts(behavior), own, earned)
        return earned

    def choose(self, layer: int, below: NDArray[np.float64]) -> None:
        """Let the behavior of a layer choose what is worth most in each cell; an action rather than none if in doubt.

        Args:
            layer: counted from the lowest.
            below: what its No Action is worth in each joint cell.
        """
        behavior = self.structure[layer]
        n_cells = self.control.problem.tables[behavior].n_cells
        asked = self.excited[behavior].copy()
        for higher in self.structure[layer + 1 :]:
            asked &= ~self._acts(higher)
        cells = self.cells[behavior, asked]
        options = np.column_stack([below, self._own_values(behavior)])[asked]
        weights = self.weights[asked]
        worth = np.stack(
            [np.bincount(cells, weights * option, minlength=n_cells) for option in options.T], axis=1
        )
        actions = worth[:, 1:].argmax(axis=1) + 1
        acts = worth[np.arange(n_cells), actions] >= worth[:, 0]
        acts &= np.bincount(cells, minlength=n_cells) > 0
        own = slice(self.first_cells[behavior], self.first_cells[behavior + 1])
        given = self.given[own]
        self.table[own] = np.where(given == OPEN_CELL, np.where(acts, actions, 0), given)

    def _own_values(self, behavior: int) -> NDArray[np.float64]:
        """Return the values of a behavior's actions, (n_met, n_actions)."""
        first = int(self.control.first_actions[behavior]) + 1
        return self.values[:, first : first + self.control.problem.tables[behavior].n_actions]

    def _choices(self, behavior: int) -> NDArray[np.uint8]:
        own = self.table[self.first_cells[behavior] : self.first_cells[behavior + 1]]
        choices: NDArray[np.uint8] = own[self.cells[behavior]]
        return choices

    def _acts(self, behavior: int) -> NDArray[np.bool_]:
        acts: NDArray[np.bool_] = self.excited[behavior] & (self._choices(behavior) > 0)
        return acts
