"""Which cells and layers a spec leaves open, in the words in which a rule would name them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from bbsd.language.meaning.structure import OPEN_LAYER
from bbsd.language.meaning.tables.table import OPEN_CELL

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.language.meaning.behaviors import Module
    from bbsd.language.meaning.meaning import Meaning

ONLY_OPEN = bytes(value * (value == OPEN_CELL) for value in range(256))
"""Makes all cells alike that are not open."""

Where = dict[str, list[str]]
"""Some cells of a behavior, as under `when`: the cells of each input that matters; none are all cells."""


@dataclass(frozen=True, slots=True)
class OpenCells:
    """A behavior with open cells: how many of its cells are open, of how many."""

    module: Module
    count: int

    @property
    def of(self) -> int:
        """The number of all cells."""
        return self.module.n_cells

    def where(self) -> Iterator[Where]:
        """Yield blocks of cells that together are all open cells, each once."""
        inputs = [*self.module.inputs.items()]
        yield from _blocks(self.module.table.given.translate(ONLY_OPEN), inputs, {})


class Holes(NamedTuple):
    """What is open: cells of behaviors that have a layer or may get one, layers, and who may fill these."""

    cells: tuple[OpenCells, ...]
    layers: tuple[int, ...]
    """Open layers, counted from 1 from the highest down."""
    n_layers: int
    candidates: tuple[str, ...]
    """Behaviors that may fill open layers."""


def holes_of(meaning: Meaning) -> Holes:
    """Return what a spec leaves open."""
    modules, structure = meaning.episode.modules, meaning.structure
    cells = [
        OpenCells(module, module.table.given.count(OPEN_CELL))
        for index, module in enumerate(modules)
        if structure.may_hold(index) and module.table.is_open
    ]
    highest_first = [*reversed(structure.layers)]
    layers = tuple(place for place, layer in enumerate(highest_first, start=1) if layer == OPEN_LAYER)
    candidates = tuple(modules[index].name for index in structure.candidates) if layers else ()
    return Holes(tuple(cells), layers, len(structure.layers), candidates)


def _blocks(table: bytes, inputs: Sequence[tuple[str, Sequence[str]]], above: Where) -> Iterator[Where]:
    """Yield blocks of the open cells of a part of a table, in which inputs above have the given cells.

    Cells of the first input in which all the rest is open alike are one block.
    """
    if table.count(OPEN_CELL) == len(table):
        yield above
    elif OPEN_CELL in table:
        (name, cells), *below = inputs
        size = len(table) // len(cells)
        alike: dict[bytes, list[str]] = {}
        for index, cell in enumerate(cells):
            alike.setdefault(table[index * size : (index + 1) * size], []).append(cell)
        for part, named in alike.items():
            yield from _blocks(part, below, above if len(named) == len(cells) else {**above, name: named})
