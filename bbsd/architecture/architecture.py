"""An architecture (3): tables and a structure, given by a spec or learned."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.errors import UsageError
from bbsd.language.meaning.structure import OPEN_LAYER
from bbsd.language.meaning.tables.table import NO_ACTION, OPEN_CELL

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.language.meaning import Meaning


@dataclass(frozen=True, slots=True, eq=False)
class Architecture:
    """A table for each behavior (n_cells,), in the spec's order, and a structure (n_layers,), lowest layer first."""

    tables: tuple[NDArray[np.uint8], ...]
    structure: NDArray[np.int64]


class HolesLeft(UsageError):
    """A design without holes is needed, and the spec leaves something open."""

    advice = "have it designed: bbsd design; or measure random agents: bbsd evaluate --fill random"


def given_architecture(problem: Problem) -> Architecture:
    """Return the architecture that a spec without holes gives; as `architecture_of`."""
    return architecture_of(problem.meaning)


def architecture_of(meaning: Meaning) -> Architecture:
    """Return the architecture that the meaning of a spec without holes gives.

    Open cells of a behavior that the given structure leaves out are no holes; they become No Action.

    Raises:
        HolesLeft: something is open; the message says what.
    """
    if descriptions := holes_of(meaning):
        raise HolesLeft(f"the design has holes: {'; '.join(descriptions)}")
    given = [np.frombuffer(module.table.given, np.uint8) for module in meaning.episode.modules]
    tables = tuple(np.where(cells == OPEN_CELL, np.uint8(NO_ACTION), cells) for cells in given)
    return Architecture(tables, np.array(meaning.structure.layers, np.int64))


def holes(problem: Problem) -> list[str]:
    """Return what a spec leaves open, in words: `stop: 2 of 2 cells open`, `5 of 5 layers open`."""
    return holes_of(problem.meaning)


def holes_of(meaning: Meaning) -> list[str]:
    """Return what the meaning of a spec leaves open, in words, as `holes`."""
    layers = meaning.structure.layers
    n_open = layers.count(OPEN_LAYER)
    cells = [
        f"{module.name}: {module.table.given.count(OPEN_CELL)} of {_counted(module.n_cells, 'cell')} open"
        for index, module in enumerate(meaning.episode.modules)
        if module.table.is_open and meaning.structure.may_hold(index)
    ]
    return cells + ([f"{n_open} of {_counted(len(layers), 'layer')} open"] if n_open else [])


def _counted(number: int, noun: str) -> str:
    return f"{number} {noun}{'' if number == 1 else 's'}"
