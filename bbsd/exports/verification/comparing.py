"""Whether what was exported decides as the design does: in all joint cells, or in a sample of a large joint space."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture import joint_space
from bbsd.architecture.deciding import asked_at, policy_at
from bbsd.exports.verification.tools import ToolFailed, ToolMissing
from bbsd.kernel.streams import name_word

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.architecture.controller import Controller, Layer
    from bbsd.exports.exported import Exported, Files
    from bbsd.exports.verification.tools import Runner

    Cells = NDArray[np.int64]

MOST_CELLS = 1_000_000
"""Joint cells that are all compared, fewer with slow tools; of more, each behavior's table and a sample are."""
SAMPLE = 200_000
"""Joint cells of the sample."""
TRIES = 30
"""Draws after which a cell of a table in which a higher layer always acted counts as covered."""


@dataclass(frozen=True, slots=True)
class Difference:
    """A joint cell in which a target decides otherwise: the label of each dimension's cell, and both decisions."""

    cells: tuple[tuple[str, str], ...]
    design: str
    target: str


@dataclass(frozen=True, slots=True)
class Verified:
    """What came of running an export by one tool.

    `missing`: it was not there; `failure`: what it said instead of answering. `is_proof`: all joint cells were
    compared, else a sample of them, and all cells of all tables, or of these a sample too.
    """

    tool: str
    needed: bool
    missing: bool
    failure: str
    compared: int
    equal: int
    is_proof: bool
    joint_size: int
    first_difference: Difference | None

    @property
    def is_equal(self) -> bool:
        """Whether it ran and answered all as the design does."""
        return not self.missing and not self.failure and self.equal == self.compared


def verify(exported: Exported, files: Files, runners: Sequence[Runner]) -> list[Verified]:
    """Run what was exported by each tool, and compare its answers with the design's."""
    return [_verified(exported, files, runner) for runner in runners]


def cells_to_compare(exported: Exported, most: int = sys.maxsize) -> Cells:
    """Return all joint cells (n, n_dimensions); where there are more than `most`, or MOST_CELLS, a sample."""
    sizes, n = exported.controller.sizes, exported.controller.joint_size
    if n <= min(most, MOST_CELLS):
        return np.indices(sizes).reshape(len(sizes), n).T.copy()
    return _sampled_cells(exported, most)


def _sampled_cells(exported: Exported, most: int) -> Cells:
    """Return drawn joint cells, and for each cell of each table one in which it decides, if that is found.

    Where that would be more than about `most`, cells of the tables are drawn too. The draws depend on the design alone.
    """
    controller = exported.controller
    rng = np.random.default_rng(name_word(f"verify {controller.digest}"))
    n = min(SAMPLE, max(1, most // 2))
    parts, left = [_drawn(controller, n, rng)], most - n
    total = sum(len(layer.table) for layer in controller.layers)
    for layer in controller.layers:
        places = np.arange(len(layer.table))
        if total > left:
            places = np.sort(rng.choice(places, max(1, left * len(places) // total), replace=False))
        parts.append(_deciding(exported, layer, places, rng))
    return np.concatenate(parts)


def _deciding(exported: Exported, layer: Layer, places: NDArray[np.int64], rng: np.random.Generator) -> Cells:
    """Return for each of some cells of a layer's table a joint cell in which it decides, if that is found."""
    controller, space = exported.controller, joint_space(exported.meaning)
    behavior = [*exported.meaning.spec.behaviors].index(layer.behavior)
    cells = _in_layer(layer, places, _drawn(controller, len(places), rng))
    for _ in range(TRIES):
        asked = dict(asked_at(space, exported.architecture, cells))[behavior]
        if asked.all():
            break
        again = _in_layer(layer, places, _drawn(controller, len(places), rng))
        cells = np.where(asked[:, None], cells, again)
    return cells


def _drawn(controller: Controller, n: int, rng: np.random.Generator) -> Cells:
    return rng.integers(0, np.array(controller.sizes, np.int64), (n, len(controller.sizes)))


def _in_layer(layer: Layer, places: NDArray[np.int64], cells: Cells) -> Cells:
    """Return joint cells changed so that a layer is excited, and each has one of some places of its table."""
    own = np.unravel_index(places, layer.sizes) if layer.sizes else ()
    for axis, cell in zip(layer.axes, own, strict=True):
        cells[:, axis] = cell
    if layer.excitement is not None and layer.excitement not in layer.axes:
        cells[:, layer.excitement] = layer.excited_at
    return cells


def _verified(exported: Exported, files: Files, runner: Runner) -> Verified:
    joint_size, most = exported.controller.joint_size, runner.most_cells(exported)
    cells = cells_to_compare(exported, most)
    expected = policy_at(joint_space(exported.meaning), exported.architecture, cells)
    missing, failure, answers = False, "", expected[:0]
    try:
        answers = runner.run(exported, files, cells)
    except ToolMissing:
        missing = True
    except ToolFailed as error:
        failure = str(error)
    ran = not missing and not failure
    wrong = np.flatnonzero(answers != expected) if ran else np.zeros(0, np.int64)
    return Verified(
        tool=runner.tool,
        needed=runner.needed,
        missing=missing,
        failure=failure,
        compared=len(cells),
        equal=len(cells) - len(wrong) if ran else 0,
        is_proof=joint_size <= min(most, MOST_CELLS),
        joint_size=joint_size,
        first_difference=_difference(exported.controller, cells, expected, answers, int(wrong[0]))
        if len(wrong)
        else None,
    )


def _difference(
    controller: Controller, cells: Cells, expected: Cells, answers: Cells, row: int
) -> Difference:
    labels = tuple(
        (dimension.name, dimension.cells[int(cell)])
        for dimension, cell in zip(controller.dimensions, cells[row], strict=True)
    )
    return Difference(
        labels, action_text(controller, int(expected[row])), action_text(controller, int(answers[row]))
    )


def action_text(controller: Controller, number: int) -> str:
    """Return an action and its behavior by number; `nobody` for 0, and a number that no action has as such."""
    if number == 0:
        return "nobody"
    if number > len(controller.actions):
        return f"number {number}, which no action has"
    action = controller.actions[number - 1]
    return f"{action.name} of {action.behavior}"
