"""Places of a view that are mappings or texts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import WHOLE, Rewriting
from bbsd.language.field_types import scalar_text

if TYPE_CHECKING:
    from bbsd.expression.scope import Path
    from bbsd.language.meant.reading import Reading
    from bbsd.text import Data

PARTS = (("x", "column"), ("y", "row"), ("radius", "r", "size"))
"""What the parts of a place are called where it is a mapping."""


def places(reading: Reading) -> None:
    """Read `at: {x: x, y: y}` and `at: x, y` as the place `[x, y]`."""
    marks: list[Path] = [("view", "marks", name) for name in reading.mapping(("view", "marks"))]
    for path in (("view", "at"), *marks):
        parts = _parts(reading.at(path))
        if parts is None:
            continue
        new = f"[{', '.join(parts)}]"
        message = f"a place is a list: [x, y] or [x, y, radius], and {path[-1]} is none"
        reading.tell(path, "BB022", message, f"write {path[-1]}: {new}", Rewriting(new, WHOLE), WHOLE)
        reading.set(path, [*parts])


def _parts(value: Data) -> list[str] | None:
    """Return the parts of a place in another form; None for other values."""
    if isinstance(value, str) and ", " in value and "(" not in value:
        texts = [part.strip() for part in value.split(",")]
        return texts if 2 <= len(texts) <= len(PARTS) and all(texts) else None
    if not isinstance(value, dict) or not value:
        return None
    found = [next((key for key in names if key in value), None) for names in PARTS]
    if found[0] is None or found[1] is None or len(value) != sum(key is not None for key in found):
        return None
    parts = [scalar_text(value[key]) for key in found if key is not None]
    return None if None in parts else [str(part) for part in parts]
