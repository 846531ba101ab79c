"""Comparisons and conditionals: values of one kind beside each other."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.expression.elaboration.checks import require_kind
from bbsd.expression.elaboration.naming import choose, compare, is_unknown, report_no_value
from bbsd.expression.kinds import Kind
from bbsd.expression.mistaken.cells import compared_with_cell
from bbsd.expression.scope import Named
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import Name

if TYPE_CHECKING:
    from bbsd.expression.elaboration.lookup import Elaborate
    from bbsd.expression.graph import Node
    from bbsd.expression.scope import Scope, Value
    from bbsd.expression.syntax.tree import Comparison, Conditional

COMPARISON_WORK = 5
"""The work of a comparison, beside that of its nodes: long conditions repeat few nodes often."""


def comparison(expr: Comparison, scope: Scope, elaborate: Elaborate) -> Node:
    """Return whether a comparison holds, of numbers, of truths, or of values with names."""
    scope.graph.spend(COMPARISON_WORK)
    if (mistaken := compared_with_cell(expr, scope)) is not None:
        return mistaken
    nodes: list[Node] = []
    values: list[Value] = []
    for operand in expr.operands:
        node = scope.graph.unknown if is_unknown(operand, scope) else elaborate(operand, scope)
        if isinstance(node, tuple):
            advice = "compare elements, or use any(...) or all(...)"
            return scope.mistake("BB056", "lists cannot be compared", operand.span, advice)
        values.append(node)
        nodes.append(node.node if isinstance(node, Named) else node)
    _report_unknown_operands(expr, values, scope, elaborate)
    if (compared := compare(expr, values, scope)) is not None:
        return compared
    kinds = {node.kind for node in nodes} - {Kind.UNKNOWN}
    if len(kinds) > 1:
        return scope.mistake("BB055", "a truth is compared with a number", expr.span)
    if kinds == {Kind.TRUTH} and not set(expr.operators) <= {"==", "!="}:
        return scope.mistake("BB055", "truths have no order; they can only be == or !=", expr.span)
    pairs = [*zip(expr.operators, nodes, nodes[1:], strict=False)]
    for operator, left, right in pairs:
        if operator in ("==", "!=") and Kind.NUMBER is left.kind is right.kind:
            scope.findings.equalities.append((scope.path, expr.span, left, right))
    return scope.graph.fold("&", [scope.graph.apply(operator, *pair) for operator, *pair in pairs])


def _report_unknown_operands(
    expr: Comparison, values: list[Value], scope: Scope, elaborate: Elaborate
) -> None:
    """Report operands that are names which nothing has: beside a state with names they stand for its values."""
    pairs = [*zip(expr.operands, values, strict=True)]
    known = next(
        ((other, each) for other, each in pairs if isinstance(each, Named) and each.is_settled), None
    )
    for operand in expr.operands:
        if not isinstance(operand, Name) or not is_unknown(operand, scope):
            continue
        if known is None:
            elaborate(operand, scope)
        else:
            report_no_value(operand.name, operand.span, render(known[0]), known[1].names, scope)


def conditional(expr: Conditional, scope: Scope, elaborate: Elaborate) -> Value:
    """Return what a conditional chooses; both arms are single values of one kind."""
    condition = require_kind(elaborate(expr.condition, scope), Kind.TRUTH, expr.condition.span, scope)
    arms: list[Node | Named] = []
    for arm in (expr.then, expr.otherwise):
        node = elaborate(arm, scope)
        if isinstance(node, tuple):
            message = "a conditional chooses between single values, not lists"
            return scope.mistake("BB056", message, arm.span)
        arms.append(node)
    then, otherwise = arms
    kinds = {then.kind, otherwise.kind} - {Kind.UNKNOWN}
    if len(kinds) > 1:
        message = f"one arm is {then.kind.value}, the other {otherwise.kind.value}"
        return scope.mistake("BB139" if Kind.NAMED in kinds else "BB055", message, expr.span)
    if isinstance(then, Named) and isinstance(otherwise, Named):
        return choose(condition, then, otherwise, expr.span, scope)
    if isinstance(then, Named) or isinstance(otherwise, Named):
        return scope.graph.unknown
    return scope.graph.apply("select", condition, then, otherwise)
