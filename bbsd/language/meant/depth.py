"""Blocks at the wrong depth: children that are not indented, and keys that are indented too far."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.language.base import holds_block
from bbsd.language.keys import fields_at
from bbsd.language.meant.edits.layout import STEP, column, correction, moved, shifted, stretch
from bbsd.language.validation import named

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from pydantic.fields import FieldInfo

    from bbsd.errors import Edit
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

BLOCKS_OF_EXPRESSIONS = ("world", "state", "definitions", "dynamics", "sensors")


def blocks(reading: Reading) -> Iterator[Path]:
    """Yield the paths of mappings that have keys of the language, or names with such keys below."""
    yield ()
    yield ("environment",)
    yield ("behaviors",)
    for name in [*reading.mapping(("behaviors",))]:
        yield ("behaviors", name)
        yield ("behaviors", name, "actions")
    yield ("design",)


def not_indented(reading: Reading) -> None:
    """Put entries that stand beside an empty block, and can only belong to it, below it."""
    for path in [*blocks(reading)]:
        for key, children in _empty_blocks(path, reading.mapping(path)):
            _put_below(reading, path, key, children)


def _empty_blocks(path: Path, mapping: Mapping[str, Data]) -> list[tuple[str, list[str]]]:
    """Return keys without a value, each with the keys behind it that can only belong to it."""
    found: list[tuple[str, list[str]]] = []
    fields = fields_at(path)
    waiting: list[str] | None = None
    for key, value in mapping.items():
        if value is None and _may_hold(path, key, fields):
            waiting = []
            found.append((key, waiting))
        elif waiting is not None and _belongs_below(path, key, value, fields, found[-1][0]):
            waiting.append(key)
        else:
            waiting = None
    return [(key, children) for key, children in found if children]


def _may_hold(path: Path, key: str, fields: Mapping[str, FieldInfo] | None) -> bool:
    if fields is None:
        return path == ("behaviors",) or path[2:] == ("actions",)
    return key in fields and holds_block(fields[key].annotation)


def _belongs_below(
    path: Path, key: str, value: Data, fields: Mapping[str, FieldInfo] | None, above: str
) -> bool:
    if path == ("behaviors",):
        return key in (fields_at(("behaviors", above)) or ())
    if path[2:] == ("actions",):
        return not isinstance(value, dict | list) and value is not None
    if fields is None or key in fields:
        return False
    below = fields_at((*path, above))
    return below is None or key in below


def _put_below(reading: Reading, path: Path, key: str, children: list[str]) -> None:
    block = (*path, key)
    document, above = reading.document(block), reading.key(block)
    edits: list[Edit] = []
    if above is not None:
        for name in children:
            own, key_node = stretch(reading, (*path, name)), reading.key((*path, name))
            if own is None or key_node is None:
                edits = []
                break
            by = column(document.source, above.start) + STEP - column(document.source, key_node.start)
            edits += shifted(document.source, *own, by) or []
    first, last = children[0], children[-1]
    what = first if first == last else f"{first} to {last}"
    reading.tell(
        block,
        "BB140",
        f"{named(block)} is empty: what belongs to it must be indented below it",
        f"indent {what} by two blanks more than {key}",
        correction(document, edits, below=above),
    )
    for name in children:
        reading.move((*path, name), (*block, name))


def too_deep(reading: Reading) -> None:
    """Take keys of a block out of another one in which they stand because they are indented too far."""
    for path in [*blocks(reading)]:
        fields = fields_at(path) or {}
        for key in [*reading.mapping(path)]:
            below = (*path, key)
            for inner in [*reading.mapping(below)]:
                if (
                    inner in fields
                    and inner not in reading.mapping(path)
                    and _is_astray(reading, below, inner)
                ):
                    _take_out(reading, path, key, inner)
    _take_out_of_behaviors(reading)


def _is_astray(reading: Reading, block: Path, key: str) -> bool:
    """Return whether a key cannot stand in a block: it is none of its keys, or a block among expressions."""
    value = reading.at((*block, key))
    if block[:1] == ("environment",) and block[-1] in BLOCKS_OF_EXPRESSIONS:
        is_partition = block[-1] == "sensors" and isinstance(value, dict)
        return isinstance(value, dict) and not is_partition
    if block[:1] == ("behaviors",) and block[-1] in ("actions", "inputs") and len(block) == 3:
        return isinstance(value, list) or (block[-1] == "inputs" and key == "actions")
    if block in (("constants",), ("reward",)):
        return isinstance(value, dict)
    fields = fields_at(block)
    return fields is not None and key not in fields


def _take_out_of_behaviors(reading: Reading) -> None:
    """Take blocks of the top level out of `behaviors`, where they look like behaviors."""
    behaviors = reading.mapping(("behaviors",))
    for key in ("reward", "structure", "design", "view"):
        value = behaviors.get(key)
        is_behavior = isinstance(value, dict) and "actions" in value
        if key in behaviors and key not in reading.data and not is_behavior and len(behaviors) > 1:
            _take_out(reading, (), "behaviors", key)


def _take_out(reading: Reading, path: Path, block: str, key: str) -> None:
    old, new = (*path, block, key), (*path, key)
    where = f"into {named(path)}" if path else "to the top level"
    reading.tell(
        old,
        "BB140",
        f"{key} is indented too far: it stands in {block}, and belongs {where}",
        f"begin it in the column of {block}",
        correction(reading.document(old), moved(reading, old, path)),
    )
    reading.move(old, new)
