"""Lists as YAML writes them where an expression is needed: `goal: [8, 8]` for list(8, 8)."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from bbsd.expression.foreign.tokens import reads
from bbsd.expression.syntax.mistakes import WHOLE, Rewriting
from bbsd.language.field_types import scalar_text
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
        advice, meant = f"write {named(path)}: {text}", text
        written: Rewriting | None = Rewriting(text, WHOLE, is_certain=True)
        if path[1] in STORED and isinstance(value, list) and _is_number(reading, path, len(value)):
            message = f"{named(path)} must be an expression, not a list"
            advice, meant, written = (
                f"it is used as one number; a list would be {text}",
                scalar_text(value[0]) or "0",
                None,
            )
            if _is_range(value):
                meant = text.replace("list(", "uniform(", 1)
                advice = f"a number drawn between the two is {meant}; a list of both is {text}"
                written = Rewriting(meant, WHOLE, is_certain=False)
            elif len(value) == reading.at(("environment", "robots")):
                advice = "each robot starts with one number: an element of a list in constants, as in starts[robot]"
        reading.tell(path, "BB022", message, advice, written, WHOLE)
        reading.explained.add(reading.origin(path))
        reading.replace(path, meant)


def _places(reading: Reading) -> list[Path]:
    blocks: list[Path] = [
        ("environment", key) for key in ("state", "world", "dynamics", "sensors", "definitions")
    ]
    for name in reading.mapping(("behaviors",)):
        actions: Path = ("behaviors", name, "actions")
        blocks += [(*actions, action) for action in reading.mapping(actions)]
    return [(*block, key) for block in blocks for key in reading.mapping(block)]


def _is_range(value: list[Data]) -> bool:
    """Return whether a list is a smaller number and a larger one, or two expressions."""
    match value:
        case [int() | float() as low, int() | float() as high]:
            return low < high
        case [int() | float() | str(), int() | float() | str()]:
            return True
    return False


def _is_number(reading: Reading, path: Path, length: int) -> bool:
    """Return whether a value is used as a number somewhere; an index of state may be that of a robot."""
    name = rf"(?<![\w.]){re.escape(str(path[-1]))}"
    if reading.has(re.compile(rf"(?<!\bin ){name}(?![\w(\[])")):
        return True
    is_of_robots = path[1] == "state" and length > 1 and reading.at(("environment", "robots")) == length
    return (
        is_of_robots
        and reading.has(re.compile(rf"{name}\["))
        and not reading.has(re.compile(rf"{name}\[[^\[\]]*\]\["))
    )
