"""The values of names, of calls of definitions, and of indexed expressions in a scope."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import replace
from typing import TypeAlias

from bbsd.errors import did_you_mean, nearest
from bbsd.expression.elaboration.checks import has_arguments, require_kind
from bbsd.expression.elaboration.naming import bare_name
from bbsd.expression.elaboration.picking import pick
from bbsd.expression.graph import Node, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.mistaken.indices import index_of_one, value_at_a_step
from bbsd.expression.scope import (
    Deferred,
    Definition,
    Findings,
    Named,
    PerRobot,
    Scope,
    Shared,
    Unseen,
    Unusable,
    Value,
)
from bbsd.expression.syntax.mistakes import Rewriting
from bbsd.expression.syntax.text import render
from bbsd.expression.syntax.tree import Call, Expr, Index, Name, Number, Span, Unary
from bbsd.expression.vocabulary import AGGREGATES, CONSTANTS, DRAWS, FUNCTIONS
from bbsd.kernel.functions import clamp_index

LONGEST_REPEATED = 60
"""The most characters of an expression that an advice repeats."""

Elaborate: TypeAlias = Callable[[Expr, Scope], Value]
"""A function that returns the value of any expression in a scope."""


def name_value(expr: Name, scope: Scope, elaborate: Elaborate) -> Value:
    """Return the value that a name has in a scope, for the scope's robot."""
    name = expr.name
    if name in scope.local:
        return scope.local[name]
    if name in CONSTANTS:
        return scope.graph.number(CONSTANTS[name])
    match scope.names.get(name):
        case Shared(value=value):
            return value
        case Deferred(value=make):
            return make()
        case PerRobot(value=value_for) if scope.robot is not None:
            return value_for(scope.robot)
        case Definition(parameters=()) as definition:
            return _definition(expr, definition, (), scope, elaborate)
    if name not in scope.names and (bare := bare_name(name, scope)):
        return bare
    return _without_value(expr, scope)


def _without_value(expr: Name, scope: Scope) -> Node:
    name, span = expr.name, expr.span
    match scope.names.get(name):
        case PerRobot(value=value_for):
            message = f"{name} is one value for each robot; here the team is meant"
            place = "[0]" * _depth(value_for(0))
            one, other = f"{name}[r]{place}", f"{name}[0]{place}"
            advice = f"use an aggregate, like max({one} for r in team), or one robot's, like {other}"
            return scope.mistake("BB059", message, span, advice)
        case Definition(parameters=parameters):
            message = f"{name} needs arguments: {name}({', '.join(parameters)})"
            return scope.mistake("BB054", message, span)
        case Unseen():
            return report_unseen(f"{name} of the world", span, scope, name)
        case Unusable(code=code, reason=reason, advice=advice):
            return scope.mistake(code, reason, span, advice) if reason else scope.graph.unknown
    if scope.findings.is_first((scope.path, span)):
        return _unknown_name(expr, scope)
    return scope.graph.unknown


def _unknown_name(expr: Name, scope: Scope) -> Node:
    from bbsd.expression.mistaken.names import known_elsewhere

    if (known := known_elsewhere(expr, scope)) is not None:
        return scope.mistake("BB052", f'unknown name "{expr.name}"', expr.span, *known)
    message = _unknown(expr.name, scope)
    near = (
        nearest(expr.name, [*scope.local, *scope.names, *CONSTANTS, *scope.choices])
        if "did you mean" in message
        else ""
    )
    correction = Rewriting(near, expr.span, is_certain=False) if near else None
    is_start = scope.path[:-1] in (("environment", "state"), ("environment", "world"))
    advice = f"if it is one of several names, write them: one of [{expr.name}, ...]" if is_start else ""
    return scope.mistake("BB052", message, expr.span, advice, correction=correction)


def _unknown(name: str, scope: Scope) -> str:
    if name in FUNCTIONS or name in AGGREGATES or name in DRAWS:
        return f"{name} is a function and needs its arguments in parentheses"
    if name in ("team", "others"):
        return f"{name} can only stand after in: max(x[r] for r in {name})"
    known = [*scope.local, *scope.names, *CONSTANTS, *scope.choices]
    return f'unknown name "{name}"{did_you_mean(name, known)}'


def report_unseen(what: str, span: Span, scope: Scope, expression: str = "", via: str = "") -> Node:
    """Report that a behavior uses what it cannot know, perhaps `via` a definition; advise a sensor of `expression`."""
    scope.findings.unseen.append(what)
    used = f"{via}, which reads {what}" if via else what
    message = f"{scope.behavior} uses {used}; a behavior knows only its own robot's state and sensors"
    name = via or re.split(r"\W", expression)[0]
    example = f", such as sensed_{name}: {expression}," if 0 < len(expression) <= LONGEST_REPEATED else ""
    return scope.mistake("BB066", message, span, f"make a sensor of it{example} and use that")


def call_definition(expr: Call, definition: Definition, scope: Scope, elaborate: Elaborate) -> Value:
    """Return the value of a definition with parameters for the arguments of a call."""
    if not definition.parameters:
        message = f"{expr.function} has no parameters; write it without parentheses"
        return scope.mistake("BB054", message, expr.span)
    if not has_arguments(expr, len(definition.parameters), scope, definition.parameters):
        return scope.graph.unknown
    arguments = tuple(elaborate(argument, scope) for argument in expr.arguments)
    return _definition(expr, definition, arguments, scope, elaborate)


def _definition(
    use: Name | Call, definition: Definition, arguments: tuple[Value, ...], scope: Scope, elaborate: Elaborate
) -> Value:
    name = use.name if isinstance(use, Name) else use.function
    key = (name, scope.robot, arguments)
    if key not in scope.memo:
        local = dict(zip(definition.parameters, arguments, strict=True))
        findings = Findings() if scope.behavior else scope.findings
        inner = replace(scope, path=definition.path, local=local, draws=None, findings=findings)
        scope.memo[key] = elaborate(definition.expression, inner)
        if scope.behavior and findings.unseen:
            scope.memo[key], scope.unseen[key] = scope.graph.unknown, findings.unseen[0]
        elif scope.behavior:
            scope.findings.wholes += findings.wholes
            scope.findings.mistakes.update(findings.mistakes)
    if key in scope.unseen:
        return report_unseen(scope.unseen[key], use.span, scope, "" if scope.local else render(use), name)
    return scope.memo[key]


def element(expr: Index, scope: Scope, elaborate: Elaborate) -> Value:
    """Return the element of a list, or one robot's value."""
    if (told := value_at_a_step(expr, scope, elaborate)) is not None:
        return told
    if scope.behavior and (name := _name_of_robots(expr.of, scope, elaborate)):
        if scope.robots == 1:
            return index_of_one(expr, name, scope)
        return report_unseen(
            f"{name} of another robot", expr.of.span, scope, "" if scope.local else render(expr)
        )
    if (robot := _robot_first(expr, scope, elaborate)) is not None:
        return _element_of_robot(expr, robot, scope, elaborate)
    index = require_kind(elaborate(expr.index, scope), Kind.NUMBER, expr.index.span, scope)
    items = _values_of_robots(expr.of, index, scope, elaborate) or elaborate(expr.of, scope)
    return _picked(items, index, expr, scope)


def _picked(items: Value, index: Node, expr: Index, scope: Scope) -> Value:
    if not isinstance(items, tuple):
        if items.kind is Kind.UNKNOWN:
            return items
        message = "only lists, and what each robot has, can be indexed"
        return scope.mistake("BB057", message, expr.of.span)
    return index if index.kind is Kind.UNKNOWN else _pick(items, index, expr.index, scope)


def _values_of_robots(of: Expr, index: Node, scope: Scope, elaborate: Elaborate) -> tuple[Value, ...] | None:
    """Return the values of all robots, where `of` names one scalar for each of them, else None.

    If the index is known, only that robot's value is elaborated; the others are unknown.
    """
    if not isinstance(of, Name) or of.name in scope.local:
        return None
    binding = scope.names.get(of.name)
    if not (isinstance(binding, PerRobot) or (isinstance(binding, Definition) and not binding.parameters)):
        return None
    values: list[Value] = [scope.graph.unknown] * scope.robots
    last = scope.robots - 1
    for robot in [clamp_index(value_of(index), last)] if index.literal else range(scope.robots):
        values[robot] = name_value(of, scope.of_robot(robot), elaborate)
        if isinstance(values[robot], tuple):
            return None
    return tuple(values)


def _robot_first(expr: Index, scope: Scope, elaborate: Elaborate) -> Name | None:
    """Return the name of the list that is indexed, where it is each robot's and the first index is the robot.

    So it is for the team, and for a robot with one index more than the list has.
    """
    of, n_indices = expr.of, 1
    while isinstance(of, Index):
        of, n_indices = of.of, n_indices + 1
    if not isinstance(of, Name) or of.name in scope.local:
        return None
    binding = scope.names.get(of.name)
    if not (isinstance(binding, PerRobot) or (isinstance(binding, Definition) and not binding.parameters)):
        return None
    depth = _depth(name_value(of, scope if scope.robot is not None else scope.of_robot(0), elaborate))
    return of if depth and (n_indices == depth + 1 or scope.robot is None) else None


def _depth(value: Value) -> int:
    """Return how many indices lead to a scalar of a value."""
    return 1 + _depth(value[0]) if isinstance(value, tuple) and value else 0


def _element_of_robot(expr: Index, name: Name, scope: Scope, elaborate: Elaborate) -> Value:
    """Return a robot's list, or something in it: the first index is the robot."""
    if scope.behavior:
        text = "" if scope.local else render(expr)
        return report_unseen(f"{name.name} of another robot", name.span, scope, text)
    index = require_kind(elaborate(expr.index, scope), Kind.NUMBER, expr.index.span, scope)
    items: Value
    if isinstance(expr.of, Index):
        items = _element_of_robot(expr.of, name, scope, elaborate)
    else:
        items = tuple(name_value(name, scope.of_robot(robot), elaborate) for robot in range(scope.robots))
    return _picked(items, index, expr, scope)


def _name_of_robots(of: Expr, scope: Scope, elaborate: Elaborate) -> str | None:
    """Return the indexed name if it has one value for each robot; None where the behavior's robot has a list."""
    if not isinstance(of, Name) or of.name in scope.local:
        return None
    if not isinstance(scope.names.get(of.name), PerRobot | Definition):
        return None
    value = name_value(of, scope, elaborate)
    is_unknown = isinstance(value, Node) and value.kind is Kind.UNKNOWN
    return None if isinstance(value, tuple) or is_unknown else of.name


def _no_element(index: float, length: int, at: Expr, scope: Scope) -> Node:
    message = f"there is no element {index:g}; the {length} count from 0 to {length - 1}"
    if not -length <= index <= length or not index.is_integer():
        return scope.mistake("BB057", message, at.span)
    from_end = int(index) + length
    last = from_end if index < 0 else length - 1
    advice = f"write {last}" if index < 0 else f"the last is {last}"
    return scope.mistake(
        "BB057", message, at.span, advice, Rewriting(str(last), at.span, is_certain=index < 0)
    )


def _pick(items: tuple[Value, ...], index: Node, at: Expr, scope: Scope) -> Value:
    if not items:
        return scope.mistake("BB057", "an empty list has no elements", at.span)
    if is_plain_number(at) and not 0 <= value_of(index) < len(items):
        if all(isinstance(item, Node) and item.kind is Kind.UNKNOWN for item in items):
            return scope.graph.unknown
        return _no_element(value_of(index), len(items), at, scope)
    if not index.literal and len({_shape(item) for item in items}) > 1:
        if any(isinstance(item, Node) and item.kind is Kind.UNKNOWN for item in items):
            return scope.graph.unknown
        message = "rows of different lengths can only be indexed by a plain number"
        return scope.mistake("BB057", message, at.span)
    scope.findings.wholes.append((scope.path, at.span, "an index", index))
    picked = pick(items, index, scope.graph)
    if picked is scope.graph.unknown and any(isinstance(item, Named) for item in items):
        kinds = {item.kind for item in items if not isinstance(item, tuple)}
        if Kind.UNKNOWN not in kinds:
            message = "a list of values that do not have the same names can only be indexed by a plain number"
            return scope.mistake("BB139", message, at.span)
    return picked


def is_plain_number(at: Expr) -> bool:
    """Return whether an index is written as a number."""
    return isinstance(at, Number) or (isinstance(at, Unary) and isinstance(at.operand, Number))


def _shape(value: Value) -> tuple[object, ...] | None:
    """Return the shape of a value; lists that differ only in their numbers have the same."""
    return tuple(_shape(item) for item in value) if isinstance(value, tuple) else None
