"""Lists as YAML writes them where an expression is needed: `goal: [8, 8]` for list(8, 8)."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.foreign.tokens import reads
from bbsd.expression.syntax.mistakes import WHOLE, Rewriting
from bbsd.language.validation import list_text, named, names_in

if TYPE_CHECKING:
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

STORED = ("state", "world")


def lists_as_expressions(reading: Reading) -> None:
    """Read a list of numbers or expressions as `list(...)`; two numbers that are never indexed as a drawn one."""
    for path in _places(reading):
        value = reading.at(path)
        text = list_text(value) if isinstance(value, list) and value else ""
        if not text or not reads(text) or (path[1] in STORED and names_in(value)):
            continue
        message = (
            f"{named(path)} must be an expression, not a list: in expressions a list is written list(...)"
        )
        advice, is_certain = f"write {named(path)}: {text}", True
        is_drawn = isinstance(value, list) and _is_range(value) and not _is_indexed(reading, path)
        if path[1] in STORED and is_drawn:
            drawn = text.replace("list(", "uniform(", 1)
            message = f"{named(path)} must be an expression, not a list"
            advice = f"a number drawn between the two is {drawn}; a list of both is {text}"
            text, is_certain = drawn, False
        reading.tell(path, "BB022", message, advice, Rewriting(text, WHOLE, is_certain), WHOLE)
        reading.explained.add(reading.origin(path))
        reading.replace(path, text)


def _places(reading: Reading) -> list[Path]:
    blocks: list[Path] = [
        ("environment", key) for key in ("state", "world", "dynamics", "sensors", "definitions")
    ]
    for name in reading.mapping(("behaviors",)):
        actions: Path = ("behaviors", name, "actions")
        blocks += [(*actions, action) for action in reading.mapping(actions)]
    return [(*block, key) for block in blocks for key in reading.mapping(block)]


def _is_range(value: list[Data]) -> bool:
    """Return whether a list is a smaller number and a larger one."""
    match value:
        case [int() | float() as low, int() | float() as high]:
            return low < high
    return False


def _is_indexed(reading: Reading, path: Path) -> bool:
    """Return whether elements of a value are used somewhere: `goal[0]`, `for x in goal`."""
    name = re.escape(str(path[-1]))
    return _has(reading.data, re.compile(rf"(?<![\w.]){name}\s*\[|\bin {name}\b"))


def _has(data: Data, word: re.Pattern[str]) -> bool:
    if isinstance(data, dict):
        return any(word.search(key) is not None or _has(value, word) for key, value in data.items())
    if isinstance(data, list):
        return any(_has(item, word) for item in data)
    return isinstance(data, str) and word.search(data) is not None
