"""Corrections: what to change in a file so that a mistake is gone, and the lines as they should be."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

MOST_LINES = 40
"""Lines of a file that a correction may change and still be shown."""


class Lines(Protocol):
    """The text that diagnoses and corrections refer to, line by line."""

    def line(self, number: int) -> str:
        """Return the line of that number, counted from 1, without its break; '' if there is none."""
        ...


class Edit(NamedTuple):
    """A text for a stretch of a file; lines and columns count from 1, in characters, and the end is exclusive.

    An edit that inserts ends where it begins. `text` may have line breaks, as may the stretch.
    """

    line: int
    column: int
    end_line: int
    end_column: int
    text: str


class Correction(NamedTuple):
    """The edits that correct a mistake, all in the file of its place; none of them overlap.

    It is certain where there is one reading of what was meant; only then may a program write it.
    """

    edits: tuple[Edit, ...]
    is_certain: bool = True
    below: int = 0
    """The line of the key whose block is changed, which is shown above it; 0 where none is."""


class CorrectedLine(NamedTuple):
    """A line as it should be, and its number where no line of the text before it is shown."""

    text: str
    number: int = 0


def corrected_lines(correction: Correction, lines: Lines) -> list[CorrectedLine]:
    """Return the lines that a correction changes as they should be, without those that it takes away.

    The first one, and each that does not stand behind the one before, has its number.
    """
    blocks = _corrected_blocks(correction, lines)
    if correction.below and blocks:
        blocks.insert(0, (correction.below, correction.below, [lines.line(correction.below)]))
    corrected: list[CorrectedLine] = []
    former = None
    for first, last, texts in blocks:
        is_apart = former is None or any(lines.line(number).strip() for number in range(former + 1, first))
        corrected += [
            CorrectedLine(text, first if at == 0 and is_apart else 0) for at, text in enumerate(texts)
        ]
        former = last
    return corrected


def _corrected_blocks(correction: Correction, lines: Lines) -> list[tuple[int, int, list[str]]]:
    """Return the first and the last line of each block of a correction, and its lines as they should be."""
    blocks: list[tuple[int, int, list[str]]] = []
    for first, last, edits in _blocks(edit for edit in correction.edits if not _takes_lines_away(edit)):
        if len(edits) == 1 and _adds_lines(edits[0], lines):
            blocks.append((first, last, [line for line in edits[0].text.split("\n") if line.strip()]))
            continue
        if last - first >= MOST_LINES:
            return []
        text, starts = "", {}
        for number in range(first, last + 1):
            starts[number] = len(text)
            text += lines.line(number) + "\n"
        for edit in reversed(edits):
            start = starts[edit.line] + edit.column - 1
            end = starts[edit.end_line] + edit.end_column - 1
            text = text[:start] + edit.text + text[end:]
        if texts := [line for line in text.split("\n") if line.strip()]:
            blocks.append((first, last, texts))
    return blocks


def _takes_lines_away(edit: Edit) -> bool:
    """Return whether an edit takes whole lines away, and nothing else."""
    return not edit.text and edit.column == edit.end_column == 1 and edit.end_line > edit.line


def _adds_lines(edit: Edit, lines: Lines) -> bool:
    """Return whether an edit adds whole lines, before a line or behind one, and changes none."""
    if (edit.line, edit.column) != (edit.end_line, edit.end_column):
        return False
    is_before = edit.column == 1 and edit.text.endswith("\n")
    return is_before or (edit.column == len(lines.line(edit.line)) + 1 and edit.text.startswith("\n"))


def _blocks(edits: Iterable[Edit]) -> Iterator[tuple[int, int, list[Edit]]]:
    """Yield edits that share a line together, with their first and their last line."""
    block: list[Edit] = []
    for edit in sorted(edits):
        if block and edit.line > max(other.end_line for other in block):
            yield block[0].line, max(other.end_line for other in block), block
            block = []
        block.append(edit)
    if block:
        yield block[0].line, max(other.end_line for other in block), block
