"""A known design in the terms of another spec: behaviors, inputs, cells and actions are matched by their names."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.errors import UsageError, did_you_mean
from bbsd.language.meaning.structure import OPEN_LAYER
from bbsd.language.meaning.tables.table import NO_ACTION, OPEN_CELL

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.language.meaning import Meaning
    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.meaning.tables.labels import Labels

MOST_NAMED = 5
"""Names that a message lists, at most."""


class UnfitStart(UsageError):
    """A design that a spec cannot begin with: it has something that the spec does not have."""

    advice = "a start has the behaviors, inputs, cells and actions of the spec, by the same names, or fewer"


@dataclass(frozen=True, slots=True, eq=False)
class Start:
    """A design to begin with, as far as it is known."""

    table: NDArray[np.uint8]
    """Of all behaviors of the spec one after the other, (n_cells,), OPEN_CELL where the start says nothing."""
    structure: NDArray[np.int64]
    """(n_layers,), lowest first, OPEN_LAYER where the start says nothing."""
    set_aside: tuple[int, int]
    """Cells and layers that the spec gives, and the start has otherwise; they are as the spec gives them."""

    def says_something(self, problem: Problem) -> bool:
        """Return whether it says anything of what the problem leaves open."""
        given = np.concatenate([shape.given for shape in problem.tables])
        cells = (given == OPEN_CELL) & (self.table != OPEN_CELL)
        layers = (problem.layers == OPEN_LAYER) & (self.structure != OPEN_LAYER)
        return bool(cells.any() or layers.any())


def start_for(problem: Problem, start: Meaning, name: str) -> Start:
    """Return a design in the terms of a problem's spec.

    What the spec gives is kept. A rule of the start holds for all cells of an input that it does not have; cells that
    it does not know stay open.

    Args:
        problem: of the spec.
        start: the meaning of the design, which may have holes itself.
        name: what messages call it.

    Raises:
        UnfitStart: it has a behavior, an input, a cell or an action that the spec does not have, or more layers.
    """
    theirs = _standing(start)
    ours = {module.name: module for module in problem.meaning.episode.modules}
    for each in theirs:
        if each not in ours:
            raise UnfitStart(f"{name} has a behavior {each}, and the spec has none{did_you_mean(each, ours)}")
    tables, cells = [], 0
    for shape, module in zip(problem.tables, ours.values(), strict=True):
        wanted = _table(module, theirs[module.name], name) if module.name in theirs else None
        if wanted is None:
            tables.append(shape.given)
            continue
        is_given = shape.given != OPEN_CELL
        cells += int(np.count_nonzero(is_given & (wanted != OPEN_CELL) & (wanted != shape.given)))
        tables.append(np.where(is_given, shape.given, wanted).astype(np.uint8))
    structure = _structure(problem, start, name)
    before = structure.copy()
    is_given = problem.layers != OPEN_LAYER
    layers = int(np.count_nonzero(is_given & (structure != OPEN_LAYER) & (structure != problem.layers)))
    structure = np.where(is_given, problem.layers, before)
    # A behavior stands once, and where the spec gives it a layer, it is there.
    taken = [*problem.layers[is_given].tolist(), OPEN_LAYER]
    for layer in np.flatnonzero(~is_given):
        if structure[layer] in taken:
            structure[layer] = OPEN_LAYER
    return Start(np.concatenate(tables), structure, (cells, layers))


def _standing(start: Meaning) -> dict[str, Module]:
    """Return the behaviors of a design that may control in it, by name."""
    return {
        module.name: module
        for index, module in enumerate(start.episode.modules)
        if start.structure.may_hold(index)
    }


def _structure(problem: Problem, start: Meaning, name: str) -> NDArray[np.int64]:
    """Return the start's layers as behaviors of the spec; where these are fewer, from the top down."""
    behaviors = {each: index for index, each in enumerate(problem.names)}
    names = [module.name for module in start.episode.modules]
    order = [
        OPEN_LAYER if layer == OPEN_LAYER else behaviors[names[layer]] for layer in start.structure.layers
    ]
    missing = len(problem.layers) - len(order)
    if missing < 0:
        raise UnfitStart(f"{name} has {len(order)} layers, and the spec {len(problem.layers)}")
    return np.array([OPEN_LAYER] * missing + order, np.int64)


def _table(ours: Module, theirs: Module, name: str) -> NDArray[np.uint8]:
    """Return a behavior's cells as the start has them, in the order of the spec's, (n_cells,)."""
    for each in theirs.inputs:
        if each not in ours.inputs:
            raise UnfitStart(
                f"{name}: the behavior {theirs.name} perceives {each}, and not so in the spec"
                f"{did_you_mean(each, ours.inputs)}"
            )
    given = np.frombuffer(theirs.table.given, np.uint8)
    actions = _actions(ours, theirs, given, name)
    cells = actions[given].reshape([len(labels) for labels in theirs.inputs.values()])
    for axis, (each, labels) in enumerate(theirs.inputs.items()):
        where = _places(ours.inputs[each], labels, theirs.name, each, name)
        cells = cells.take(np.maximum(where, 0), axis)
        np.moveaxis(cells, axis, 0)[where < 0] = OPEN_CELL
    return _in_our_order(cells, list(theirs.inputs), ours.inputs)


def _in_our_order(
    cells: NDArray[np.generic], theirs: Sequence[str], ours: Mapping[str, Labels]
) -> NDArray[np.uint8]:
    """Return cells whose axes are the start's inputs as those of the spec's, the same along inputs that are new."""
    shared = [each for each in ours if each in theirs]
    moved = cells.transpose([theirs.index(each) for each in shared])
    shape = tuple(len(labels) if each in theirs else 1 for each, labels in ours.items())
    whole = np.broadcast_to(moved.reshape(shape), tuple(map(len, ours.values())))
    return np.ascontiguousarray(whole, np.uint8).ravel()


def _places(ours: Labels, theirs: Labels, behavior: str, input_name: str, name: str) -> NDArray[np.int64]:
    """Return where each of the spec's cells stands among the start's, -1 where it is none of them."""
    if ours == theirs:
        return np.arange(len(ours))
    unknown = [label for label in theirs if label not in ours]
    if unknown:
        raise UnfitStart(
            f"{name}: the behavior {behavior} tells apart {input_name} {_listed(theirs)}, and in the spec "
            f"{_listed(ours)}"
        )
    index = {label: place for place, label in enumerate(theirs)}
    return np.array([index.get(label, -1) for label in ours], np.int64)


def _actions(ours: Module, theirs: Module, given: NDArray[np.uint8], name: str) -> NDArray[np.uint8]:
    """Return for each value of the start's cells the value that means the same in the spec, (256,)."""
    values = np.full(256, OPEN_CELL, np.uint8)
    values[NO_ACTION] = NO_ACTION
    names = list(ours.actions)
    for number, action in enumerate(theirs.actions, start=1):
        if action in ours.actions:
            values[number] = 1 + names.index(action)
        elif np.any(given == number):
            raise UnfitStart(
                f"{name}: the behavior {theirs.name} does {action}, and the spec has no such action of it"
                f"{did_you_mean(action, names)}"
            )
    return values


def _listed(labels: Labels) -> str:
    few = ", ".join(labels[:MOST_NAMED])
    return f"[{few}, ... {len(labels)} cells]" if len(labels) > MOST_NAMED else f"[{few}]"
