"""One mistake, its place in a file, and the error that carries all the mistakes of one file."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping


@dataclass(frozen=True, slots=True, order=True)
class Place:
    """A stretch of one line of a file; line and column count from 1, columns and length in characters."""

    file: str
    line: int
    column: int
    length: int = 1


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """What is wrong at a place, and what to do about it where the message does not already say so."""

    code: str
    message: str
    place: Place
    advice: str = ""


class Lines(Protocol):
    """What a diagnosis is shown with: the text it speaks of."""

    def line(self, number: int) -> str:
        """Return the line of that number, counted from 1, without its break; '' if there is none."""
        ...


class SpecError(Exception):
    """Everything that is wrong with a file, and with others that it refers to: their texts by their names."""

    def __init__(
        self, diagnoses: Iterable[Diagnosis], source: Lines, others: Mapping[str, Lines] | None = None
    ) -> None:
        self.diagnoses = tuple(diagnoses)
        self.source = source
        self.others = others or {}
        super().__init__(self.diagnoses, source, self.others)

    def line(self, place: Place) -> str:
        """Return the line that a place is on; '' if there is none."""
        return self.others.get(place.file, self.source).line(place.line)

    def __str__(self) -> str:
        return "\n".join(
            f"{each.place.file}:{each.place.line}:{each.place.column}: error[{each.code}]: {each.message}"
            for each in self.diagnoses
        )
