"""From values of joint choices to a design: the tables that do best by these values, given an order of the layers."""

from __future__ import annotations

from math import fsum
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.language.meaning.tables.table import OPEN_CELL

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler.joint_control import JointControl


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
    """Return the tables that choose best from the top layer down, where No Action counts as the best that follows.

    Without loss where some tables make a best choice in every joint cell that has a weight.

    Args:
        control: the joint partition.
        given: the given cells of all tables, OPEN_CELL where one is open.
        values: the value of every joint choice in every joint cell, (n_joint_cells, n_choices), all finite.
        weights: how often each joint cell is met, (n_joint_cells,).
        structure: lowest layer first.
    """
    shapes = control.problem.tables
    first_cells = np.cumsum([0, *(shape.n_cells for shape in shapes)])
    table = np.where(given == OPEN_CELL, 0, given).astype(np.uint8)
    met = np.flatnonzero(weights > 0)
    cells, excited = control.cells[:, met], control.excited[:, met]
    values, weights = values[met], weights[met]
    best, earned = np.where(control.possible[met], values, -np.inf).max(axis=1), values[:, 0]
    waiting = np.ones(len(met), np.bool_)
    for layer in reversed(range(len(structure))):
        behavior = int(structure[layer])
        shape, first = shapes[behavior], int(control.first_actions[behavior]) + 1
        asked = waiting & excited[behavior]
        below = _at_best(values, excited, control, structure[:layer])
        options = np.column_stack([below, values[:, first : first + shape.n_actions]])
        worth = np.stack(
            [
                np.bincount(cells[behavior, asked], (weights * option)[asked], minlength=shape.n_cells)
                for option in options.T
            ],
            axis=1,
        )
        actions = worth[:, 1:].argmax(axis=1) + 1
        acts = worth[np.arange(shape.n_cells), actions] >= worth[:, 0]
        acts &= np.bincount(cells[behavior, asked], minlength=shape.n_cells) > 0
        own = slice(first_cells[behavior], first_cells[behavior + 1])
        table[own] = np.where(given[own] == OPEN_CELL, np.where(acts, actions, 0), given[own])
        choices = table[own][cells[behavior]]
        claimed = asked & (choices > 0)
        earned = np.where(claimed, options[np.arange(len(met)), choices], earned)
        waiting &= ~claimed
    return Projection(table, fsum((weights * (best - earned)).tolist()) / max(fsum(weights.tolist()), 1e-300))


def _at_best(
    values: NDArray[np.float64],
    excited: NDArray[np.bool_],
    control: JointControl,
    behaviors: NDArray[np.int64],
) -> NDArray[np.float64]:
    """Return the value of the best choice that some behaviors have in each joint cell, nobody's among them."""
    best = values[:, 0]
    for behavior in behaviors.tolist():
        first = int(control.first_actions[behavior]) + 1
        own = values[:, first : first + control.problem.tables[behavior].n_actions].max(axis=1)
        best = np.where(excited[behavior], np.maximum(best, own), best)
    return best
