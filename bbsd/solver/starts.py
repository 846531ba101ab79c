"""Known designs that a search begins with: they are among its first candidates, and in its final race."""

from __future__ import annotations

from dataclasses import dataclass
from hashlib import sha256
from typing import TYPE_CHECKING

import numpy as np

from bbsd.kernel.keys import keys
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.language.meaning.tables.table import OPEN_CELL
from bbsd.solver.space import Designs
from bbsd.solver.structures import OPEN, random_structures

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.architecture.starting import Start
    from bbsd.solver.space import Space

STARTS = name_word("starts")
FILLINGS = 10
"""Designs that are made of a start with holes."""


@dataclass(frozen=True, slots=True, eq=False)
class Starts:
    """Designs to begin with, as far as they are known: OPEN_CELL and OPEN where a start says nothing."""

    known: Designs

    @property
    def digest(self) -> str:
        """What identifies them, in their order."""
        return sha256(self.known.tables.tobytes() + self.known.structures.tobytes()).hexdigest()[:32]

    def drawn(self, space: Space, run_key: int) -> Designs:
        """Return the designs of a run: each start that is complete, and several of one with holes, which are drawn."""
        key = fold(run_key, STARTS)
        rows = [self._filled(index, space, fold(key, word_of(index))) for index in range(len(self.known))]
        drawn = rows[0].joined(*rows[1:])
        return drawn[drawn.distinct()]

    def complete(self) -> Designs:
        """Return those that have no holes."""
        return self.known[self._are_complete()]

    def _are_complete(self) -> np.ndarray[tuple[int], np.dtype[np.bool_]]:
        cells = (self.known.tables != OPEN_CELL).all(axis=1)
        whole: np.ndarray[tuple[int], np.dtype[np.bool_]] = cells & (self.known.structures != OPEN).all(
            axis=1
        )
        return whole

    def _filled(self, index: int, space: Space, key: int) -> Designs:
        known = self.known[index : index + 1]
        if self._are_complete()[index]:
            return known
        random = space.random(key, FILLINGS)
        tables = np.where(known.tables == OPEN_CELL, random.tables, known.tables)
        layers = known.structures[0]
        left = np.setdiff1d(space.problem.candidates, layers)
        structures = random_structures(keys(key, 0, FILLINGS), layers, left)
        return Designs(tables, structures)


def starts_of(starts: Sequence[Start]) -> Starts | None:
    """Return starts together; None of none."""
    if not starts:
        return None
    tables = np.stack([start.table for start in starts])
    return Starts(Designs(tables, np.stack([start.structure for start in starts])))
