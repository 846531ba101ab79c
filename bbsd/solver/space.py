"""The space of designs: which cells and layers are open, random designs, and small changes of them.

A design is a row of `Designs`: all tables one after the other, and the structure, lowest layer first. Given cells and
layers never change.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture import Architecture
from bbsd.evaluation import Agents
from bbsd.kernel.keys import keys, units
from bbsd.kernel.streams import fold, name_word
from bbsd.language.meaning.tables.table import OPEN_CELL
from bbsd.solver.structures import OPEN, random_structures

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.compiler import Problem

CELLS, ORDERS, WHICH, SWAPS = (name_word(name) for name in ("cells", "orders", "which", "swaps"))


@dataclass(frozen=True, slots=True, eq=False)
class Designs:
    """Several designs: tables (n, n_cells) of all behaviors one after the other, structures (n, n_layers)."""

    tables: NDArray[np.uint8]
    structures: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.tables)

    def __getitem__(self, which: NDArray[np.generic] | slice) -> Designs:
        return Designs(self.tables[which], self.structures[which])

    def joined(self, *others: Designs) -> Designs:
        """Return these designs and those of others behind them."""
        return Designs(
            np.concatenate([self.tables, *(other.tables for other in others)]),
            np.concatenate([self.structures, *(other.structures for other in others)]),
        )

    def repeated(self, times: int) -> Designs:
        """Return each design so many times, one after another."""
        return Designs(np.repeat(self.tables, times, axis=0), np.repeat(self.structures, times, axis=0))

    def distinct(self) -> NDArray[np.int64]:
        """Return the indices of the first of all that are equal, in ascending order."""
        rows = np.hstack([self.tables, np.ascontiguousarray(self.structures).view(np.uint8)])
        _, first = np.unique(rows.view(f"V{rows.shape[1]}").ravel(), return_index=True)
        return np.sort(first)


@dataclass(frozen=True)
class Space:
    """What a problem leaves open."""

    problem: Problem

    @cached_property
    def given(self) -> NDArray[np.uint8]:
        """The given cells of all tables, OPEN_CELL where one is open, (n_cells,)."""
        return np.concatenate([table.given for table in self.problem.tables])

    @cached_property
    def is_open(self) -> NDArray[np.uint8]:
        """1 where a cell is open, 0 where it is given, (n_cells,)."""
        return np.where(self.given == OPEN_CELL, 1, 0).astype(np.uint8)

    @cached_property
    def first_pairs(self) -> NDArray[np.int64]:
        """The number of each cell's first pair of a cell and a choice, and of all pairs, (n_cells + 1,)."""
        return np.concatenate([np.zeros(1, np.int64), np.cumsum(self.choices)])

    @cached_property
    def blank(self) -> NDArray[np.uint8]:
        """The given cells, No Action where one is open, (n_cells,)."""
        return np.where(self.given == OPEN_CELL, 0, self.given).astype(np.uint8)

    @cached_property
    def open_cells(self) -> NDArray[np.int64]:
        """The indices of the cells to be designed, of behaviors that may stand in the structure, (n_open,)."""
        may_matter = np.concatenate(
            [
                np.full(table.n_cells, self.problem.evolves(index))
                for index, table in enumerate(self.problem.tables)
            ]
        )
        return np.flatnonzero((self.given == OPEN_CELL) & may_matter)

    @cached_property
    def choices(self) -> NDArray[np.int64]:
        """How many choices each cell has, No Action among them, (n_cells,)."""
        return np.concatenate([np.full(table.n_cells, table.n_actions + 1) for table in self.problem.tables])

    @cached_property
    def behavior_of(self) -> NDArray[np.int64]:
        """The behavior of each cell, (n_cells,)."""
        return np.concatenate(
            [np.full(table.n_cells, index) for index, table in enumerate(self.problem.tables)]
        )

    @cached_property
    def open_layers(self) -> NDArray[np.int64]:
        """The indices of the open layers, lowest first."""
        return np.flatnonzero(self.problem.layers == OPEN)

    @property
    def orders_differ(self) -> bool:
        """Whether more than one structure is possible."""
        return self.problem.learns_structure

    @cached_property
    def _ends(self) -> NDArray[np.int64]:
        return np.cumsum([table.n_cells for table in self.problem.tables])[:-1]

    def random(self, key: int, count: int) -> Designs:
        """Return so many uniformly random designs."""
        tables = np.tile(self.blank, (count, 1))
        drawn = uniforms(fold(key, CELLS), (count, len(self.open_cells)))
        tables[:, self.open_cells] = drawn * self.choices[self.open_cells]
        return Designs(tables, self.random_orders(fold(key, ORDERS), count))

    def random_orders(self, key: int, count: int) -> NDArray[np.int64]:
        """Return so many random structures, (count, n_layers)."""
        return random_structures(keys(key, 0, count), self.problem.layers, self.problem.candidates)

    def mutated(self, key: int, designs: Designs, rate: float | NDArray[np.float64]) -> Designs:
        """Draw each open cell anew with a probability, one for all or one for each open cell."""
        shape = (len(designs), len(self.open_cells))
        changes = uniforms(fold(key, WHICH), shape) < rate
        drawn = (uniforms(fold(key, CELLS), shape) * self.choices[self.open_cells]).astype(np.uint8)
        tables = designs.tables.copy()
        tables[:, self.open_cells] = np.where(changes, drawn, tables[:, self.open_cells])
        return Designs(tables, designs.structures)

    def reordered(self, key: int, structures: NDArray[np.int64], rate: float) -> NDArray[np.int64]:
        """Exchange, with a probability, one open layer's behavior for another candidate of each structure."""
        if not self.orders_differ:
            return structures
        changed = structures.copy()
        drawn = uniforms(fold(key, SWAPS), (len(structures), 3))
        for row in np.flatnonzero(drawn[:, 0] < rate):
            layer = int(self.open_layers[int(drawn[row, 1] * len(self.open_layers))])
            behavior = int(self.problem.candidates[int(drawn[row, 2] * len(self.problem.candidates))])
            changed[row] = with_behavior(changed[row], layer, behavior)
        return changed

    def neighboring_orders(self, structure: NDArray[np.int64]) -> list[NDArray[np.int64]]:
        """Return the structures in which one open layer has another candidate, which gives its own place for it."""
        if not self.orders_differ:
            return []
        orders: dict[bytes, NDArray[np.int64]] = {}
        for layer in self.open_layers:
            for behavior in self.problem.candidates:
                order = with_behavior(structure, int(layer), int(behavior))
                orders.setdefault(order.tobytes(), order)
                order = moved(structure, int(layer), int(behavior), self.open_layers)
                orders.setdefault(order.tobytes(), order)
        orders.pop(structure.tobytes(), None)
        return list(orders.values())

    def by_behavior(self, tables: NDArray[np.uint8]) -> tuple[NDArray[np.uint8], ...]:
        """Return the columns of tables (n, n_cells) that belong to each behavior."""
        return tuple(np.split(tables, self._ends, axis=1))

    def agents(self, designs: Designs) -> Agents:
        """Return each design as an agent of its own."""
        pools = self.by_behavior(designs.tables)
        members = np.repeat(np.arange(len(designs))[:, None], len(pools), axis=1)
        return Agents(pools, members, designs.structures)

    def architectures(self, designs: Designs) -> list[Architecture]:
        """Return each design by itself."""
        return [
            Architecture(tuple(np.split(table, self._ends)), structure)
            for table, structure in zip(designs.tables, designs.structures, strict=True)
        ]

    def designs(self, architectures: Sequence[Architecture]) -> Designs:
        """Return architectures as rows."""
        tables = np.stack([np.concatenate(design.tables) for design in architectures])
        return Designs(tables, np.stack([design.structure for design in architectures]))


def with_behavior(structure: NDArray[np.int64], layer: int, behavior: int) -> NDArray[np.int64]:
    """Return a structure with a behavior in a layer; where it stood before stands the one it displaces."""
    changed = structure.copy()
    changed[structure == behavior] = structure[layer]
    changed[layer] = behavior
    return changed


def moved(
    structure: NDArray[np.int64], layer: int, behavior: int, open_layers: NDArray[np.int64]
) -> NDArray[np.int64]:
    """Return a structure in which a behavior was taken out and put into an open layer, the others moving up or down."""
    hand = [int(each) for each in structure[open_layers]]
    if behavior in hand:
        hand.remove(behavior)
    else:
        hand.pop(0)
    hand.insert(int(np.searchsorted(open_layers, layer)), behavior)
    changed = structure.copy()
    changed[open_layers] = hand[: len(open_layers)]
    return changed


def uniforms(key: int, shape: tuple[int, ...]) -> NDArray[np.float64]:
    """Return numbers in [0, 1) from the stream of a key."""
    return units(keys(key, 0, int(np.prod(shape)))).reshape(shape)
