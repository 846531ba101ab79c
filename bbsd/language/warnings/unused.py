"""Names that nothing uses."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.syntax.mistakes import KEY, Mistake

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.language.validation import LocatedMistake
    from bbsd.language.warnings.uses import Uses

WORDS = {
    "constants": "constant",
    "world": "value of the world",
    "state": "state",
    "definitions": "definition",
    "sensors": "sensor",
}

IN_TRACES = ("definitions", "sensors")
"""Blocks whose values are worth a look in a trace, also where nothing uses them."""


def unused_names(uses: Uses) -> Iterator[LocatedMistake]:
    """Yield a warning for each name that does not come to matter."""
    for name, path in uses.made.items():
        if name not in uses.live:
            word, users = WORDS[str(path[-2])], uses.users.get(name, [])
            message = f"nothing uses the {word} {name}"
            if users:
                shown = (
                    f"{users[0]}, which is of no use itself"
                    if len(users) == 1
                    else f"{users[0]} and {len(users) - 1} more, which are of no use themselves"
                )
                message = f"the {word} {name} is used only by {shown}"
            elif name in uses.needs.get(name, ()):
                message = f"the {word} {name} is used only to compute itself"
            advice = "use it where it was meant, or leave it out"
            if path[-2] in IN_TRACES and "(" not in str(path[-1]):
                advice += ", unless it is for evaluate --trace alone"
            yield path, Mistake("BB201", message, KEY, advice)
