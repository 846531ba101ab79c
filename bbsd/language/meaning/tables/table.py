"""The cells that a spec gives of a behavior's table."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from bbsd.language.meaning.tables.labels import Labels

NO_ACTION = 0
OPEN_CELL = 255

Inputs = Mapping[str, Labels]
"""Each input's cells, in the order of the table's dimensions."""


@dataclass(frozen=True, slots=True)
class Table:
    """A table's cells in row-major order of the inputs: 0 is No Action, k the k-th action, 255 open."""

    given: bytes

    @property
    def is_open(self) -> bool:
        """Whether any cell is left to be designed."""
        return OPEN_CELL in self.given
