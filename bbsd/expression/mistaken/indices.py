"""Indices of what is no list: a value at another step, as in languages where values are series over time."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.scope import PerRobot, Shared
from bbsd.expression.syntax.mistakes import Rewriting
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import Binary, Expr, Index, Name, Number, Unary

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Scope, Value

TIMES = ("step", "t", "time", "now")
"""What the present step is called in indices of series."""
DYNAMICS = ("environment", "dynamics")


def steps_back(index: Expr, scope: Scope) -> float | None:
    """Return how many steps before the present one an index means, None where it means no step."""
    match index:
        case Name(name=name) if _is_time(name, scope):
            return 0
        case Unary(operator="-", operand=Number(value=back)) if scope.robots == 1:
            return back
        case Binary(operator="-", left=Name(name=name), right=Number(value=back)) if _is_time(name, scope):
            return back
        case Binary(operator="+", left=Name(name=name), right=Number(value=ahead)) if _is_time(name, scope):
            return -ahead
    return None


def _is_time(name: str, scope: Scope) -> bool:
    return name in TIMES and name not in scope.local and (name == "step" or name not in scope.names)


def value_at_a_step(expr: Index, scope: Scope, value: Callable[[Expr, Scope], Value]) -> Node | None:
    """Report `x[step - 1]` of one number or truth, and return the unknown value; None for other indices."""
    if (back := steps_back(expr.index, scope)) is None or not isinstance(expr.of, Name):
        return None
    name = expr.of.name
    if name in scope.local or not isinstance(scope.names.get(name), PerRobot | Shared):
        return None
    one = scope if scope.robot is not None else scope.of_robot(0)
    if isinstance(value(expr.of, one), tuple):
        return None
    message = f"{name} is one value, no series over the steps"
    if back == 1 and scope.before is None and scope.behavior:
        advice = f"make a sensor of it, {name}_before: before({name}), and use that"
        return scope.mistake("BB057", message, expr.span, advice)
    if back not in (0, 1):
        advice = f"keep what is needed later in a state of its own; before({name}) is {name} one step ago"
        return scope.mistake("BB057", message, expr.span, advice)
    is_now = back == 0 or scope.path[:2] == DYNAMICS
    new = name if is_now else f"before({name})"
    means = "as it is now" if is_now else "before the step"
    correction = Rewriting(new, expr.span, is_certain=False)
    return scope.mistake("BB057", message, expr.span, f"{name} {means} is {new}", correction)


def index_of_one(expr: Index, name: str, scope: Scope) -> Node:
    """Report an index of a value that the one robot has."""
    message = f"{name} is one value, and no list: there is one robot"
    correction = Rewriting(name, expr.span, is_certain=False)
    return scope.mistake("BB057", message, expr.span, f"write {name} for {render(expr)}", correction)
