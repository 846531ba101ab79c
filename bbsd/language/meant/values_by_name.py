"""Names that are taken for values: a state that begins as one of several names, a sensor called as what it measures."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import KEY, WHOLE, Rewriting
from bbsd.expression.syntax.parsing import NAME
from bbsd.expression.vocabulary import CONSTANTS
from bbsd.language.field_types import is_value_name, scalar_text, signature
from bbsd.language.meant.edits.layout import correction
from bbsd.language.meant.edits.uses import uses
from bbsd.language.validation import child

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

SENSORS: Path = ("environment", "sensors")
MEASURED = re.compile(r"\s*(?:cut|values)\s*\(")


def known_names(reading: Reading) -> set[str]:
    """Return the names that stand for a value in expressions, without those of a state's values."""
    blocks: list[Path] = [("constants",), *(("environment", key) for key in ("world", "state", "sensors"))]
    known = {name for block in blocks for name in reading.mapping(block)}
    known |= {name for key in reading.mapping(("environment", "definitions")) for name in signature(key)[:1]}
    observed = reading.at(("environment", "observation"))
    known |= {str(name) for name in observed} if isinstance(observed, dict | list) else set()
    return known | {*CONSTANTS, "robot", "robots", "step", "steps", "true", "false", "earned"}


def _texts(data: Data) -> Iterator[str]:
    match data:
        case dict():
            for value in data.values():
                yield from _texts(value)
        case list():
            for value in data:
                yield from _texts(value)
        case str():
            yield data


def names_at_the_start(reading: Reading) -> None:
    """Read `mode: idle`, and `mode: [idle, search]`, as one of the names that the state is set to or compared with."""
    known = known_names(reading)
    for block in ("state", "world"):
        for name, value in [*reading.mapping(("environment", block)).items()]:
            path: Path = ("environment", block, name)
            if isinstance(value, str) and value[:1] in ("'", '"') and value[-1:] == value[:1]:
                value = value[1:-1]  # noqa: PLW2901 - quotes in quotes are no part of a name
            if isinstance(value, list) and len(value) > 1 and all(_is_free(item, known) for item in value):
                found = [str(item) for item in value]
            elif _is_free(value, known) and isinstance(value, str):
                found = _used(reading, name, value, known)
            else:
                continue
            if len(found) < 2:
                continue
            new = f"one of [{', '.join(found)}]"
            message = f"{name} begins with a name: it is one of several"
            certain = isinstance(value, list)
            reading.tell(
                path, "BB136", message, f"write {name}: {new}", Rewriting(new, WHOLE, certain), WHOLE
            )
            reading.set(path, new)
            known |= {*found}


def _is_free(value: Data, known: set[str]) -> bool:
    return isinstance(value, str) and is_value_name(value) and value not in known


def _used(reading: Reading, state: str, first: str, known: set[str]) -> list[str]:
    """Return the names that a state begins with, has as cells in rules, is compared with and is set to."""
    compared = re.compile(rf"(?<![\w.]){re.escape(state)}\s*[=!]=\s*['\"]?([a-z]\w*)")
    found = [first, *_cells(reading, state)]
    found += [match[1] for text in _texts(reading.data) for match in compared.finditer(text)]
    effects = [reading.mapping(("environment", "dynamics"))]
    for behavior in reading.mapping(("behaviors",)):
        actions: Path = ("behaviors", behavior, "actions")
        effects += [reading.mapping((*actions, action)) for action in reading.mapping(actions)]
    values = [scalar_text(each.get(state)) or "" for each in effects]
    for text in values:
        arms = re.split(r"\bif\b.*?\belse\b", text)
        found += [arm.strip(" ()") for arm in arms]
    return [name for name in dict.fromkeys(found) if _is_free(name, known) and NAME.match(name)]


def _cells(reading: Reading, state: str) -> Iterator[str]:
    """Yield the cells that rules name of a state that is an input."""
    for behavior in reading.mapping(("behaviors",)):
        rules = reading.at(("behaviors", behavior, "rules"))
        for rule in rules if isinstance(rules, list) else ():
            when = child(rule, "when")
            cells = when.get(state) if isinstance(when, dict) else None
            yield from (
                str(cell) for cell in (cells if isinstance(cells, list) else [cells]) if cell is not None
            )


def sensors_named_as_state(reading: Reading) -> None:
    """Read a sensor with the name of what it measures as one with a name of its own."""
    for name, value in [*reading.mapping(SENSORS).items()]:
        block = next((key for key in ("state", "world") if name in reading.mapping(("environment", key))), "")
        if not block:
            continue
        text, path = scalar_text(value), (*SENSORS, name)
        is_cut = isinstance(value, dict) or (text is not None and MEASURED.match(text) is not None)
        new = f"{name}_is" if is_cut else f"sensed_{name}"
        first: Path = ("environment", block, name)
        key, document = reading.key(path), reading.document(path)
        if new in known_names(reading) or key is None:
            continue
        edits = [document.source.edit(key.start, key.end, new)]
        for place in _places(reading, name, is_cut=is_cut):
            node = reading.node(place)
            if node is not None and reading.document(place) is document:
                edits += [document.source.edit(*span, new) for span in uses(node, name, _word(name))]
        message = f"{name} is already the name of something in environment.{block}"
        advice = f"a name stands for one thing only; give this one another, such as {new}"
        written = correction(document, sorted(set(edits)), is_certain=False)
        reading.tell(path, "BB025", message, advice, written, KEY, (reading.origin(first),))
        for place in _places(reading, name, is_cut=is_cut):
            reading.set(place, _renamed(reading.at(place), name, new))
        reading.rename(path, new)


def _places(reading: Reading, name: str, *, is_cut: bool) -> list[Path]:
    """Return where a sensor's name is what a behavior means: its inputs and rules; of a number, conditions too."""
    places: list[Path] = []
    for behavior in reading.mapping(("behaviors",)):
        keys = ("inputs", "rules") if is_cut else ("inputs", "rules", "excited")
        places += [
            ("behaviors", behavior, key)
            for key in keys
            if reading.at(("behaviors", behavior, key)) is not None
        ]
    if not is_cut:
        places += [(*SENSORS, other) for other in reading.mapping(SENSORS) if other != name]
    return places


def _word(name: str) -> re.Pattern[str]:
    return re.compile(rf"(?<![\w.]){re.escape(name)}(?![\w(])")


def _renamed(data: Data, name: str, new: str) -> Data:
    if isinstance(data, dict):
        return {new if key == name else key: _renamed(value, name, new) for key, value in data.items()}
    if isinstance(data, list):
        return [_renamed(item, name, new) for item in data]
    return _word(name).sub(new, data) if isinstance(data, str) else data
