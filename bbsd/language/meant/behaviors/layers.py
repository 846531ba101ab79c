"""A structure in another form than a list: numbers of layers, and one text."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import KEY, WHOLE, Rewriting
from bbsd.language.meant.edits.layout import correction
from bbsd.text.nodes import Mapping, Scalar, Sequence

if TYPE_CHECKING:
    from bbsd.errors import Correction
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data
    from bbsd.text.nodes import Node

STRUCTURE: Path = ("structure",)
MARKS = r"\s*(?:->|,|>|;|\s)\s*"
"""What stands between the behaviors of one text, from the highest layer down."""


def unordered_structure(reading: Reading) -> None:
    """Read a structure that gives numbers to behaviors, or is one text, as the list that it should be."""
    value = reading.at(STRUCTURE)
    known = [*reading.mapping(("behaviors",)), "open"]
    if isinstance(value, str):
        names = re.split(MARKS, value.strip())
        if all(name in known for name in names):
            advice = f"a list is written in brackets: [{', '.join(names)}]"
            _tell(reading, names, advice, is_certain="->" not in value and names != ["open"])
        return
    numbers = _numbers(value, known)
    if not numbers:
        return
    # bbsd's own tables give the highest layer the largest number; elsewhere 1 is often the highest.
    names = [name for name, _ in sorted(numbers, key=lambda pair: -pair[1])]
    other = f"structure: [{', '.join(reversed(names))}]"
    advice = f"the largest number is the highest layer here; if 1 is, write {other}"
    _tell(reading, names, advice, ", without numbers", is_certain=len(names) == 1)


def _numbers(value: Data, known: list[str]) -> list[tuple[str, float]]:
    """Return the numbers that layers are given, as `name: number`, `number: name`, or a list of either."""
    pairs: dict[str, Data] = {}
    if isinstance(value, dict):
        pairs = value
    elif isinstance(value, list) and all(isinstance(item, dict) and len(item) == 1 for item in value):
        pairs = {key: inner for item in value if isinstance(item, dict) for key, inner in item.items()}
        if len(pairs) != len(value):
            return []
    layers: list[tuple[Data, Data]] = [*pairs.items()]
    if all(re.fullmatch(r"\d+", key) and isinstance(name, str) for key, name in pairs.items()):
        layers = [(name, int(number)) for number, name in pairs.items()]
    numbers = [
        (name, float(number))
        for name, number in layers
        if isinstance(number, int | float)
        and not isinstance(number, bool)
        and isinstance(name, str)
        and name in known
    ]
    return numbers if len(numbers) == len(pairs) else []


def _tell(reading: Reading, names: list[str], advice: str, note: str = "", *, is_certain: bool) -> None:
    node, document, key = reading.node(STRUCTURE), reading.document(STRUCTURE), reading.key(STRUCTURE)
    written: Correction | Rewriting | None = None
    if key is not None and isinstance(node, Mapping | Sequence | Scalar):
        edits = [
            document.source.edit(key.start, max(key.end, _end(node)), f"structure: [{', '.join(names)}]")
        ]
        written = correction(document, edits, is_certain=is_certain)
    message = f"structure must be a list of behaviors, from the highest layer down{note}"
    is_below = isinstance(node, Mapping | Sequence) and not node.flow
    reading.tell(STRUCTURE, "BB022", message, advice, written, KEY if is_below else WHOLE)
    reading.explained.add(reading.origin(STRUCTURE))
    reading.replace(STRUCTURE, [*names])


def _end(node: Node) -> int:
    if isinstance(node, Mapping) and not node.flow and node.entries:
        return _end([*node.entries.values()][-1].value)
    if isinstance(node, Sequence) and not node.flow and node.items:
        return _end(node.items[-1])
    return node.end
