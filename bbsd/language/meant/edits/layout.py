"""Edits of whole lines: what is indented, moved to another block, or written on one line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import Correction
from bbsd.text import read
from bbsd.text.nodes import Mapping, Scalar, Sequence

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.errors import Edit
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Document, Source
    from bbsd.text.nodes import Node

STEP = 2
"""Blanks by which a block is indented."""
MAX_CHARACTERS = 100_000


def correction(
    document: Document, edits: list[Edit] | None, *, is_certain: bool = True, below: Scalar | None = None
) -> Correction | None:
    """Return edits as a correction; None where there are none, or the file could be read less well after them.

    `below` is the key whose block they change, which is shown above it.
    """
    if not edits or len(document.source.text) > MAX_CHARACTERS:
        return None
    before, after = document, read(document.source.edited(edits))
    is_read = after.root is not None and len(after.diagnoses) <= len(before.diagnoses)
    line = document.source.line_number(below.start) if below else 0
    return Correction(tuple(edits), is_certain, line) if is_read else None


def column(source: Source, offset: int) -> int:
    """Return how many characters stand before an offset in its line."""
    return offset - source.line_start(offset)


def begins_line(source: Source, offset: int) -> bool:
    """Return whether only blanks stand before an offset in its line."""
    return not source.text[source.line_start(offset) : offset].strip()


def stretch(reading: Reading, path: Path) -> tuple[int, int] | None:
    """Return the offsets of the lines of an entry in block style: the first's start, the last's end."""
    key, node = reading.key(path), reading.node(path)
    source = reading.document(path).source
    if key is None or node is None or not begins_line(source, key.start):
        return None
    end = max(key.end, _end(node))
    return source.line_start(key.start), source.line_end(end)


def _end(node: Node) -> int:
    """Return where a node ends: a text in a block without the break that belongs to it."""
    if isinstance(node, Mapping) and not node.flow and node.entries:
        return _end([*node.entries.values()][-1].value) or node.end
    if isinstance(node, Sequence) and not node.flow and node.items:
        return _end(node.items[-1])
    return node.end - 1 if isinstance(node, Scalar) and node.style in ("|", ">") else node.end


def lines(source: Source, start: int, end: int) -> Iterator[tuple[int, str]]:
    """Yield the lines between two offsets with the offset of each."""
    for number in range(source.line_number(start), source.line_number(end) + 1):
        yield source.offset_of(number), source.line(number)


def shifted(source: Source, start: int, end: int, by: int) -> list[Edit] | None:
    """Return the edits that indent lines by so many columns, or less; None where one has not so many blanks."""
    edits = []
    for offset, line in lines(source, start, end):
        if not line.strip():
            continue
        if by < 0 and line[:-by].strip(" "):
            return None
        edits.append(source.edit(offset, offset - min(by, 0), " " * max(by, 0)))
    return edits


def moved(reading: Reading, path: Path, block: Path) -> list[Edit] | None:
    """Return the edits that move an entry in block style to the end of another block, None if they cannot."""
    document = reading.document(path)
    source, own, target = document.source, stretch(reading, path), document.node(reading.origin(block))
    if own is None or not isinstance(target, Mapping) or target.flow or not target.entries:
        return None
    first = next(iter(target.entries.values())).key
    if reading.document(block) is not document or not begins_line(source, first.start):
        return None
    by = column(source, first.start) - len(_indent(source, own[0]))
    behind = source.line_end(_end(target))
    if target.start <= own[0] <= behind:
        parent = reading.node(path[:-1])
        is_last = parent is not None and own[1] >= source.line_end(_end(parent))
        return shifted(source, *own, by) if is_last else None
    if behind < own[0] and not source.text[behind : own[0]].strip():
        return shifted(source, *own, by)
    text = "\n".join(_shifted(line, by) for _, line in lines(source, *own))
    after = source.offset_of(source.line_number(own[1]) + 1) if own[1] < len(source.text) else own[1]
    return [source.edit(own[0], after, ""), source.edit(behind, behind, f"\n{text}")]


def _shifted(line: str, by: int) -> str:
    return line if not line.strip() else line.removeprefix(" " * -by) if by < 0 else " " * by + line


def _indent(source: Source, start: int) -> str:
    line = source.text[start : source.line_end(start)]
    return line[: len(line) - len(line.lstrip(" "))]
