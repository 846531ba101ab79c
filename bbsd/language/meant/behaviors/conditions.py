"""Cells, and lists of names, where a condition is needed: `excited: {zone: below 0.2}`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from pydantic_core import PydanticCustomError

from bbsd.expression.mistaken.cells import draws_again
from bbsd.expression.syntax.mistakes import WHOLE, ExpressionError
from bbsd.expression.syntax.one_of import is_one_of
from bbsd.expression.syntax.parsing import NAME, parse
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import Call, OneOf
from bbsd.language.field_types import expression, scalar_text
from bbsd.language.meaning.partitions import conditions_of_cells
from bbsd.language.meant.cells import SENSORS, condition_of_range
from bbsd.language.meant.edits.layout import correction

if TYPE_CHECKING:
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

STORED = ("state", "world")


def cells_as_conditions(reading: Reading) -> None:
    """Read cells, and a list of truths, where a condition is needed as the condition that they are."""
    places: list[Path] = [
        ("behaviors", name, key) for name in reading.mapping(("behaviors",)) for key in ("excited", "expects")
    ]
    for path in [*places, ("environment", "ends")]:
        value = reading.at(path)
        if isinstance(value, dict) and value:
            _cells(reading, path, value)
        elif isinstance(value, list) and value and all(isinstance(item, str) for item in value):
            _listed(reading, path, [str(item) for item in value])


def _cells(reading: Reading, path: Path, value: dict[str, Data]) -> None:
    (first, inner), *others = value.items()
    asked = inner if first in ("when", "if") and isinstance(inner, dict) and not others else value
    parts = [_condition(reading, path, name, cells) for name, cells in asked.items()]
    key = str(path[-1])
    message = f"{key} is a condition, not cells"
    if not asked or not all(parts):
        advice = f"write {key}: sonar < 0.2, or what must hold; cells stand under when, in rules"
        reading.tell(path, "BB022", message, advice, None, WHOLE)
        reading.remove(path)
        return
    text = " and ".join(f"({part})" if " or " in part and len(parts) > 1 else part for part in parts)
    name, cell = next(iter(asked.items()))
    if not isinstance(cell, list) and scalar_text(cell) not in ("true", "false"):
        message += f": {scalar_text(cell)} of {name} is {parts[0]}"
    advice = f"write {key}: {text}; cells stand under when, in rules"
    if draws_again(text):
        advice = f"make a sensor of the number that {name} cuts, and write what must hold of it"
    _tell(reading, path, message, advice, text, is_certain=True)


def _tell(reading: Reading, path: Path, message: str, advice: str, text: str, *, is_certain: bool) -> None:
    """Tell what is no condition, and read it as a text that is one; a text that draws is not proposed."""
    key, node, document = reading.key(path), reading.node(path), reading.document(path)
    written = None
    if key is not None and node is not None and not draws_again(text):
        edits = [document.source.edit(key.start, node.end, f"{path[-1]}: {text}")]
        written = correction(document, edits, is_certain=is_certain)
    reading.tell(path, "BB022", message, advice, written, WHOLE)
    if draws_again(text):
        reading.remove(path)
    else:
        reading.replace(path, text)


def _condition(reading: Reading, path: Path, name: str, cells: Data) -> str:
    """Return what holds in a cell, or in one of a list of them; nothing where that is not known."""
    if isinstance(cells, list):
        parts = [_condition(reading, path, name, cell) for cell in cells]
        return " or ".join(parts) if parts and all(parts) else ""
    label = scalar_text(cells)
    return "" if label is None else _of_cell(reading, path, name, label)


def _of_cell(reading: Reading, path: Path, name: str, label: str) -> str:
    environment = {key: reading.mapping(("environment", key)).get(name) for key in STORED}
    stored = next((value for value in environment.values() if value is not None), None)
    partition = reading.mapping(SENSORS).get(name)
    own = reading.mapping((*path[:2], "inputs")).get(name) if path[0] == "behaviors" else None
    if isinstance(stored, str) and is_one_of(stored):
        return f"{name} == {label}" if label in _names(stored) else ""
    if stored is not None:
        return _of_number(name, label)
    source = own if partition is None else partition
    if source is None:
        return ""
    try:
        if isinstance(source, dict):
            return conditions_of_cells({str(key): expression(value) for key, value in source.items()}).get(
                label, ""
            )
        read = expression(source)
    except PydanticCustomError:
        return ""
    tree = read.tree
    if isinstance(tree, Call) and tree.function in ("cut", "values") and tree.arguments:
        number = render(tree.arguments[0])
        if tree.function == "values":
            return f"{number} == {label}" if NAME.match(label) or label.lstrip("-").isdigit() else ""
        return conditions_of_cells(read).get(label, "") or condition_of_range(label, number)
    return _of_number(name if partition is not None else f"({render(tree)})", label)


def _of_number(name: str, label: str) -> str:
    if label in ("true", "false"):
        return name if label == "true" else f"not {name}"
    return condition_of_range(label, name)


def _names(text: str) -> tuple[str, ...]:
    try:
        tree = parse(text)
    except ExpressionError:
        return ()
    return tree.names if isinstance(tree, OneOf) else ()


def _listed(reading: Reading, path: Path, items: list[str]) -> None:
    """Read `excited: [contact, bumped]` as all of them."""
    text, key = " and ".join(items), str(path[-1])
    try:
        parse(text)
    except ExpressionError:
        return
    message = f"{key} is one condition, not a list"
    advice = f"write {key}: {text}"
    if len(items) > 1:
        advice += f" where all must hold, or {' or '.join(items)} where one is enough"
    _tell(reading, path, message, advice, text, is_certain=len(items) == 1)
