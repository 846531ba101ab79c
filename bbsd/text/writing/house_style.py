"""The house style of a file: its data, comments and order stay, blanks and quotes are put in order.

Every step is checked: if its text does not read as the same data with the same comments, the step is left out.
"""

from __future__ import annotations

import json
import re
from itertools import pairwise
from typing import TYPE_CHECKING

from bbsd.text.nodes import Mapping, Sequence
from bbsd.text.reading.reader import read
from bbsd.text.source import Source
from bbsd.text.writing.entry_edits import line_break
from bbsd.text.writing.layout import UnusualError, lay_out
from bbsd.text.writing.leaves import comments_in, leaves_in

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.text.document import Document
    from bbsd.text.nodes import Entry

MAX_ROUNDS = 5  # fewer are made where a round changes nothing
LINES = re.compile(r"[^\r\n]*(?:\r\n|\r|\n|\Z)")


def in_house_style(document: Document) -> str:
    """Return the text of a document in the house style.

    Changed are the indentation (two blanks a level), blanks within lines and at their ends, blank lines (one around
    the blocks at the top, never two), and quotes that are not needed. Unchanged are the words of comments and values,
    the line breaks within values, and whether a list or mapping stands in brackets. Raises ValueError if the document
    has mistakes.
    """
    if document.diagnoses:
        raise ValueError("a text with mistakes cannot be laid out")
    for _ in range(MAX_ROUNDS):
        before = document
        for step in (_lay_out, _set_blank_lines):
            document = _if_same(document, step(document))
        if document.source.text == before.source.text:
            break
    return document.source.text


def _if_same(document: Document, text: str) -> Document:
    """Return the document of a new text if its content is the same, else the old document."""
    if text == document.source.text:
        return document
    result = read(Source(document.source.file, text))
    is_same = not result.diagnoses and _content(result) == _content(document)
    return result if is_same else document


def _content(document: Document) -> tuple[str, list[str]]:
    """Return what must not change: the data, as JSON since `==` takes 1, 1.0 and true for equal, and the comments."""
    text, root = document.source.text, document.root
    comments = [text[start:end].rstrip() for start, end in comments_in(text, root)] if root else []
    return json.dumps(document.data), comments


def _lay_out(document: Document) -> str:
    try:
        return lay_out(document.source, document.root) if document.root else document.source.text
    except UnusualError:
        return document.source.text


def _set_blank_lines(document: Document) -> str:
    """Return the text with one blank line around blocks at the top, and none at its ends or in a row."""
    if document.root is None:
        return document.source.text
    source = document.source
    lines = [match[0] for match in LINES.finditer(source.text) if match[0]]
    kept, gaps = _continued_lines(document), set(_lines_after_gaps(source, lines, document.root))
    spaced: list[str] = []
    for number, line in enumerate(lines, 1):
        is_blank = not line.strip() and number not in kept
        if number in gaps and spaced and spaced[-1].strip():
            spaced.append(line_break(source))
        if not is_blank or (spaced and spaced[-1].strip()):
            spaced.append(line)
    return "".join(spaced).rstrip() + line_break(source)


def _continued_lines(document: Document) -> set[int]:
    """Return the numbers of the lines on which a value continues: a blank line there may be part of it."""
    source, numbers = document.source, set[int]()
    for leaf in leaves_in(document.root) if document.root else ():
        numbers.update(range(source.line_number(leaf.start) + 1, source.line_number(leaf.end) + 1))
    return numbers


def _lines_after_gaps(source: Source, lines: list[str], root: Mapping) -> Iterator[int]:
    """Yield the lines that need a blank line before them: keys of blocks at the top, or the comments above those."""
    entries = [] if root.flow else [*root.entries.values()]
    for before, entry in pairwise(entries):
        if _is_block(source, before) or _is_block(source, entry):
            yield _first_line(source, lines, entry)


def _is_block(source: Source, entry: Entry) -> bool:
    is_collection = isinstance(entry.value, Mapping | Sequence)
    return is_collection and source.line_number(entry.key.start) != source.line_number(entry.value.end)


def _first_line(source: Source, lines: list[str], entry: Entry) -> int:
    number = source.line_number(entry.key.start)
    while number > 1 and lines[number - 2].startswith("#"):
        number -= 1
    return number
