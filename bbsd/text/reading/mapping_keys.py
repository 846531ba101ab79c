"""The keys of a mapping: each must be a text, be given once, and not be the merge key of YAML 1.1."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import Correction, Diagnosis
from bbsd.text.nodes import Alias, Entry, Mapping, Node, Scalar, Sequence
from bbsd.text.reading.traps import glued_mistake

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.text.reading.traps import Piece
    from bbsd.text.source import Source

MERGE = "<<"


def entries_of(
    source: Source, pieces: Iterable[Piece], flow: bool
) -> tuple[dict[str, Entry], list[Diagnosis]]:
    """Return the usable entries of a mapping by key, and the mistakes in its keys.

    Of a key that is given twice the first entry is kept, with what the other has besides where both are mappings; a
    number or truth as a key is kept as it is written.
    """
    entries: dict[str, Entry] = {}
    mistakes: list[Diagnosis] = []
    for key, value in pieces:
        mistake = _key_mistake(source, key, value, entries, flow)
        if isinstance(key, Scalar):
            mistake = mistake or glued_mistake(source, key, value, flow)
            if not _is_merge(key):
                entries[key.text] = _with_more(entries.get(key.text), Entry(key, value))
        if mistake:
            mistakes.append(mistake)
    return entries, mistakes


def _with_more(first: Entry | None, other: Entry) -> Entry:
    """Return the first of two entries of one key, with the entries of the other that it has not."""
    if first is None:
        return other
    if not isinstance(first.value, Mapping) or not isinstance(other.value, Mapping):
        return first
    both = {
        **first.value.entries,
        **{k: v for k, v in other.value.entries.items() if k not in first.value.entries},
    }
    return Entry(first.key, first.value._replace(entries=both))


def _key_mistake(
    source: Source, key: Node, value: Node, entries: dict[str, Entry], flow: bool
) -> Diagnosis | None:
    place = source.place(key.start, key.end)
    if not isinstance(key, Scalar) or not isinstance(key.data, str):
        return Diagnosis("BB008", f"{_named(key)} cannot be a key", place, "keys are names")
    if _is_merge(key):
        advice = "write the keys out, or mark a value with &name and repeat it with *name"
        return Diagnosis(
            "BB007", "YAML 1.2 has no merge key <<", place, advice, _written_out(source, key, value, flow)
        )
    if key.text in entries:
        line = source.line_number(entries[key.text].key.start)
        return Diagnosis("BB006", f'the key "{key.text}" is given twice, first in line {line}', place)
    return None


def _written_out(source: Source, key: Scalar, value: Node, flow: bool) -> Correction | None:
    """Return the correction that writes out what is merged, if that is a mapping with a line for each entry."""
    target = value.target if isinstance(value, Alias) else value
    if not isinstance(target, Mapping) or not target.entries:
        return None
    entries = [source.text[entry.key.start : entry.value.end] for entry in target.entries.values()]
    if any("\n" in entry for entry in entries):
        return None
    indent = " " * (key.start - source.line_start(key.start))
    text = ", ".join(entries) if flow else f"\n{indent}".join(entries)
    return Correction((source.edit(key.start, value.end, text),))


def _is_merge(key: Scalar) -> bool:
    return key.is_plain and key.text == MERGE


def _named(key: Node) -> str:
    match key:
        case Mapping():
            return "a mapping"
        case Sequence():
            return "a list"
        case Scalar(data=bool()):
            return f"the truth {key.text}"
        case Scalar(data=None):
            return "null"
        case Scalar():
            return f"the number {key.text}"
        case _:
            return "an alias"
