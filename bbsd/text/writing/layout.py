"""The house's layout of a YAML text, as edits that move blanks and quotes and touch nothing else."""

from __future__ import annotations

import re
from bisect import bisect
from collections import Counter
from dataclasses import dataclass, field
from itertools import chain
from typing import TYPE_CHECKING

from bbsd.text.nodes import Mapping, Scalar, Sequence
from bbsd.text.writing.flow import value_layout
from bbsd.text.writing.leaves import between, comments_in

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.text.nodes import Entry, Node
    from bbsd.text.source import Source

STEP = 2
LEAST_GAP = 2
"""Blanks before a comment that follows something on its line."""
COLON = re.compile(r"[ \t]*:")
DASH = re.compile(r"(?<!\S)-(?!\S)")
COMMENT = re.compile(r"(?<!\S)#[^\r\n]*")
INDENTATION = re.compile(r"(?<=[\r\n]) *(?=[^\r\n])")
INDENTATION_OF_FLOW = re.compile(r"(?<=[\r\n]) *(?=\S)")
TRAILING = re.compile(r"[ \t]+(?=[\r\n])|[ \t]+\Z")


class UnusualError(Exception):
    """A text that is written in a way whose layout is left alone, such as with `? key`."""


@dataclass(frozen=True, slots=True, order=True)
class Edit:
    """What takes the place of the characters from start up to end."""

    start: int
    end: int
    text: str


@dataclass(frozen=True, slots=True)
class Head:
    """A key, or the dash of an item: where it stands, and in which column it is to stand."""

    line: int
    column: int
    wanted: int


@dataclass(slots=True)
class _Layout:
    source: Source
    heads: list[Head] = field(default_factory=list)
    edits: list[Edit] = field(default_factory=list)
    growth: Counter[int] = field(default_factory=Counter)
    """By line, the characters that it has more, but for its indentation."""

    def column(self, offset: int) -> int:
        return offset - self.source.line_start(offset)

    def same_line(self, one: int, other: int) -> bool:
        return self.source.line_number(one) == self.source.line_number(other)

    def replace(self, start: int, end: int, text: str) -> None:
        if self.source.text[start:end] != text:
            self.edits.append(Edit(start, end, text))
            self.growth[self.source.line_number(start)] += len(text) - (end - start)

    def indent(self, start: int, end: int, column: int) -> None:
        if end - start != column:
            self.edits.append(Edit(start, end, " " * column))


def laid_out(source: Source, root: Mapping) -> str:
    """Return the text with the house's indentation, spacing and quotes; raises UnusualError."""
    layout = _Layout(source)
    _value(layout, root, 0, 0)
    _comments(layout, root)
    _trailing_blanks(layout, root)
    return _applied(source.text, layout.edits)


def _applied(text: str, edits: list[Edit]) -> str:
    pieces, done = [], 0
    for edit in sorted(edits):
        pieces += [text[done : edit.start], edit.text]
        done = edit.end
    return "".join([*pieces, text[done:]])


def _mapping(layout: _Layout, node: Mapping, column: int) -> None:
    for entry in node.entries.values():
        _head(layout, entry.key.start, column)
        shift = column - layout.column(entry.key.start)
        _colon(layout, entry)
        _leaf(layout, entry.key, shift)
        _value(layout, entry.value, column + STEP, shift)


def _head(layout: _Layout, start: int, column: int) -> None:
    """Indent the line that a key or a dash begins; one behind a dash was moved with it."""
    begin = layout.source.line_start(start)
    before = layout.source.text[begin:start]
    if before.strip(" -"):
        raise UnusualError
    layout.heads.append(Head(layout.source.line_number(start), len(before), column))
    if not before.strip():
        layout.indent(begin, start, column)


def _colon(layout: _Layout, entry: Entry) -> None:
    """Put the colon beside its key, and one blank behind it."""
    key, value, text = entry.key, entry.value, layout.source.text
    colon = COLON.match(text, key.end)
    if colon is None:
        raise UnusualError
    is_beside = layout.same_line(key.end, value.start) and not _is_unwritten(value)
    if is_beside and text[colon.end() : value.start].strip(" \t"):
        raise UnusualError
    layout.replace(key.end, value.start if is_beside else colon.end(), ": " if is_beside else ":")


def _is_unwritten(node: Node) -> bool:
    return isinstance(node, Scalar) and node.is_unwritten


def _sequence(layout: _Layout, node: Sequence, column: int) -> None:
    text, done = layout.source.text, node.start
    for item in node.items:
        between = COMMENT.sub(lambda found: "#" * len(found[0]), text[done : item.start])
        dash = DASH.search(between)
        if dash is None:
            raise UnusualError
        start = done + dash.start()
        _head(layout, start, column)
        if layout.same_line(start, item.start) and not _is_unwritten(item):
            layout.replace(start + 1, item.start, " ")
        _value(layout, item, column + STEP, column - layout.column(start))
        done = max(item.end, start + 1)


def _value(layout: _Layout, node: Node, column: int, shift: int) -> None:
    match node:
        case Mapping(flow=False):
            _mapping(layout, node, column)
        case Sequence(flow=False):
            _sequence(layout, node, column)
        case _:
            _leaf(layout, node, shift)


def _leaf(layout: _Layout, node: Node, shift: int) -> None:
    """Lay out what has no blocks in it: on one line anew, over several moved as a whole."""
    text = layout.source.text
    if layout.same_line(node.start, node.end):
        layout.replace(node.start, node.end, value_layout(text, node))
    indentation = INDENTATION if isinstance(node, Scalar) else INDENTATION_OF_FLOW
    for found in indentation.finditer(text, node.start, node.end):
        layout.indent(*found.span(), max(0, len(found[0]) + shift))


def _comments(layout: _Layout, root: Mapping) -> None:
    """Move comments with what they stand above, and keep those behind something in their column."""
    source = layout.source
    moved = {edit.start for edit in layout.edits}
    for start, _ in comments_in(source.text, root):
        begin = source.line_start(start)
        before = source.text[begin:start]
        if before.strip():
            gap = len(before) - len(before.rstrip())
            wanted = max(LEAST_GAP, gap - layout.growth[source.line_number(start)])
            layout.replace(start - gap, start, " " * wanted)
        elif begin not in moved:
            layout.indent(begin, start, _comment_column(layout, start))


def _comment_column(layout: _Layout, start: int) -> int:
    """Return the column of what follows a comment or of a block it stands in, where it has that now."""
    line, column = layout.source.line_number(start), layout.column(start)
    place = bisect(layout.heads, line, key=lambda head: head.line)
    nearest: Head | None = None
    for head in chain(_next_line(layout.heads, place), _open(layout.heads, place, column)):
        if head.column == column:
            return head.wanted
        nearest = nearest or head
    return max(0, column + nearest.wanted - nearest.column) if nearest else column


def _next_line(heads: list[Head], place: int) -> Iterator[Head]:
    line = heads[place].line if place < len(heads) else 0
    while place < len(heads) and heads[place].line == line:
        yield heads[place]
        place += 1


def _open(heads: list[Head], place: int, column: int) -> Iterator[Head]:
    """Yield the heads before a place whose blocks could go on there in a column, the nearest first."""
    least: int | None = None
    while place and (least is None or least > column):
        place -= 1
        if least is None or heads[place].column < least:
            least = heads[place].column
            yield heads[place]


def _trailing_blanks(layout: _Layout, root: Mapping) -> None:
    text = layout.source.text
    for begin, end in between(text, root):
        for found in TRAILING.finditer(text, begin, end):
            if found.end() < end or end == len(text):  # else a value follows
                layout.replace(*found.span(), "")
