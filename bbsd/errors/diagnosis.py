"""One diagnosis, its place in a file, and the error that carries all the diagnoses of one spec."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

from bbsd.errors.correction import CorrectedLine, corrected_lines
from bbsd.errors.kinds.kind import Severity

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from bbsd.errors.correction import Correction, Lines


class Place(NamedTuple):
    """A stretch of one line of a file; line and column count from 1, columns and length in characters."""

    file: str
    line: int
    column: int
    length: int = 1


@dataclass(frozen=True, slots=True)
class Diagnosis:
    """What is wrong at a place, what to do about it where the message does not already say so, and the correction."""

    code: str
    message: str
    place: Place
    advice: str = ""
    correction: Correction | None = None

    @property
    def severity(self) -> Severity:
        """The severity that the catalog gives the code's kind: a mistake or a warning."""
        from bbsd.errors.catalog import severity_of

        return severity_of(self.code)


class SpecError(Exception):
    """A spec that cannot be used: all diagnoses, mistakes first, at least one, and the texts of its files.

    `source` is the spec's own text, `others` are the texts of the files that it refers to, by file name.
    """

    def __init__(
        self, diagnoses: Iterable[Diagnosis], source: Lines, others: Mapping[str, Lines] | None = None
    ) -> None:
        self.diagnoses = tuple(diagnoses)
        self.source = source
        self.others = others or {}
        super().__init__(self.diagnoses, source, self.others)

    @property
    def mistakes(self) -> tuple[Diagnosis, ...]:
        """The diagnoses because of which the spec cannot be used, without warnings."""
        return tuple(each for each in self.diagnoses if each.severity is Severity.MISTAKE)

    def line(self, place: Place) -> str:
        """Return the line that a place is on; '' if there is none."""
        return self.others.get(place.file, self.source).line(place.line)

    def corrected_lines(self, diagnosis: Diagnosis) -> list[CorrectedLine]:
        """Return the lines that a diagnosis corrects as they should be; none if it has no correction."""
        if diagnosis.correction is None:
            return []
        return corrected_lines(diagnosis.correction, self.others.get(diagnosis.place.file, self.source))

    def __str__(self) -> str:
        return "\n".join(
            f"{diagnosis.place.file}:{diagnosis.place.line}:{diagnosis.place.column}: "
            f"{diagnosis.severity}[{diagnosis.code}]: {diagnosis.message}"
            for diagnosis in self.diagnoses
        )
