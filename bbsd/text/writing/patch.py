"""Write-back: the author's file with some of its blocks changed, everything else as it was."""

from __future__ import annotations

import json
from enum import Enum
from typing import TYPE_CHECKING, Final

from bbsd.text.nodes import Alias, Mapping, Sequence, child
from bbsd.text.reading.reader import read
from bbsd.text.source import MAX_BYTES, Source
from bbsd.text.writing.entry_edits import add_entry, delete_entry, replace_entry, replace_item
from bbsd.text.writing.writer import write

if TYPE_CHECKING:
    from collections.abc import Iterator
    from collections.abc import Mapping as Changes

    from bbsd.text.document import Document
    from bbsd.text.nodes import Data, DataPath, Node


class Deletion(Enum):
    """The change that removes what is at a path."""

    DELETE = "delete"


DELETE: Final = Deletion.DELETE


class TooLargeError(ValueError):
    """Data that exceed the bounds of reading; `path` leads to the change that was one too many."""

    def __init__(self, path: DataPath) -> None:
        super().__init__("these data cannot be written")
        self.path = path


def replace_blocks(
    document: Document, changes: Changes[DataPath, Data | Deletion], after: str | None = None
) -> str:
    """Return a document's text with the value at each path set, added or, for DELETE, removed, in the order given.

    Comments, order and layout outside the blocks are kept byte for byte. New keys go to the end of their mapping, at
    the top level after the key `after` if there is one. The result always reads as the data with those changes: where
    a change of the block alone cannot do that (it has an anchor that is used elsewhere, say), the block around it is
    written anew. Raises ValueError if the document has mistakes, or a path does not fit it (it leads through a single
    value, or to nothing to delete); TooLargeError where the new text would be too large to be read.
    """
    if document.diagnoses:
        raise ValueError("a text with mistakes cannot be changed")
    for path, value in changes.items():
        document = _change(document, path, value, after)
    return document.source.text


def _change(document: Document, path: DataPath, value: Data | Deletion, after: str | None) -> Document:
    wanted = with_change(document.data, path, value, after)
    for length in range(len(path), -1, -1):
        block = value if length == len(path) else _at(wanted, path[:length])
        text = _edit(document, path[:length], block, after)
        if text is not None:
            result = read_back(document.source.file, text)
            if result is not None and _identity(result.data) == _identity(wanted):
                return result
    raise TooLargeError(path)


def read_back(file: str, text: str) -> Document | None:
    """Return the document that a text is read as from a file of its own; None where it would be refused."""
    if len(text.encode()) > MAX_BYTES:
        return None
    document = read(Source(file, text))
    return None if document.diagnoses else document


def differences(before: Data, after: Data, path: DataPath = ()) -> Iterator[tuple[DataPath, Data | Deletion]]:
    """Yield the changes that turn some data into others: the path of each, and its value or DELETE."""
    match before, after:
        case dict(), dict():
            yield from (((*path, key), DELETE) for key in before if key not in after)
            for key, value in after.items():
                if key in before:
                    yield from differences(before[key], value, (*path, key))
                else:
                    yield (*path, key), value
        case list(), list() if len(before) == len(after):
            for index, pair in enumerate(zip(before, after, strict=True)):
                yield from differences(*pair, (*path, index))
        case _ if _identity(before) != _identity(after):
            yield path, after


def _identity(data: Data) -> str:
    """Return a text that is equal for equal data; unlike `==` it tells 1, 1.0 and true apart."""
    return json.dumps(data, sort_keys=True)


def with_change(data: Data, path: DataPath, value: Data | Deletion, after: str | None = None) -> Data:
    """Return data with the value at a path set, added or removed; raises ValueError as `replace_blocks`."""
    if not path:
        if isinstance(value, Deletion):
            raise ValueError("the whole cannot be deleted")
        return value
    match data, path[0]:
        case list(), int(index) if 0 <= index < len(data):
            changed = [] if _deletes(path, value) else [with_change(data[index], path[1:], value)]
            return [*data[:index], *changed, *data[index + 1 :]]
        case dict() | None, str(key):
            return _with_entry(data or {}, key, path, value, after)
    raise ValueError(f"there is nothing at {path[0]!r} to change")


def _with_entry(
    data: dict[str, Data], key: str, path: DataPath, value: Data | Deletion, after: str | None
) -> Data:
    if _deletes(path, value):
        if key not in data:
            raise ValueError(f"there is no {key!r} to delete")
        return {name: other for name, other in data.items() if name != key}
    new = with_change(data.get(key), path[1:], value)
    if key in data or after not in data:
        return {**data, key: new}
    index = [*data].index(after) + 1
    entries = [*data.items()]
    return dict([*entries[:index], (key, new), *entries[index:]])


def _deletes(path: DataPath, value: Data | Deletion) -> bool:
    return len(path) == 1 and isinstance(value, Deletion)


def _at(data: Data, path: DataPath) -> Data:
    for segment in path:
        if isinstance(data, dict):
            data = data[str(segment)]
        elif isinstance(data, list):
            data = data[int(segment)]
    return data


def _edit(document: Document, path: DataPath, value: Data | Deletion, after: str | None) -> str | None:
    """Return the text with the value at the path, None if an edit at that place alone cannot do it."""
    if not path:
        return write(value) if isinstance(value, dict) else None
    parent, segment = _written(document.root, path[:-1]), path[-1]
    match parent, segment, value:
        case Mapping(), str(key), Deletion():
            return delete_entry(document.source, parent, key)
        case _, _, Deletion():
            return None
        case Mapping(), str(key), _ if key in parent.entries:
            return replace_entry(document.source, parent, key, value)
        case Mapping(), str(key), _:
            return add_entry(document.source, parent, key, value, after if len(path) == 1 else None)
        case Sequence(), int(index), _:
            return replace_item(document.source, parent, index, value)
    return None


def _written(root: Node | None, path: DataPath) -> Node | None:
    """Return the node at a path; None if there is none, or an alias on the way, whose value is used elsewhere too."""
    node = root
    for segment in path:
        node = None if node is None or isinstance(node, Alias) else child(node, segment)
    return node
