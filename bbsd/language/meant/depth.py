"""Blocks at the wrong depth: children that are not indented, and keys that are indented too far or too little."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.foreign.tokens import reads
from bbsd.expression.syntax.parsing import NAME, parse
from bbsd.expression.syntax.tree import names_used
from bbsd.language.base import holds_block
from bbsd.language.goals import is_goal
from bbsd.language.keys import fields_at
from bbsd.language.meant.edits.layout import STEP, column, correction, moved, shifted, stretch
from bbsd.language.meant.words import ENVIRONMENT, TOP
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


def too_shallow(reading: Reading) -> None:
    """Put keys that stand beside the block above them, and can only belong to it, below it."""
    for path in [*blocks(reading)]:
        above: dict[int, str] = {}
        for key, file in _keys_in_order(reading, path):
            if file in above and _belongs_above(reading, path, key, above[file]):
                _put_above(reading, path, key, above[file])
            else:
                above[file] = key


def _keys_in_order(reading: Reading, path: Path) -> list[tuple[str, int]]:
    """Return the keys of a block that begin lines, as they stand in their files, each with its file's identity."""
    placed = [
        (own.start, key, id(reading.document((*path, key))))
        for key in reading.mapping(path)
        if (own := reading.key((*path, key))) is not None
    ]
    return [(key, file) for _, key, file in sorted(placed)]


def _belongs_above(reading: Reading, path: Path, key: str, above: str) -> bool:
    """Return whether a key that has no place in a block has one in the entry above it, which has none of that name."""
    value, block = reading.at((*path, key)), (*path, above)
    inner = reading.mapping(block)
    is_given = key in inner and reading.document((*block, key)) is reading.document((*path, key))
    if not inner or is_given or key in (fields_at(path) or ()) or is_goal((*path, key)):
        return False
    if (path == () and key in TOP) or (path == ("environment",) and key in ENVIRONMENT):
        return False
    if path == ("behaviors",):
        own = fields_at(block) or {}
        is_behavior = isinstance(value, dict) and not own.keys().isdisjoint(value)
        return key in own and not is_behavior and not own.keys().isdisjoint(inner)
    if path[2:] == ("actions",):
        is_value = value is not None and not isinstance(value, dict | list)
        return is_value and key.partition("[")[0] in reading.mapping(("environment", "state"))
    if path[:1] == ("behaviors",):
        state = reading.mapping(("environment", "state"))
        effects = {name.partition("[")[0] for name in value} if isinstance(value, dict) else set()
        return above == "actions" and bool(effects) and effects <= state.keys()
    if path == ("environment",) and above in BLOCKS_OF_EXPRESSIONS:
        stored = {**reading.mapping((*path, "state")), **reading.mapping((*path, "world"))}
        is_listed = _is_used(reading, key) and not isinstance(value, list)
        return key in stored if above == "dynamics" else is_listed
    if path == () and above == "behaviors":
        own = fields_at(("behaviors", key)) or {}
        return isinstance(value, dict) and "actions" in value and value.keys() <= own.keys()
    if path == () and above == "reward":
        return _is_term(reading, value)
    return path == () and above == "constants" and not isinstance(value, dict) and _is_used(reading, key)


def _is_term(reading: Reading, value: Data) -> bool:
    """Return whether a text is an expression of what a spec knows, as the terms of its reward are."""
    if not isinstance(value, str) or not reads(value):
        return False
    inner = ("state", "world", "sensors", "definitions")
    known = {name for block in inner for name in reading.mapping(("environment", block))}
    return not names_used(parse(value)).isdisjoint(known)


def _is_used(reading: Reading, name: str) -> bool:
    """Return whether a name stands in a value somewhere."""
    word = re.compile(rf"(?<![\w.]){re.escape(name)}(?![\w(])")
    return NAME.match(name) is not None and reading.has(word)


def _put_above(reading: Reading, path: Path, key: str, above: str) -> None:
    old, new = (*path, key), (*path, above, key)
    document = reading.document(old)
    where = named(path) if path else "the top level"
    place = f"among the {where}" if path == ("behaviors",) else f"in {where}" if path else f"at {where}"
    reading.tell(
        old,
        "BB140",
        f"{key} is indented too little: it stands {place}, and belongs to {above}",
        f"begin it in the column of the keys of {above}",
        correction(document, moved(reading, old, (*path, above))),
    )
    reading.move(old, new)
