"""Values with names: what a bare name means, what may be compared and chosen between, and what is told where not."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.errors import did_you_mean
from bbsd.errors.suggestion import nearest
from bbsd.expression.graph import Node, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.scope import Named
from bbsd.expression.syntax.mistakes import Rewriting
from bbsd.expression.syntax.text import number_text, render
from bbsd.expression.syntax.tree import Conditional, Name, OneOf
from bbsd.expression.vocabulary import CONSTANTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.expression.scope import Names, Scope, Value
    from bbsd.expression.syntax.tree import Comparison, Expr, Span

MAX_LISTED = 6
"""The most names that a message lists."""


def listed(names: Names) -> str:
    """Return names as a sentence has them: `idle, search or home`."""
    if len(names) > MAX_LISTED:
        return f"{', '.join(names[: MAX_LISTED - 1])}, ... or {names[-1]}"
    return f"{', '.join(names[:-1])} or {names[-1]}"


def bare_name(name: str, scope: Scope) -> Named | None:
    """Return what a name means that is a value of some state; None for other names."""
    lists = scope.choices.get(name)
    if lists is None:
        return None
    return Named(tuple((names, scope.graph.number(names.index(name))) for names in lists))


def is_unknown(expr: Expr, scope: Scope) -> bool:
    """Return whether an expression is a name that nothing has."""
    return isinstance(expr, Name) and not (
        expr.name in scope.local
        or expr.name in CONSTANTS
        or expr.name in scope.names
        or expr.name in scope.choices
    )


def report_no_value(name: str, span: Span, what: str, names: Names, scope: Scope) -> Node:
    """Report that a name is none of the values that something can have."""
    if not scope.findings.is_first((scope.path, span)):
        return scope.graph.unknown
    message = f'"{name}" is no value of {what}{did_you_mean(name, names)}'
    near = nearest(name, names)
    correction = Rewriting(near, span, is_certain=False) if near else None
    return scope.mistake("BB137", message, span, f"{what} is {listed(names)}", correction)


def report_unknown_values(expr: Expr, what: str, names: Names, scope: Scope) -> None:
    """Report the names that an expression may be worth, and that nothing has: they stand for values of `what`."""
    match expr:
        case Name(name=name, span=span) if is_unknown(expr, scope):
            report_no_value(name, span, what, names, scope)
        case Conditional(then=then, otherwise=otherwise):
            for arm in (then, otherwise):
                report_unknown_values(arm, what, names, scope)
        case OneOf(start=start) if start is not None:
            report_unknown_values(start, what, names, scope)


def settled(value: Value, what: str, names: Names, span: Span, scope: Scope) -> Value:
    """Return a value as one of the names that `what` can be; report any other and return the unknown one."""
    if isinstance(value, tuple) or value.kind is Kind.UNKNOWN:
        return value
    if isinstance(value, Named):
        node = value.of(names)
        if node is not None:
            return Named(((names, node),))
        message = f"{what} is {listed(names)}, and this is {listed(value.names)}"
        return scope.mistake("BB137", message, span)
    message = f"{what} is {listed(names)}, and this is {value.kind.value}"
    return scope.mistake("BB139", message, span, _name_for(value, names))


def _name_for(node: Node, names: Names) -> str:
    """Return the advice to write a name for its number."""
    if node.literal and node.kind is Kind.NUMBER and value_of(node) in range(len(names)):
        return f"write {names[int(value_of(node))]} for {number_text(value_of(node))}"
    return "write one of these names"


def one_reading(value: Value, span: Span, scope: Scope) -> Value:
    """Return a value of which it is known which state's it is; report a bare name of several states."""
    if isinstance(value, tuple):
        return tuple(one_reading(item, span, scope) for item in value)
    if not isinstance(value, Named) or value.is_settled:
        return value
    advice = "compare a state with it"
    lists = " and ".join(f"[{', '.join(names)}]" for names, _ in value.readings)
    return scope.mistake("BB137", f"this is a value of several states: of {lists}", span, advice)


def compare(expr: Comparison, values: Sequence[Value], scope: Scope) -> Node | None:
    """Return the comparison of values with names, or the unknown value after a mistake; None where none has a name.

    What an operand is that no name stands for is None among the values.
    """
    named = [
        (operand, value)
        for operand, value in zip(expr.operands, values, strict=True)
        if isinstance(value, Named)
    ]
    if not named:
        return None
    for operand, value in zip(expr.operands, values, strict=True):
        if isinstance(value, Node) and value.kind is not Kind.UNKNOWN:
            names = named[0][1].names
            message = f"{render(named[0][0])} is {listed(names)}, and is compared with {value.kind.value}"
            return scope.mistake("BB139", message, operand.span, _name_for(value, names))
    if not set(expr.operators) <= {"==", "!="}:
        return scope.mistake("BB139", "named values have no order; they can only be == or !=", expr.span)
    nodes = _together(named, scope) if len(named) == len(values) else None
    if nodes is None:
        return scope.graph.unknown
    pairs = zip(expr.operators, nodes, nodes[1:], strict=False)
    return scope.graph.fold("&", [scope.graph.apply(operator, *pair) for operator, *pair in pairs])


def _together(named: Sequence[tuple[Expr, Named]], scope: Scope) -> list[Node] | None:
    """Return values as numbers among the names that all of them are of; None after a mistake."""
    common = [
        names for names, _ in named[0][1].readings if all(value.of(names) is not None for _, value in named)
    ]
    if len(common) == 1:
        return [node for _, value in named if (node := value.of(common[0])) is not None]
    known = next(
        ((expr, value) for expr, value in named if value.is_settled and not _is_bare(expr, scope)), None
    )
    if known is None:
        first = named[0][0]
        scope.mistake("BB137", "these are names alone, and no state is compared", first.span)
        return None
    what, names = render(known[0]), known[1].names
    for expr, value in named:
        if value.of(names) is not None:
            continue
        if isinstance(expr, Name) and _is_bare(expr, scope):
            report_no_value(expr.name, expr.span, what, names, scope)
        else:
            message = f"{what} is {listed(names)}, and {render(expr)} is {listed(value.names)}"
            scope.mistake("BB139", message, expr.span, "only values of the same names can be compared")
    return None


def _is_bare(expr: Expr, scope: Scope) -> bool:
    return isinstance(expr, Name) and expr.name not in scope.local and expr.name not in scope.names


def choose(condition: Node, then: Named, otherwise: Named, span: Span, scope: Scope) -> Value:
    """Return what a conditional between values with names is."""
    readings = tuple(
        (names, scope.graph.apply("select", condition, node, other))
        for names, node in then.readings
        if (other := otherwise.of(names)) is not None
    )
    if readings:
        return Named(readings)
    message = f"one arm is {listed(then.names)}, the other {listed(otherwise.names)}"
    return scope.mistake("BB139", message, span, "both must be values of the same names")
