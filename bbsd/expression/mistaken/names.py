"""Names that other languages know, and words of a comment that are taken for names."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import nearest
from bbsd.expression.scope import Shared
from bbsd.expression.syntax.mistakes import Rewriting
from bbsd.expression.syntax.tree import Binary, Call, Name, Number, Span
from bbsd.expression.vocabulary import CONSTANTS

if TYPE_CHECKING:
    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Scope

LARGE = "1e9"
NO_NUMBER = ("none", "null", "nan", "nil", "undefined")
ELSEWHERE = {
    "inf": (LARGE, "there is no infinity: write a number beyond all others"),
    "infinity": (LARGE, "there is no infinity: write a number beyond all others"),
    "e": ("exp(1)", "the number e is exp(1), and a power of it exp(x)"),
    "tau": ("2 * pi", "a whole turn is 2 * pi"),
    "self": ("robot", "a robot's own number is robot"),
    "me": ("robot", "a robot's own number is robot"),
    "myself": ("robot", "a robot's own number is robot"),
    "robot_id": ("robot", "a robot's own number is robot"),
    "agent": ("robot", "a robot's own number is robot"),
    "n_robots": ("robots", "the number of robots is robots"),
    "num_robots": ("robots", "the number of robots is robots"),
    "n_agents": ("robots", "the number of robots is robots"),
    "time_step": ("step", "the number of the present step is step"),
    "timestep": ("step", "the number of the present step is step"),
    "ticks": ("step", "the number of the present step is step"),
}
"""Names that are known elsewhere, what is written here for them, and why."""
TIMES = ("t", "time", "now")
MARKS = ("%", "//")
"""Operators that begin a comment in MATLAB and in C."""


def known_elsewhere(expr: Name, scope: Scope) -> tuple[str, Rewriting | None] | None:
    """Return what is said of a name that other languages know, and what is written for it; None for other names."""
    name = expr.name
    if name in NO_NUMBER:
        return (
            "every value is a number or a truth from the start on: begin with a number that says so, such as -1",
            None,
        )
    if name in TIMES:
        new = "step * dt" if isinstance(scope.names.get("dt"), Shared) else "step"
        return f"the time is counted in steps: write {new}", Rewriting(new, expr.span, is_certain=False)
    if name not in ELSEWHERE:
        return None
    new, advice = ELSEWHERE[name]
    return advice, Rewriting(new, expr.span, is_certain=False)


def comment(expr: Binary, scope: Scope) -> Node | None:
    """Report words behind `%` or `//` that no name stands for, as in `0.1 % seconds`; None where they are a value."""
    match expr:
        case Binary(
            operator=operator, left=Number() | Name() | Call() as left, right=Name(name=word) as right
        ) if operator in MARKS and not any(word in names for names in (scope.local, scope.names, CONSTANTS)):
            pass
        case _:
            return None
    if nearest(word, [*scope.local, *scope.names]):
        return None
    start = left.span.start + left.span.length
    length = right.span.start + right.span.length - start
    message = f'a comment begins with #, not with "{operator}"; nothing is called {word}'
    correction = Rewriting(f"  # {word}", Span(start, length), is_certain=False)
    return scope.mistake("BB052", message, right.span, f"write # {word}", correction)
