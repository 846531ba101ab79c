"""Actions that do not say what they set."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.foreign.tokens import reads
from bbsd.expression.syntax.mistakes import WHOLE
from bbsd.language.field_types import scalar_text
from bbsd.language.meant.edits.layout import STEP, begins_line, column, correction, lines
from bbsd.language.meant.forms import named_blocks
from bbsd.text.nodes import Mapping, Scalar

if TYPE_CHECKING:
    from bbsd.errors import Edit
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

SETTING = re.compile(
    r"(?P<verb>(?:set|let)\s+)?(?P<name>[a-z]\w*(?:\[[^\]]*\])*)\s*(?P<sign>:=|<-|[-+*/]?=(?!=)|\s)\s*(?P<value>.+)"
)
"""An effect as a statement: `speed = 0`, `speed += 1`, NetLogo's `set speed 0`."""
NEEDS_LINE = re.compile(r"[,\[\]{}#]|: ")
"""What cannot stand in braces without quotes."""


def effects_as_texts(reading: Reading) -> None:
    """Read `halt: 0`, `halt: speed = 0` and `{speed = 0}` as actions that set state."""
    found: list[tuple[Path, dict[str, Data], bool]] = []
    edits: list[Edit] | None = []
    for name in [*reading.mapping(("behaviors",))]:
        actions: Path = ("behaviors", name, "actions")
        for action in [*reading.mapping(actions)]:
            path = (*actions, action)
            read = _effects(reading, reading.at(path))
            if read is None:
                continue
            found.append((path, *read))
            own = _edits_of_effects(reading, path, read[0])
            edits = None if edits is None or own is None else edits + own
    if not found:
        return
    path, effects, _ = found[0]
    shown = ", ".join(f"{key}: {scalar_text(value)}" for key, value in effects.items())
    is_certain = all(each[2] for each in found)
    message = f"an action says which state it sets, and to what: {path[-1]} does not"
    if is_certain:
        message = f"what {path[-1]} sets is written with a colon: a key and its value"
    written = correction(reading.document(path), edits, is_certain=is_certain)
    reading.tell(path, "BB022", message, f"write {path[-1]}: {{{shown}}}", written)
    for path, effects, _ in found:
        reading.replace(path, {**effects})


def _effects(reading: Reading, value: Data) -> tuple[dict[str, Data], bool] | None:
    """Return what an action that is no mapping sets, and whether that is certain; None for other values."""
    state = reading.mapping(("environment", "state"))
    if isinstance(value, dict):
        texts = [key for key, each in value.items() if each is None and SETTING.fullmatch(key)]
        settings = [_setting(text, state) for text in texts]
        if len(texts) != len(value) or not texts or not all(settings):
            return None
        return {key: text for each in settings for key, text in (each or {}).items()}, True
    text = scalar_text(value)
    if text is None or not state:
        return None
    if (setting := _setting(text, state)) is not None:
        return {**setting}, True
    if not reads(text):
        return None
    return {_command(reading, text): value}, False


def _setting(text: str, state: dict[str, Data]) -> dict[str, str] | None:
    """Return the state that a statement sets and its value; None where it is none."""
    match = SETTING.fullmatch(text.strip())
    if match is None or match["name"].partition("[")[0] not in state or not reads(match["value"]):
        return None
    if not match["sign"].strip() and match["verb"] is None and match["value"][0] in "+-":
        return None  # a sum, as in `brake: speed - 0.2`
    operator = match["sign"].removesuffix("=").strip(":<-" if match["sign"] in (":=", "<-") else " ")
    return {match["name"]: f"{match['name']} {operator} {match['value']}" if operator else match["value"]}


def _command(reading: Reading, text: str) -> str:
    """Return the state that an action probably sets: one that its value uses, the command, or the first."""
    state, dynamics = (reading.mapping(("environment", key)) for key in ("state", "dynamics"))
    told = reading.at(("environment", "action"))
    commands = [*(told if isinstance(told, list) else [told]), *(key for key in state if key not in dynamics)]
    used = [name for name in re.findall(r"[a-z]\w*", text) if name in state]
    return next(str(name) for name in (*used, *commands, *state) if name in state)


def _edits_of_effects(reading: Reading, path: Path, effects: dict[str, Data]) -> list[Edit] | None:
    node, key, source = reading.node(path), reading.key(path), reading.document(path).source
    if isinstance(node, Mapping):
        edits = []
        for entry, (name, value) in zip(node.entries.values(), effects.items(), strict=False):
            edits.append(source.edit(entry.key.start, entry.key.end, f"{name}: {value}"))
        return edits
    if key is None or not isinstance(node, Scalar):
        return None
    texts = [f"{name}: {scalar_text(value)}" for name, value in effects.items()]
    if any(NEEDS_LINE.search(scalar_text(value) or "") or "[" in name for name, value in effects.items()):
        indent = " " * (column(source, key.start) + STEP)
        return [source.edit(key.end, node.end, ":" + "".join(f"\n{indent}{text}" for text in texts))]
    if not begins_line(source, node.start):
        return [source.edit(node.start, node.end, f"{{{', '.join(texts)}}}")]
    break_ = "\n" + " " * column(source, node.start)
    return [source.edit(node.start, node.end, break_.join(texts))]


ASSIGNED = re.compile(
    r"\s*(?P<key>[a-z]\w*(?:\([\w, ]*\))?)(?P<sign>\s*(?::=|<-|=(?!=))\s*)(?P<value>\S.*?)\s*(?:#.*)?"
)


def blocks_of_assignments(reading: Reading) -> None:
    """Read a block of nothing but lines as `dt = 0.1`, one text for YAML, as the mapping that it means."""
    for path in named_blocks(reading):
        node, source = reading.node(path), reading.document(path).source
        if not isinstance(reading.at(path), str) or not isinstance(node, Scalar) or node.style:
            continue
        found = [(at, ASSIGNED.fullmatch(line)) for at, line in lines(source, node.start, node.end)]
        matches = [(at, match) for at, match in found if match is not None]
        if len(matches) < len(found) or not begins_line(source, node.start):
            continue
        edits = [source.edit(at + each.start("sign"), at + each.end("sign"), ": ") for at, each in matches]
        first = matches[0][1]
        message = "a key is divided from its value by a colon, not by an equality sign"
        written = correction(reading.document(path), edits)
        reading.tell(path, "BB022", message, f"write {first['key']}: {first['value']}", written, WHOLE)
        reading.replace(path, {each["key"]: each["value"] for _, each in matches})
