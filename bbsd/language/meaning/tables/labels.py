"""The names of a partition's cells."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import overload

Labels = Sequence[str]
"""A partition's cells by name, in order."""

WHOLE_NUMBER = re.compile(r"0|-?[1-9][0-9]{0,17}")


@dataclass(frozen=True, slots=True)
class Numbers(Sequence[str]):
    """The cells of `values(e, first, last)`: numbers, made into text only when needed, since there may be many."""

    first: int
    last: int

    def __len__(self) -> int:
        """Return the number of cells."""
        return self.last - self.first + 1

    @overload
    def __getitem__(self, index: int) -> str: ...
    @overload
    def __getitem__(self, index: slice) -> tuple[str, ...]: ...
    def __getitem__(self, index: int | slice) -> str | tuple[str, ...]:
        """Return a cell's name, or several."""
        numbers = range(self.first, self.last + 1)[index]
        return tuple(map(str, numbers)) if isinstance(numbers, range) else str(numbers)

    def __contains__(self, label: object) -> bool:
        """Return whether a text is one of the cells' names."""
        return (
            isinstance(label, str)
            and WHOLE_NUMBER.fullmatch(label) is not None
            and self.first <= int(label) <= self.last
        )

    def index(self, label: str, start: int = 0, stop: int | None = None) -> int:
        """Return the index of the cell with that name; raise ValueError if none from `start` up to `stop` has it."""
        if label in self and (cell := int(label) - self.first) in range(len(self))[start:stop]:
            return cell
        raise ValueError(f"{label!r} is not a cell")
