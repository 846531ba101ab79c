"""Inputs and named cells in other forms: lists for mappings, conditions for names, ranges for conditions."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from pydantic_core import PydanticCustomError

from bbsd.expression.foreign.tokens import reads
from bbsd.expression.syntax.mistakes import WHOLE, ExpressionError, Rewriting
from bbsd.expression.syntax.parsing import NAME, parse
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import names_used
from bbsd.language.field_types import expression, scalar_text
from bbsd.language.meaning.partitions import is_partition
from bbsd.language.meant.edits.layout import STEP, column, correction
from bbsd.language.meant.forms import key_of_item, to_mapping
from bbsd.language.models import OTHERWISE
from bbsd.text.nodes import Sequence

if TYPE_CHECKING:
    from bbsd.errors import Edit
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

SENSORS: Path = ("environment", "sensors")
ELSE = ("else", "default", "rest", "others", "other", "any", "none of these", "true")
"""What the last of named cells is called elsewhere."""
NUMBER = r"-?\d+(?:\.\d+)?"
RANGES = (
    (re.compile(rf"(?:below|under|less than|<)\s*({NUMBER})"), "{x} < {0}"),
    (re.compile(rf"(?:from|at least|>=)\s*({NUMBER})"), "{x} >= {0}"),
    (re.compile(rf"(?:above|over|more than|>)\s*({NUMBER})"), "{x} > {0}"),
    (re.compile(rf"(?:up to|at most|<=)\s*({NUMBER})"), "{x} <= {0}"),
    (re.compile(rf"[\[(]?({NUMBER})\s*(?:to|-|–|\.\.\.?|,|:)\s*({NUMBER})[\])]?"), "{0} <= {x} < {1}"),
)
"""Ranges of a number that is not said, and the conditions that they are."""


def _partitions(reading: Reading) -> list[Path]:
    """Return the paths of what is cut into cells: sensors, and behaviors' own inputs."""
    blocks: list[Path] = [
        SENSORS,
        *(("behaviors", name, "inputs") for name in reading.mapping(("behaviors",))),
    ]
    return [(*block, name) for block in blocks for name in reading.mapping(block)]


def cells_as_lists(reading: Reading) -> None:
    """Read named cells, and inputs with partitions of their own, that are lists of `- name: ...` as mappings."""
    inputs: list[Path] = [("behaviors", name, "inputs") for name in reading.mapping(("behaviors",))]
    actions: list[Path] = [
        ("behaviors", name, "actions", action)
        for name in reading.mapping(("behaviors",))
        for action in reading.mapping(("behaviors", name, "actions"))
    ]
    for path in [*inputs, *_partitions(reading), *actions]:
        value = reading.at(path)
        if not isinstance(value, list) or not value or not all(isinstance(item, dict) for item in value):
            continue
        keys = [key_of_item(item) for item in value]
        if all(keys) and len(set(keys)) == len(keys):
            to_mapping(reading, path, value, [str(key) for key in keys])


def otherwise_by_another_name(reading: Reading) -> None:
    """Read `far: else` as the last of named cells."""
    for path in _partitions(reading):
        cells = reading.mapping(path)
        if len(cells) < 2:
            continue
        last = [*cells][-1]
        text = scalar_text(cells[last])
        known = reading.mapping(SENSORS).keys() | reading.mapping(("environment", "definitions")).keys()
        if text in ELSE and text not in known and "otherwise" not in cells.values():
            if text == "true":
                continue
            message = (
                f'the last of named cells, for all that is left, is called by otherwise, not by "{text}"'
            )
            written = Rewriting("otherwise", WHOLE)
            reading.tell((*path, last), "BB050", message, f"write {last}: otherwise", written, WHOLE)
            reading.set((*path, last), "otherwise")


def ranges_as_conditions(reading: Reading) -> None:
    """Read `near: 0 to 0.5` in named cells as a condition of a number, of which it is not said which."""
    for path in _partitions(reading):
        cells = reading.mapping(path)
        found = [
            (name, condition)
            for name, value in cells.items()
            if (condition := condition_of_range(scalar_text(value) or "", _number(reading, path)))
        ]
        if not found:
            continue
        name, condition = found[0]
        edits: list[Edit] = []
        for cell, new in found:
            node, source = reading.node((*path, cell)), reading.document(path).source
            if node is not None:
                edits.append(source.edit(node.start, node.end, new))
        message = f"a named cell needs a condition, and {scalar_text(cells[name])} does not say of what"
        written = correction(reading.document(path), edits, is_certain=False)
        advice = f"write {name}: {condition}, with the number that is meant"
        reading.tell((*path, name), "BB050", message, advice, written, WHOLE)
        for cell, new in found:
            reading.set((*path, cell), new)


def condition_of_range(text: str, number: str) -> str:
    """Return what a range asks of a number; nothing for a text that is none."""
    for pattern, form in RANGES:
        if match := pattern.fullmatch(text.strip()):
            return form.format(*match.groups(), x=number)
    return ""


def _number(reading: Reading, path: Path) -> str:
    """Return a number that named cells probably divide: one that a cell beside uses, else a sensor or a state."""
    for value in reading.mapping(path).values():
        used = _names(scalar_text(value) or "")
        if used:
            return used[0]
    for name, value in reading.mapping(SENSORS).items():
        text = scalar_text(value)
        if text is not None and path != (*SENSORS, name) and _is_number(text):
            return name
    return next(iter(reading.mapping(("environment", "state"))), "x")


def _names(text: str) -> list[str]:
    try:
        return sorted(names_used(parse(text)) - {OTHERWISE}, key=text.index)
    except ExpressionError:
        return []


def _is_number(text: str) -> bool:
    """Return whether a sensor's expression may be a number: neither a partition nor a condition."""
    try:
        is_cut = is_partition(expression(text))
    except PydanticCustomError:
        return False
    return not is_cut and not re.search(r"[<>=!]=?|\b(?:and|or|not|any|all|chance)\b", text)


def conditions_as_inputs(reading: Reading) -> None:
    """Read a condition in a list of inputs as the sensor that says the same, or as a partition with a name."""
    for behavior in [*reading.mapping(("behaviors",))]:
        path: Path = ("behaviors", behavior, "inputs")
        value = reading.at(path)
        if isinstance(value, str):
            _listed(reading, path, re.split(r"[\s,;]+", value.strip()))
        if not isinstance(value, list) or not all(isinstance(item, str) for item in value):
            continue
        texts = [str(item) for item in value]
        wrong = next((at for at, text in enumerate(texts) if not NAME.match(text) and reads(text)), None)
        if wrong is None:
            continue
        names = [text if NAME.match(text) else _named_as(reading, text) for text in texts]
        if len(set(names)) != len(names):
            continue
        sensors = reading.mapping(SENSORS)
        is_listed = all(name in sensors or name == text for name, text in zip(names, texts, strict=True))
        new: Data = [*names] if is_listed else dict(zip(names, texts, strict=True))
        message = f"inputs lists names, and {texts[wrong]} is none"
        if is_listed:
            message += f": it is what the sensor {names[wrong]} says"
            advice = f"write inputs: [{', '.join(names)}]"
        else:
            message += ": partitions of a behavior's own are a mapping, each with a name"
            advice = f"write below inputs {names[wrong]}: {texts[wrong]}"
        edits = _edits(reading, path, names, texts, is_listed=is_listed)
        written = correction(reading.document(path), edits, is_certain=is_listed)
        reading.tell((*path, wrong), "BB041", message, advice, written, WHOLE)
        parts: list[tuple[Path, Path]] = (
            [] if is_listed else [((name,), (at,)) for at, name in enumerate(names)]
        )
        reading.replace(path, new, parts)


def _listed(reading: Reading, path: Path, names: list[str]) -> None:
    """Read a text that names inputs as the list of them."""
    if not all(map(NAME.match, names)):
        return
    new = f"[{', '.join(names)}]"
    message = "inputs must be a list, also of one: a list is written in brackets"
    reading.tell(path, "BB022", message, f"write inputs: {new}", Rewriting(new, WHOLE), WHOLE)
    reading.set(path, [*names])


def _named_as(reading: Reading, text: str) -> str:
    """Return the sensor that says the same as an expression, else a name for it."""
    tree = render(parse(text))
    for name, value in reading.mapping(SENSORS).items():
        own = scalar_text(value)
        if own is not None and reads(own) and render(parse(own)) == tree:
            return name
    used = _names(text)
    return f"{used[0]}_cell" if used else "cell"


def _edits(
    reading: Reading, path: Path, names: list[str], texts: list[str], *, is_listed: bool
) -> list[Edit] | None:
    node, key, source = reading.node(path), reading.key(path), reading.document(path).source
    if not isinstance(node, Sequence) or key is None or (not node.flow and is_listed):
        return None
    if is_listed:
        return [source.edit(node.start, node.end, f"[{', '.join(names)}]")]
    indent = " " * (column(source, key.start) + STEP)
    entries = "".join(f"\n{indent}{name}: {text}" for name, text in zip(names, texts, strict=True))
    return [source.edit(source.text.index(":", key.end) + 1, node.end, entries)]
