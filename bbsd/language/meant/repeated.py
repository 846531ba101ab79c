"""Keys that are given twice: two blocks that are one, and items of a list between which a dash is missing."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.errors import Correction
from bbsd.language.keys import blocks_with
from bbsd.language.meant.edits.layout import STEP
from bbsd.text import read

if TYPE_CHECKING:
    from bbsd.errors import Diagnosis
    from bbsd.text import Document, Source

FIRST = re.compile(r'the key "(?P<key>.*)" is given twice, first in line (?P<line>\d+)')


def given_twice(diagnosis: Diagnosis, document: Document) -> Diagnosis:
    """Return what is said of a key that is given twice, with the lines as they should be where that is known."""
    match = FIRST.fullmatch(diagnosis.message)
    if match is None:
        return diagnosis
    first, key, source = int(match["line"]), match["key"], document.source
    if (item := _item_without_dash(diagnosis, source, first, document)) is not None:
        return item
    edits = _joined(source, first, diagnosis.place.line, key)
    advice = f"write what is below it under {key} of line {first}"
    if edits is None or len(read(source.edited(edits.edits)).diagnoses) >= len(document.diagnoses):
        return replace(diagnosis, advice="keep one of the two, or give one another name")
    return replace(diagnosis, advice=advice, correction=edits)


def _joined(source: Source, first: int, second: int, key: str) -> Correction | None:
    """Return the correction that moves what is below a key in one line below the same key in another."""
    lines = [source.line(number) for number in (first, second)]
    if any(line.split(" #")[0].strip() != f"{key}:" for line in lines):
        return None
    above, below = _last_line(source, first), _last_line(source, second)
    if above >= second or below == second or above == first:
        return None
    by = _indent(source.line(first + 1)) - _indent(source.line(second + 1))
    moved = "\n".join(_shifted(source.line(number), by) for number in range(second + 1, below + 1))
    end = source.line_end(source.offset_of(above))
    start, stop = (
        source.offset_of(second),
        min(source.line_end(source.offset_of(below)) + 1, len(source.text)),
    )
    edits = (source.edit(end, end, f"\n{moved}"), source.edit(start, stop, ""))
    return Correction(edits, bool(blocks_with(key)), first)


def _last_line(source: Source, number: int) -> int:
    """Return the last line of the block that belongs to the key in a line."""
    last, lines = number, len(source.text.splitlines())
    for at in range(number + 1, lines + 1):
        line = source.line(at)
        if line.strip() and _indent(line) <= _indent(source.line(number)):
            break
        if line.strip():
            last = at
    return last


def _indent(line: str) -> int:
    return len(line) - len(line.lstrip(" "))


def _shifted(line: str, by: int) -> str:
    return " " * max(0, _indent(line) + by) + line.lstrip(" ") if line.strip() else line


def _item_without_dash(
    diagnosis: Diagnosis, source: Source, first: int, document: Document
) -> Diagnosis | None:
    """Return what is said where an item's first key is given again, or a further one behind it."""
    for number in range(diagnosis.place.line, first, -1):
        begun = re.match(r"( *)- +([\w-]+) *:", source.line(first))
        again = re.match(r" *([\w-]+) *:", source.line(number))
        before = first
        while begun is None and before > 1 and _indent(source.line(before)) >= diagnosis.place.column - 1:
            before -= 1
            begun = re.match(r"( *)- +([\w-]+) *:", source.line(before))
        if begun is None or again is None or again[1] != begun[2]:
            continue
        column = len(begun[1])
        if _indent(source.line(number)) != column + STEP:
            continue
        dash = source.offset_of(number) + column
        edits = (source.edit(dash, dash + 1, "-"),)
        if len(read(source.edited(edits)).diagnoses) >= len(document.diagnoses):
            return None
        place = diagnosis.place._replace(line=number, column=column + STEP + 1, length=len(again[1]))
        message = f'a dash is missing: "{again[1]}" begins another item, after the one in line {before}'
        return replace(
            diagnosis, message=message, place=place, advice="write - before it", correction=Correction(edits)
        )
    return None
