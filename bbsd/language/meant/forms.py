"""Mappings where lists are written, lists where mappings are, and single values for either."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import WHOLE
from bbsd.expression.syntax.parsing import NAME
from bbsd.language.field_types import scalar_text
from bbsd.language.meant.edits.layout import STEP, begins_line, column, correction
from bbsd.language.validation import named
from bbsd.text.nodes import Mapping, Scalar, Sequence

if TYPE_CHECKING:
    from bbsd.errors import Edit
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

NAMED = (
    "constants",
    "state",
    "world",
    "sensors",
    "definitions",
    "dynamics",
    "reward",
    "behaviors",
    "actions",
)


def named_blocks(reading: Reading) -> list[Path]:
    """Return the paths of blocks whose keys are names of the spec's own."""
    inner = ("world", "state", "definitions", "dynamics", "sensors")
    return [
        ("constants",),
        *(("environment", key) for key in inner),
        ("reward",),
        ("behaviors",),
        *(("behaviors", name, "actions") for name in reading.mapping(("behaviors",))),
    ]


def lists_of_named(reading: Reading) -> None:
    """Read a list of `- name: ...` or `- key: ...` as the mapping that it should be."""
    for path in named_blocks(reading):
        value = reading.at(path)
        if not isinstance(value, list) or not value:
            continue
        keys = [key_of_item(item) for item in value]
        if all(keys) and len(set(keys)) == len(keys):
            to_mapping(reading, path, value, [str(key) for key in keys])
        elif path[-1] == "actions" and all(isinstance(item, str) and NAME.match(item) for item in value):
            _actions_without_effects(reading, path, [str(item) for item in value])
        elif path[-1] in ("state", "world", "constants") and all(
            isinstance(item, str) and NAME.match(item) for item in value
        ):
            _values_without_start(reading, path, [str(item) for item in value])
        elif path == ("reward",) and all(isinstance(item, str | int | float) for item in value):
            _terms_without_names(reading, path, value)


def key_of_item(item: Data) -> str | None:
    """Return the name of an item: under `name`, or its only key."""
    if not isinstance(item, dict):
        return None
    if isinstance(item.get("name"), str) and len(item) > 1:
        return str(item["name"])
    return next(iter(item)) if len(item) == 1 else None


def to_mapping(reading: Reading, path: Path, items: list[Data], keys: list[str]) -> None:
    """Read a list whose items have a name each as a mapping, and tell it."""
    edits = _without_dashes(reading, path, items)
    message = f"{named(path)} is no list: each of its entries is a key, the name followed by a colon"
    reading.tell(
        (*path, 0), "BB022", message, f"write {keys[0]}:", correction(reading.document(path), edits), WHOLE
    )
    merged: dict[str, Data] = {}
    parts: list[tuple[Path, Path]] = []
    for at, (item, key) in enumerate(zip(items, keys, strict=True)):
        if not isinstance(item, dict):
            continue
        is_named = len(item) > 1
        merged[key] = (
            {name: value for name, value in item.items() if name != "name"} if is_named else item[key]
        )
        parts.append(((key,), (at,) if is_named else (at, key)))
    reading.replace(path, merged, parts)


def _without_dashes(reading: Reading, path: Path, items: list[Data]) -> list[Edit] | None:
    """Return the edits that make entries of the items of a list in block style."""
    document, node = reading.document(path), reading.node(path)
    if not isinstance(node, Sequence) or node.flow:
        return None
    source, edits = document.source, []
    for item, value in zip(node.items, items, strict=True):
        dash = source.text.rfind("-", source.line_start(item.start), item.start)
        if not isinstance(item, Mapping) or item.flow or dash < 0 or not isinstance(value, dict):
            return None
        first = next(iter(item.entries.values()))
        if len(value) == 1:
            edits.append(source.edit(dash, first.key.start, ""))
        elif first.key.text == "name":
            edits.append(source.edit(dash, first.value.end, f"{value['name']}:"))
        else:
            return None
    return edits


def _values_without_start(reading: Reading, path: Path, names: list[str]) -> None:
    node, key, source = reading.node(path), reading.key(path), reading.document(path).source
    edits = None
    if isinstance(node, Sequence) and key is not None:
        indent = " " * (column(source, key.start) + STEP)
        entries = "".join(f"\n{indent}{name}: 0" for name in names)
        edits = [source.edit(source.text.index(":", key.end) + 1, node.end, entries)]
    what = "value" if path == ("constants",) else "value at the start"
    message = f"{named(path)} is no list: each name has its {what}"
    written = correction(reading.document(path), edits, is_certain=False)
    reading.tell(path, "BB022", message, f"write {names[0]}: 0, or what it is", written, WHOLE)
    reading.replace(path, dict.fromkeys(names, 0))


def _actions_without_effects(reading: Reading, path: Path, names: list[str]) -> None:
    state, dynamics = (reading.mapping(("environment", key)) for key in ("state", "dynamics"))
    example = next((name for name in state if name not in dynamics), next(iter(state), "speed"))
    message = "actions is no list: each action is a name and what it sets"
    node, key, written = reading.node(path), reading.key(path), None
    source = reading.document(path).source
    if isinstance(node, Sequence) and node.flow and key is not None:
        indent = " " * (column(source, key.start) + STEP)
        entries = "".join(f"\n{indent}{name}: {{{example}: 0}}" for name in names)
        colon = source.text.index(":", key.end) + 1
        written = correction(
            reading.document(path), [source.edit(colon, node.end, entries)], is_certain=False
        )
    reading.tell(
        path,
        "BB022",
        message,
        f"write {names[0]}: {{{example}: ...}} and so on, each with what it sets in place of 0",
        written,
        WHOLE,
    )
    reading.replace(path, {name: {} for name in names})


def _terms_without_names(reading: Reading, path: Path, items: list[Data]) -> None:
    node, document = reading.node(path), reading.document(path)
    edits: list[Edit] | None = None
    if isinstance(node, Sequence) and not node.flow:
        source = document.source
        dashes = [source.text.rfind("-", source.line_start(item.start), item.start) for item in node.items]
        edits = [
            source.edit(dash, item.start, f"term_{at}: ")
            for at, (dash, item) in enumerate(zip(dashes, node.items, strict=True), 1)
        ]
    message = "reward is no list: each of its terms has a name"
    reading.tell(path, "BB022", message, "write term: value", correction(document, edits), WHOLE)
    reading.replace(
        path,
        {f"term_{at}": item for at, item in enumerate(items, 1)},
        [((f"term_{at}",), (at - 1,)) for at in range(1, len(items) + 1)],
    )


def single_reward(reading: Reading) -> None:
    """Read a reward that is one expression as its only term."""
    value, path = reading.at(("reward",)), ("reward",)
    text = scalar_text(value)
    if text is None or not text.strip():
        return
    node, document, key = reading.node(path), reading.document(path), reading.key(path)
    edits = None
    if isinstance(node, Scalar) and key is not None:
        edits = [document.source.edit(node.start, node.start, "\n  term: ")]
        blank = re.search(r" *\Z", document.source.text[key.end : node.start])
        if blank:
            start = node.start - len(blank[0])
            edits = [document.source.edit(start, node.start, "\n  term: ")]
    message = "reward consists of terms, each with a name, which are summed at each step"
    reading.tell(
        path, "BB022", message, f"write a name before it: term: {text}", correction(document, edits), WHOLE
    )
    reading.replace(path, {"term": value}, [(("term",), ())])


def nameless_actions(reading: Reading) -> None:
    """Read what stands where actions have their names, and sets state, as one action without a name."""
    state = reading.mapping(("environment", "state"))
    for name in [*reading.mapping(("behaviors",))]:
        path: Path = ("behaviors", name, "actions")
        effects = {
            key: value
            for key, value in reading.mapping(path).items()
            if key in state and not isinstance(value, dict | list)
        }
        if not effects or len(effects) != len(reading.mapping(path)):
            continue
        first = next(iter(effects))
        shown = ", ".join(f"{key}: {scalar_text(value) or ''}" for key, value in effects.items())
        new = f"set_{first}"
        document = reading.document(path)
        edits: list[Edit] = []
        for key in effects:
            node, key_node = reading.node((*path, key)), reading.key((*path, key))
            if key_node is None or node is None or not begins_line(document.source, key_node.start):
                edits = []
                break
            indent = " " * (key_node.start - document.source.line_start(key_node.start))
            head = f"{new}:\n{indent}  " if key == first else "  "
            edits.append(document.source.edit(key_node.start, key_node.start, head))
        message = f"an action's name is missing: {first} is what an action sets, not its name"
        reading.tell(
            (*path, first),
            "BB022",
            message,
            f"write a name above it, as in halt: {{{shown}}}",
            correction(document, edits, is_certain=False),
        )
        reading.replace(path, {new: {**effects}}, [((new,), ())])
