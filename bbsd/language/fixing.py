"""A spec after all corrections that have one reading."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.language.loading import check

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.errors import Correction, Diagnosis, Edit
    from bbsd.text import Source

MAX_CORRECTIONS = 200
"""Corrections of one file at most."""


@dataclass(frozen=True, slots=True)
class Made:
    """A correction that was made: the mistake, its lines as they were, and as they are."""

    diagnosis: Diagnosis
    before: tuple[str, ...]
    after: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Fixed:
    """The text of a spec after corrections, and what was corrected, in the order in which it was."""

    source: Source
    made: tuple[Made, ...]


def fixed(source: Source) -> Fixed:
    """Correct what has one reading, until nothing is left or nothing helps; done again, it changes nothing.

    A correction helps where its mistake is gone and the lines that it changed have none, or none but such as are
    corrected with certainty in their turn. Other corrections are not made. Raises SpecError where a file that the spec
    extends cannot be read.
    """
    made: list[Made] = []
    refused: set[tuple[str, Correction]] = set()
    while len(made) < MAX_CORRECTIONS:
        mistakes = check(source)
        candidates = [each for each in mistakes if _is_certain(each, source) and _key(each) not in refused]
        step = next((found for each in candidates if (found := _corrected(source, each, refused))), None)
        if step is None:
            break
        source, one = step
        made.append(one)
    return Fixed(source, tuple(made))


def _is_certain(diagnosis: Diagnosis, source: Source) -> bool:
    return (
        diagnosis.correction is not None
        and diagnosis.correction.is_certain
        and diagnosis.place.file == source.file
    )


def _key(diagnosis: Diagnosis) -> tuple[str, Correction | None]:
    return diagnosis.code, diagnosis.correction


def _corrected(
    source: Source, diagnosis: Diagnosis, refused: set[tuple[str, Correction]]
) -> tuple[Source, Made] | None:
    """Return the text after one correction, None where it does not help."""
    correction = diagnosis.correction
    if correction is None:
        return None
    after = source.edited(correction.edits)
    lines = _changed_lines(correction.edits)
    left = [each for each in check(after) if each.place.line in lines and each.place.file == source.file]
    if after.text == source.text or any(not _is_certain(each, after) or each == diagnosis for each in left):
        refused.add((diagnosis.code, correction))
        return None
    numbers = sorted({n for edit in correction.edits for n in range(edit.line, edit.end_line + 1)})
    before = tuple(source.line(number) for number in numbers)
    return after, Made(diagnosis, before, tuple(after.line(number) for number in sorted(lines)))


def _changed_lines(edits: Iterable[Edit]) -> set[int]:
    """Return the numbers of the lines that edits change, as they are after them."""
    lines, shift = set[int](), 0
    for edit in sorted(edits):
        first = edit.line + shift
        breaks = edit.text.count("\n")
        lines |= set(range(first, first + breaks + 1))
        shift += breaks - (edit.end_line - edit.line)
    return lines
