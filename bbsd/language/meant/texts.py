"""Mistakes of YAML's reading, told by what was meant where the language knows it, with proven corrections."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.errors import Correction
from bbsd.expression.foreign.tokens import reads
from bbsd.expression.foreign.translating import translated
from bbsd.expression.syntax.mistakes import ExpressionError, Rewriting
from bbsd.expression.syntax.parsing import parse
from bbsd.language.meant.edits.layout import MAX_CHARACTERS, STEP
from bbsd.language.meant.forms import NAMED
from bbsd.language.meant.names import LAMBDA
from bbsd.language.meant.repeated import given_twice
from bbsd.language.validation import validate
from bbsd.text import read
from bbsd.text.writing.scalars import scalar_text

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.errors import Diagnosis, Edit
    from bbsd.text import Document, Source

TAB_WIDTHS = (2, 4, 8, 6, 3, 1)


def refined(document: Document) -> tuple[Diagnosis, ...]:
    """Return the diagnoses of a document, better told, each with a correction only if that helps."""
    if len(document.source.text) > MAX_CHARACTERS:
        return tuple(replace(each, correction=None) for each in document.diagnoses)
    return tuple(_refined(each, document) for each in document.diagnoses)


def _refined(diagnosis: Diagnosis, document: Document) -> Diagnosis:
    source = document.source
    if diagnosis.code == "BB005":
        return replace(diagnosis, correction=_without_tabs(document))
    if diagnosis.code == "BB006":
        return given_twice(diagnosis, document)
    if diagnosis.code == "BB004" and (apart := _otherwise_apart(diagnosis, document)) is not None:
        return apart
    if diagnosis.code == "BB004" and (above := _line_above(diagnosis, document)) is not None:
        return above
    if diagnosis.correction is None:
        return diagnosis
    better = _foreign(diagnosis, source) if diagnosis.code == "BB004" else diagnosis
    corrections = (each.correction for each in (better, diagnosis) if each.correction is not None)
    proven = next((each for each in corrections if _helps(each.edits, document)), None)
    return replace(better, correction=proven)


APART = re.compile(
    r"(?P<dash>\s*- +)(?P<word>otherwise|else|default)\s*\n\s+(?P<do>do|then)\s*:\s*(?P<action>[^\n#]*[^\n#\s])"
)


def _otherwise_apart(diagnosis: Diagnosis, document: Document) -> Diagnosis | None:
    """Return what is said of `- otherwise` without a colon, and `do: halt` below it; None for anything else."""
    source = document.source
    start = source.offset_of(diagnosis.place.line)
    match = APART.match(source.text, start)
    if match is None:
        return None
    edits = (source.edit(match.start("word"), match.end("action"), f"otherwise: {match['action']}"),)
    message = f"{match['word']} and {match['do']} are one: what is done stands behind otherwise"
    return replace(
        diagnosis,
        message=message,
        advice=f"write - otherwise: {match['action']}",
        correction=Correction(edits) if _helps(edits, document) else None,
    )


def _line_above(diagnosis: Diagnosis, document: Document) -> Diagnosis | None:
    """Return what is said where the line above a mistake is indented too little; None where that does not help more."""
    source, number = document.source, diagnosis.place.line
    line, above = source.line(number), source.line(number - 1) if number > 1 else ""
    by = len(line) - len(line.lstrip(" ")) - (len(above) - len(above.lstrip(" ")))
    if "indented" not in diagnosis.message or not above.strip() or above.lstrip().startswith("#") or by <= 0:
        return None
    start = source.offset_of(number - 1)
    edits = [source.edit(start, start, " " * by)]
    after = read(source.edited(edits))
    if after.diagnoses:
        return None
    mistakes = len(validate(after.data)[1])
    if diagnosis.correction is not None:
        other = read(source.edited(diagnosis.correction.edits))
        if not other.diagnoses and len(validate(other.data)[1]) <= mistakes:
            return None
    column = len(above) - len(above.lstrip(" ")) + 1
    place = diagnosis.place._replace(line=number - 1, column=column, length=max(1, len(above.strip())))
    message = f"this line is indented too little: line {number} belongs to the same block"
    advice = "the keys of one mapping begin in the same column"
    return replace(
        diagnosis, message=message, place=place, advice=advice, correction=Correction(tuple(edits))
    )


def _foreign(diagnosis: Diagnosis, source: Source) -> Diagnosis:
    """Return what is said of a value that YAML cannot read where it is an expression of another language."""
    (edit,) = diagnosis.correction.edits if diagnosis.correction else ()
    if not edit.text.startswith('"'):
        return diagnosis
    value = edit.text[1:-1]
    if (below := _below_its_key(diagnosis, edit, value, source)) is not None:
        return below
    if match := LAMBDA.fullmatch(value):
        key = _key_before(edit, source)
        start = source.line(edit.line).index(key) + 1
        new = f"{key}({match['parameters']}): {match['value']}"
        message = "a definition has its parameters in its key, and is its value"
        edits = (edit._replace(column=start, text=new),)
        return replace(diagnosis, message=message, advice=f"write {new}", correction=Correction(edits))
    try:
        parse(value)
    except ExpressionError as error:
        mistake = translated(value, error.mistake, _key_before(edit, source))
        if mistake.message == error.mistake.message or not isinstance(mistake.correction, Rewriting):
            return diagnosis
        start, length = mistake.correction.span
        new = value[:start] + mistake.correction.text + value[start + length :]
        written = edit._replace(text=scalar_text(new) if reads(new) else new)
        column = edit.column + mistake.span.start
        place = diagnosis.place._replace(line=edit.line, column=column, length=max(1, mistake.span.length))
        correction = Correction((written,), mistake.correction.is_certain)
        return replace(
            diagnosis, message=mistake.message, place=place, advice=mistake.advice, correction=correction
        )
    return diagnosis


BLOCKS = (*NAMED, "environment", "inputs", "design", "view", "marks", "paths")
"""Keys with keys below them."""


def _below_its_key(diagnosis: Diagnosis, edit: Edit, value: str, source: Source) -> Diagnosis | None:
    """Return what is said of `reward: docked: 1`, a block on the line of its key; None for other values."""
    key, match = _key_before(edit, source), re.match(r"[\w-]+: \S", value)
    if key not in BLOCKS or match is None:
        return None
    before = source.line(edit.line)[: edit.column - 1]
    indent = " " * (len(before) - len(before.lstrip()) + STEP)
    start = source.offset_of(edit.line) + len(before.rstrip())
    end = source.offset_of(edit.line) + edit.end_column - 1
    written = source.edit(start, end, f"\n{indent}{value}")
    message = f"the keys of {key} stand on lines of their own, below it"
    advice = f"write {value} on the next line, indented"
    return replace(diagnosis, message=message, advice=advice, correction=Correction((written,)))


def _key_before(edit: Edit, source: Source) -> str:
    """Return the key whose value an edit replaces."""
    return source.line(edit.line)[: edit.column - 1].strip().removeprefix("- ").removesuffix(":").strip()


def _helps(edits: Sequence[Edit], document: Document) -> bool:
    """Return whether a text is read better after edits: without mistakes, or with fewer, or up to a later line."""
    after = read(document.source.edited(edits))
    if after.root is not None and (document.root is None or len(after.diagnoses) < len(document.diagnoses)):
        return True
    if not after.diagnoses:
        return True
    last = max(edit.end_line for edit in edits)
    return document.root is None and min(each.place.line for each in after.diagnoses) > last


def _without_tabs(document: Document) -> Correction | None:
    """Return the correction that indents with blanks, by the width of a tab with which the spec reads best."""
    best: tuple[int, list[Edit]] | None = None
    for edits in _expanded(document.source):
        if edits and _helps(edits, document):
            mistakes = len(validate(read(document.source.edited(edits)).data)[1])
            if best is None or mistakes < best[0]:
                best = mistakes, edits
    return Correction(tuple(best[1])) if best else None


def _expanded(source: Source) -> Iterator[list[Edit]]:
    """Yield the edits that write blanks for tabs before the first word of each line, for each width."""
    lines = source.text.splitlines()
    starts = [(number, line[: len(line) - len(line.lstrip(" \t"))]) for number, line in enumerate(lines, 1)]
    tabbed = [(number, start) for number, start in starts if "\t" in start]
    for width in TAB_WIDTHS:
        yield [
            source.edit(
                source.offset_of(number),
                source.offset_of(number) + len(start),
                " " * len(start.expandtabs(width)),
            )
            for number, start in tabbed
        ]
