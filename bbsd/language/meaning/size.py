"""The size of a design task: open cells and layers, and the number of possible designs."""

from __future__ import annotations

from math import lgamma, log, log10
from typing import TYPE_CHECKING, NamedTuple

from bbsd.language.meaning.structure import OPEN_LAYER
from bbsd.language.meaning.tables.table import OPEN_CELL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.meaning.structure import Structure


class Size(NamedTuple):
    """Open cells and layers, and the number of possible designs as a logarithm to base 10."""

    open_cells: int
    open_layers: int
    decades: float


def size_of(modules: Sequence[Module], structure: Structure) -> Size:
    """Return the size of a task; open cells of a behavior that a given structure leaves out do not count."""
    evolved = [module for index, module in enumerate(modules) if structure.may_hold(index)]
    open_cells = [module.table.given.count(OPEN_CELL) for module in evolved]
    choices = [
        cells * log10(len(module.actions) + 1) for cells, module in zip(open_cells, evolved, strict=True)
    ]
    n, k = len(structure.candidates), structure.layers.count(OPEN_LAYER)
    orders = (lgamma(n + 1) - lgamma(n - k + 1)) / log(10)
    return Size(sum(open_cells), k, sum(choices) + orders)
