"""Genotypes: how a behavior's table is laid out, and how tables reach a kernel."""

from __future__ import annotations

from dataclasses import dataclass
from math import log10
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.language.meaning.tables.table import NO_ACTION, OPEN_CELL

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.language.meaning.behaviors import Module

WORD_BITS = 64

Pool = npt.NDArray[np.uint8]
"""Individuals of one behavior: (n_individuals, n_cells)."""


@dataclass(frozen=True, slots=True)
class TableShape:
    """A behavior's table: cells x actions, 0 = No Action; `given` (n_cells,) holds 255 where a cell is open."""

    name: str
    n_cells: int
    n_actions: int
    given: npt.NDArray[np.uint8]

    @property
    def bits(self) -> int:
        """Bits that a cell's value needs."""
        return self.n_actions.bit_length()

    @property
    def packed(self) -> bool:
        """Whether the whole table fits into one word."""
        return self.n_cells * self.bits <= WORD_BITS

    @property
    def mask(self) -> int:
        """The bits of one cell."""
        return (1 << self.bits) - 1

    @property
    def n_open(self) -> int:
        """The number of cells to be designed."""
        return int(np.count_nonzero(self.given == OPEN_CELL))

    @property
    def decades(self) -> float:
        """The size of the search space of this table alone, as a logarithm to base 10."""
        return self.n_open * log10(self.n_actions + 1)


def shape_of(behavior: Module, *, left_out: bool = False) -> TableShape:
    """Return the layout of a behavior's table.

    Open cells of a behavior that a given structure leaves out are no holes: they do nothing.
    """
    given = np.frombuffer(behavior.table.given, np.uint8)
    if left_out:
        given = np.where(given == OPEN_CELL, np.uint8(NO_ACTION), given)
    return TableShape(behavior.name, behavior.n_cells, len(behavior.actions), given)


def packed_tables(shapes: Sequence[TableShape], pools: Sequence[Pool]) -> npt.NDArray[np.int64]:
    """Return each individual of the packed behaviors as one word: (n_behaviors, largest pool)."""
    words = np.zeros((len(pools), max(len(pool) for pool in pools)), np.int64)
    for index, (shape, pool) in enumerate(zip(shapes, pools, strict=True)):
        if shape.packed:
            shifts = np.arange(shape.n_cells, dtype=np.uint64) * np.uint64(shape.bits)
            cells = pool.astype(np.uint64) << shifts
            words[index, : len(pool)] = np.bitwise_or.reduce(cells, axis=1).view(np.int64)
    return words


def unpacked_tables(
    shapes: Sequence[TableShape], pools: Sequence[Pool]
) -> tuple[npt.NDArray[np.uint8], npt.NDArray[np.int64]]:
    """Return the cells of all behaviors that are not packed, one after the other, and each behavior's offset."""
    parts = [
        np.zeros(0, np.uint8) if shape.packed else pool.ravel()
        for shape, pool in zip(shapes, pools, strict=True)
    ]
    ends = np.cumsum([0, *(part.size for part in parts)])
    return np.concatenate([*parts, np.zeros(1, np.uint8)]), ends[:-1].astype(np.int64)
