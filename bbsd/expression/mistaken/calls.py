"""Calls of what cannot be called so: values that are indexed, too many arguments or too few, ranges, lengths."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.scope import Definition, Named, PerRobot
from bbsd.expression.syntax.mistakes import Rewriting
from bbsd.expression.syntax.text import number_text, render
from bbsd.expression.syntax.tree import Binary, Call, Generator, Index, Number, names_used, parts

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Scope
    from bbsd.expression.syntax.tree import Expr

TAKES = {
    "clip": "clip(x, low, high)",
    "atan2": "atan2(y, x)",
    "hypot": "hypot(x, y)",
    "normal": "normal(mean, deviation)",
    "uniform": "uniform(low, high)",
    "integers": "integers(first, last)",
    "chance": "chance(probability)",
    "range": "range(n), which counts from 0",
    "before": "before(value)",
}
"""How functions whose arguments are not obvious are called."""
LENGTHS = frozenset({"len", "length", "size", "numel", "count"})
"""What the number of a list's elements is called elsewhere."""


class Instead(NamedTuple):
    """What to say of a call, and what to write for it."""

    advice: str
    correction: Rewriting | None


def wrong_number(call: Call, parameters: Sequence[str] = ()) -> Instead:
    """Return what is said of a call with too many arguments or too few; `parameters` are those of a definition."""
    from bbsd.expression.foreign.functions import other_name

    own = f"{call.function}({', '.join(parameters)})" if parameters else f"{call.function}(x)"
    advice = f"write {TAKES.get(call.function, own)}"
    if parameters or any(isinstance(argument, Generator) for argument in call.arguments):
        return Instead(advice, None)
    other = other_name(call.function, [render(argument) for argument in call.arguments])
    if other is None:
        return Instead(advice, None)
    new, is_certain = other
    return Instead(f"write {new}" if is_certain else advice, Rewriting(new, call.span, is_certain))


def indexed(call: Call, scope: Scope) -> Instead | None:
    """Return what is said of a value that is called, `height(r)`: it is indexed; None where it has no elements."""
    binding = scope.names.get(call.function)
    is_list = isinstance(binding, PerRobot) or isinstance(scope.local.get(call.function), tuple)
    if not call.arguments or any(isinstance(argument, Generator) for argument in call.arguments):
        return None
    if isinstance(binding, Definition) or (binding is None and not is_list):
        return None
    if scope.robots == 1 and all(isinstance(each, Number) for each in call.arguments):
        advice = f"{call.function} is one value: write {call.function}; only elements of lists have an index"
        return Instead(advice, Rewriting(call.function, call.span, is_certain=False))
    new = call.function + "".join(f"[{render(argument)}]" for argument in call.arguments)
    return Instead(f"an element stands in [...]: write {new}", Rewriting(new, call.span))


def from_first_to_last(generator: Generator, function: str) -> Instead | None:
    """Return what is said of `for k in range(first, stop)`: it counts from 0; None for other generators."""
    match generator:
        case Generator(source=Call(function="range", arguments=(first, stop)), names=(name,)):
            pass
        case _:
            return None
    if isinstance(first, Number) and first.value == 0:
        new = f"range({render(stop)})"
        return Instead(f"write {new}", Rewriting(new, generator.source.span))
    length = (
        number_text(stop.value - first.value)
        if isinstance(stop, Number) and isinstance(first, Number)
        else render(Binary("-", stop, first, stop.span))
    )
    start = render(first)
    moved = re.sub(rf"\[{name}\]", f"[{name} + {start}]", render(generator.element))
    moved = re.sub(rf"(?<![\w\[])(?<!\[){name}\b(?! \+ {re.escape(start)}\])", f"({name} + {start})", moved)
    new = f"{moved} for {name} in range({length})"  # the brackets of the call belong to the generator
    return Instead(f"write {function}({new})", Rewriting(f"({new})", generator.span, is_certain=False))


def of_all_robots(expr: Expr, function: str, scope: Scope) -> Instead | None:
    """Return what is said of an aggregate of one robot's value, where that of all robots is meant; else None."""
    if scope.robots == 1 or any(isinstance(part, Index | Generator) for part in (expr, *parts(expr))):
        return None
    names = [name for name in sorted(names_used(expr)) if isinstance(scope.names.get(name), PerRobot)]
    names = [name for name in names if name not in scope.local]
    if not names:
        return None
    of_each = re.sub(rf"\b({'|'.join(names)})\b", r"\1[r]", render(expr))
    new = f"{of_each} for r in team"
    if scope.behavior:
        sensor = f"team_{names[0]}: {function}({new})"
        return Instead(
            f"a behavior knows its own robot alone: make a sensor, such as {sensor}, and use that", None
        )
    advice = f"{names[0]} is this robot's alone; for all robots, write {function}({new})"
    return Instead(advice, Rewriting(new, expr.span, is_certain=False))


def mean_by_hand(expr: Binary, scope: Scope) -> Node | None:
    """Report `sum(x) / len(x)`; None for anything else."""
    match expr:
        case Binary(
            operator="/",
            left=Call(function="sum", arguments=(left,)),
            right=Call(function=length, arguments=(right,)),
        ) if length in LENGTHS and length not in scope.names and render(left) == render(right):
            pass
        case _:
            return None
    team = of_all_robots(left, "mean", scope)
    of_team = f"{render(left)}[r] for r in team"
    new = f"mean({render(left) if team is None else of_team})"
    message = f"{length}(...) is not known, and the mean is mean(...)"
    correction = Rewriting(new, expr.span, is_certain=team is None)
    return scope.mistake("BB053", message, expr.span, f"write {new}", correction)


def number_of_elements(call: Call, value: Node | Named | tuple[object, ...], scope: Scope) -> Instead | None:
    """Return what is said of `len(x)`: lengths are known, and numbers; None where it is none."""
    (argument,) = call.arguments
    if isinstance(value, tuple):
        new = str(len(value))
        return Instead(
            f"a list keeps its length, {new} here; give it a name in constants",
            Rewriting(new, call.span, is_certain=False),
        )
    if of_all_robots(argument, "sum", scope) is not None:
        return Instead("the number of robots is robots", Rewriting("robots", call.span))
    return None
