"""A YAML document as a tree of nodes, each with its offsets in the text."""

from __future__ import annotations

from typing import NamedTuple, TypeAlias

Data: TypeAlias = dict[str, "Data"] | list["Data"] | str | int | float | bool | None
DataPath: TypeAlias = tuple[str | int, ...]


class Scalar(NamedTuple):
    """A single value: its text, as YAML reads the characters from start to end, and its data.

    The style is '' for a plain scalar, else its first character (quote, | or >). Start and end include quotes,
    anchors and a block scalar's header.
    """

    start: int
    end: int
    style: str
    text: str
    data: str | int | float | bool | None

    @property
    def is_unwritten(self) -> bool:
        """Whether this is the null that follows `key:` where nothing is written."""
        return not self.style and self.start == self.end

    @property
    def is_plain(self) -> bool:
        """Whether the value is written without quotes."""
        return not self.style and self.start < self.end


class Sequence(NamedTuple):
    """A list; it ends where its last item or its bracket ends, before any comment."""

    start: int
    end: int
    flow: bool
    items: tuple[Node, ...]


class Entry(NamedTuple):
    """A key of a mapping and its value."""

    key: Scalar
    value: Node


class Mapping(NamedTuple):
    """A mapping; it ends where its last value or its brace ends, before any comment."""

    start: int
    end: int
    flow: bool
    entries: dict[str, Entry]


class Alias(NamedTuple):
    """A repetition of a node that was anchored before."""

    start: int
    end: int
    target: Scalar | Sequence | Mapping


Node: TypeAlias = Scalar | Sequence | Mapping | Alias


def data_of(node: Node) -> Data:
    """Return the data of a node, aliases expanded; no two parts of it are the same object."""
    match node:
        case Alias():
            return data_of(node.target)
        case Mapping():
            return {key: data_of(entry.value) for key, entry in node.entries.items()}
        case Sequence():
            return [data_of(item) for item in node.items]
        case Scalar():
            return node.data


def child(node: Node, segment: str | int) -> Node | None:
    """Return the value at a key or an index of a node, also through an alias; None if there is none."""
    match node:
        case Alias():
            return child(node.target, segment)
        case Mapping() if isinstance(segment, str) and segment in node.entries:
            return node.entries[segment].value
        case Sequence() if isinstance(segment, int) and 0 <= segment < len(node.items):
            return node.items[segment]
        case _:
            return None
