"""From what to write for a part of a value to edits of the file in which it stands, each proven by reading it again."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import Correction
from bbsd.expression.syntax.mistakes import KEY, WHOLE, Addition, Enclosing, Rewriting, characters_of_key
from bbsd.language.meant.edits.layout import begins_line, column
from bbsd.language.validation import child
from bbsd.text import read
from bbsd.text.nodes import Mapping, Scalar, Sequence

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.errors import Edit
    from bbsd.expression.scope import Path
    from bbsd.language.lineage import Lineage
    from bbsd.text import Data, Document

MAX_CHARACTERS = 150_000
"""Characters that are read again in all: each correction is proven by reading its file, half of the time of a check."""


class Placing:
    """Finds the edits of corrections, until so much was read that no more of them are searched."""

    def __init__(self, files: Lineage) -> None:
        self._files, self._left = files, MAX_CHARACTERS

    def placed(
        self, correction: Rewriting | Enclosing | Addition | Correction | None, path: Path
    ) -> Correction | None:
        """Return a correction with its edits; None where the file would not then say what is meant."""
        if correction is None or isinstance(correction, Correction):
            return correction
        told_in = self._files.document(path)
        if isinstance(correction, Enclosing):
            correction = _enclosed(correction, path, told_in)
            if correction is None:
                return None
        path = correction.mapping if isinstance(correction, Addition) else correction.at or path
        document = self._files.document(path)
        self._left -= len(document.source.text)
        if document is not told_in:
            return None
        if isinstance(correction, Addition):
            added = _added(correction, document) if self._left >= 0 else None
            return None if added is None else Correction((added,), is_certain=False)
        edits = _edits(correction, path, document) if self._left >= 0 else None
        return None if edits is None else Correction((edits,), correction.is_certain)


def _enclosed(enclosing: Enclosing, path: Path, document: Document) -> Rewriting | None:
    """Return what is to be written for the part of an expression that gets texts around it."""
    node, (start, length) = document.node(path), enclosing.span
    if not isinstance(node, Scalar) or characters_of_key(enclosing.span) is not None:
        return None
    part = node.text[start : start + length]
    is_all = not (node.text[:start] + node.text[start + length :]).strip()
    new = f"{enclosing.before}{part}{enclosing.after}"
    if not is_all and not enclosing.before.endswith("("):
        new = f"({new})"
    return Rewriting(new, enclosing.span, is_certain=False)


def _added(addition: Addition, document: Document) -> Edit | None:
    """Return the edit that gives a block mapping another entry, on a line of its own."""
    mapping, source = document.node(addition.mapping), document.source
    if not isinstance(mapping, Mapping) or mapping.flow or not mapping.entries:
        return None
    key = next(iter(mapping.entries.values())).key
    if not begins_line(source, key.start):
        return None
    if not addition.behind:
        start = source.line_start(key.start)
        edit = source.edit(start, start, f"{' ' * column(source, key.start)}{addition.text}\n")
    else:
        entry = mapping.entries.get(addition.behind)
        if entry is None or not isinstance(entry.value, Scalar) or entry.value.style in ("|", ">"):
            return None
        end = source.line_end(entry.value.end)
        edit = source.edit(end, end, f"\n{' ' * column(source, key.start)}{addition.text}")
    return edit if _is_readable(document, [edit]) else None


def _edits(rewriting: Rewriting, path: Path, document: Document) -> Edit | None:
    node = document.node(path)
    if rewriting.at is not None and isinstance(node, Sequence) and not node.flow:
        return None
    if rewriting.span in (KEY, WHOLE):
        stretch = document.stretch(path, on_key=rewriting.span == KEY)
    elif (span := characters_of_key(rewriting.span)) is not None:
        stretch = document.stretch(path, span.start, span.length, on_key=True)
    else:
        return _within(rewriting, path, document)
    if stretch is None or not _fits_list(rewriting.text, path, document):
        return None
    edit = document.source.edit(*stretch, rewriting.text)
    return edit if _is_readable(document, [edit]) else None


def _fits_list(text: str, path: Path, document: Document) -> bool:
    """Return whether a text can stand for an item: one with commas is several items only in brackets."""
    parent = document.node(path[:-1])
    return ", " not in text or text.startswith("{") or not isinstance(parent, Sequence) or parent.flow


def _within(rewriting: Rewriting, path: Path, document: Document) -> Edit | None:
    """Return the edit of a part of an expression, of all of it in quotes where that is needed."""
    start, length = rewriting.span
    scalar, stretch = document.node(path), document.stretch(path, start, length)
    if not isinstance(scalar, Scalar) or stretch is None:
        return None
    text = scalar.text[:start] + rewriting.text + scalar.text[start + length :]
    wanted = text.split(" #")[0].rstrip()
    edit = document.source.edit(*stretch, rewriting.text)
    if _gives(document, edit, path, wanted):
        return edit
    if scalar.is_plain and '"' not in text and "\\" not in text and wanted == text.rstrip():
        edit = document.source.edit(scalar.start, scalar.end, f'"{text}"')
        return edit if _gives(document, edit, path, wanted) else None
    return None


def _gives(document: Document, edit: Edit, path: Path, text: str) -> bool:
    """Return whether a file after an edit has a text at a path, and all else as before."""
    after = read(document.source.edited([edit]))
    node = after.node(path)
    is_text = isinstance(node, Scalar) and " ".join(node.text.split()) == " ".join(text.split())
    same = _without(after.data, path) == _without(document.data, path)
    return is_text and same and len(after.diagnoses) <= len(document.diagnoses)


def _is_readable(document: Document, edits: Iterable[Edit]) -> bool:
    return len(read(document.source.edited(edits)).diagnoses) <= len(document.diagnoses)


def _without(data: Data, path: Path) -> Data:
    """Return data without what is at a path."""
    if not path:
        return None
    if isinstance(data, dict):
        return {key: _without(value, path[1:]) if key == path[0] else value for key, value in data.items()}
    if isinstance(data, list):
        return [_without(value, path[1:]) if at == path[0] else value for at, value in enumerate(data)]
    return child(data, path[0])
