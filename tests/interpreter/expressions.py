"""What an expression is worth: a walk over its tree, written from the language's reference alone."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from functools import reduce
from operator import add, and_, eq, ge, gt, le, lt, mul, ne, neg, not_, or_, pos, sub
from typing import Any

from bbsd.expression.syntax.tree import (
    Binary,
    Call,
    Comparison,
    Conditional,
    Expr,
    Generator,
    Index,
    Logical,
    Name,
    Number,
    OneOf,
    Truth,
    Unary,
)
from bbsd.expression.vocabulary import CONSTANTS, DRAWS, FUNCTIONS
from bbsd.kernel import functions

Value = Any
"""A float, a bool, a name, or a list of values."""
Draw = Callable[[Call | OneOf, tuple[int, ...], list[Value]], Value]
"""What a draw gives: its call in the tree, the positions in the generators around it, and its arguments."""

ARITHMETIC = {
    "+": add,
    "-": sub,
    "*": mul,
    "/": functions.divide,
    "//": functions.floor_divide,
    "%": functions.modulo,
    "**": functions.power,
}
SIGNS: dict[str, Callable[[Value], Value]] = {"-": neg, "+": pos, "not": not_}
COMPARISONS = {"<": lt, "<=": le, ">": gt, ">=": ge, "==": eq, "!=": ne}
BETTER: dict[str, Callable[[Value, Value], bool]] = {"argmin": lt, "argmax": gt}
JOINTS = {"and": and_, "or": or_}
FOLDS = {"sum": add, "min": functions.minimum, "max": functions.maximum, "any": or_, "all": and_}


@dataclass(frozen=True)
class Definition:
    """A name for an expression, and the parameters in it."""

    parameters: tuple[str, ...]
    body: Expr


@dataclass(frozen=True)
class Moment:
    """One time: what each name is worth to each robot, and the beginning of its step."""

    value: Callable[[str, int], Value]
    step: int = 0
    before: Moment | None = None


@dataclass(frozen=True)
class Scope:
    """All that an expression can see."""

    moment: Moment
    robots: int
    robot: int
    draw: Draw
    definitions: Mapping[str, Definition] = field(default_factory=dict)
    local: Mapping[str, Value] = field(default_factory=dict)
    positions: tuple[int, ...] = ()
    choices: frozenset[str] = frozenset()
    """The names that values can be; such a name means itself."""


def evaluate(expr: Expr, scope: Scope) -> Value:
    """The value of an expression; all its parts are evaluated, whether they matter or not."""
    match expr:
        case Number(value=value) | Truth(value=value):
            return value
        case Name(name=name):
            return named(name, scope)
        case Unary(operator=operator, operand=operand):
            return unary(operator, evaluate(operand, scope))
        case Binary(operator=operator, left=left, right=right):
            return ARITHMETIC[operator](evaluate(left, scope), evaluate(right, scope))
        case Comparison(operators=operators, operands=operands):
            return compared(operators, [evaluate(operand, scope) for operand in operands])
        case Logical(operator=operator, operands=operands):
            return reduce(JOINTS[operator], [evaluate(operand, scope) for operand in operands])
        case Conditional(condition=condition, then=then, otherwise=otherwise):
            arms = evaluate(otherwise, scope), evaluate(then, scope)
            return arms[evaluate(condition, scope)]
        case Index():
            return indexed(expr, scope)
        case Call():
            return called(expr, scope)
        case OneOf(names=names, start=None, at_random=True):
            return names[int(scope.draw(expr, scope.positions, [0.0, len(names) - 1.0]))]
        case OneOf(names=names, start=start):
            return names[0] if start is None else evaluate(start, scope)
    raise AssertionError(expr)


def unary(operator: str, value: Value) -> Value:
    return SIGNS[operator](value)


def compared(operators: tuple[str, ...], values: list[Value]) -> bool:
    pairs = zip(operators, values, values[1:], strict=False)
    return all(COMPARISONS[operator](left, right) for operator, left, right in pairs)


def named(name: str, scope: Scope) -> Value:
    """What a name alone is worth: to the robot whose expression it is, where every robot has its own."""
    if name in scope.local:
        return scope.local[name]
    if name in scope.definitions:
        return evaluate(scope.definitions[name].body, replace(scope, local={}))
    if name == "robot":
        return float(scope.robot)
    if name == "step":
        return float(scope.moment.step)
    if name in CONSTANTS:
        return CONSTANTS[name]
    if name in scope.choices:
        return name
    return scope.moment.value(name, scope.robot)


def indexed(expr: Index, scope: Scope) -> Value:
    """An element of a list; with one index more than there are lists, of what the robot has that the first names."""
    of, indices = taken_apart(expr)
    at = [evaluate(index, scope) for index in indices]
    value = evaluate(of, scope)
    if len(at) > depth(value):
        value = evaluate(of, replace(scope, robot=functions.clamp_index(at.pop(0), scope.robots - 1)))
    for index in at:
        value = value[functions.clamp_index(index, len(value) - 1)]
    return value


def taken_apart(expr: Expr) -> tuple[Expr, list[Expr]]:
    """What is indexed, and the indices from left to right."""
    if not isinstance(expr, Index):
        return expr, []
    of, indices = taken_apart(expr.of)
    return of, [*indices, expr.index]


def depth(value: Value) -> int:
    return 1 + depth(value[0]) if isinstance(value, list) else 0


def with_element(items: Value, at: list[Value], value: Value) -> Value:
    """A list in which the element at some indices, each brought into its range, is another one."""
    if not at:
        return value
    place = functions.clamp_index(at[0], len(items) - 1)
    return [*items[:place], with_element(items[place], at[1:], value), *items[place + 1 :]]


def called(call: Call, scope: Scope) -> Value:
    name, arguments = call.function, call.arguments
    if name == "before":
        return evaluate(arguments[0], replace(scope, moment=scope.moment.before or scope.moment))
    if arguments and isinstance(arguments[0], Generator):
        return generated(name, arguments[0], scope)
    values = [evaluate(argument, scope) for argument in arguments]
    if name in DRAWS:
        return scope.draw(call, scope.positions, values)
    if name in scope.definitions and scope.definitions[name].parameters:
        definition = scope.definitions[name]
        local = dict(zip(definition.parameters, values, strict=True))
        return evaluate(definition.body, replace(scope, local=local))
    if name == "clip":
        return functions.minimum(functions.maximum(values[0], values[1]), values[2])
    if name in FUNCTIONS:
        return function_named(FUNCTIONS[name].operation)(*values)
    return aggregate(name, values[0] if len(values) == 1 and isinstance(values[0], list) else values)


def function_named(operation: str) -> Callable[..., float]:
    return abs if operation == "abs" else getattr(functions, operation)


def generated(aggregate_name: str, each: Generator, scope: Scope) -> Value:
    """An aggregate of `element for names in source`."""
    items = source(each.source, scope)
    values = []
    for position, item in enumerate(items):
        bound = {each.names[0]: item} if len(each.names) == 1 else dict(zip(each.names, item, strict=True))
        inner = replace(scope, local={**scope.local, **bound}, positions=(*scope.positions, position))
        values.append(evaluate(each.element, inner))
    if aggregate_name in ("argmin", "argmax"):
        return items[best(values, BETTER[aggregate_name])]
    return aggregate(aggregate_name, values)


def source(expr: Expr, scope: Scope) -> list[Value]:
    """What a generator runs through."""
    match expr:
        case Name(name="team"):
            return [float(robot) for robot in range(scope.robots)]
        case Name(name="others"):
            return [float(robot) for robot in range(scope.robots) if robot != scope.robot]
        case Call(function="range", arguments=(count,)):
            return [float(number) for number in range(int(evaluate(count, scope)))]
    return list(evaluate(expr, scope))


def aggregate(name: str, values: list[Value]) -> Value:
    """An aggregate, folded from left to right."""
    match name:
        case "list":
            return values
        case "argmin" | "argmax":
            return float(best(values, BETTER[name]))
        case "mean":
            return functions.divide(reduce(add, values), float(len(values)))
    return reduce(FOLDS[name], values)


def best(values: list[Value], better: Callable[[Value, Value], bool]) -> int:
    """The place of the first best value."""
    place = 0
    for candidate, value in enumerate(values):
        if better(value, values[place]):
            place = candidate
    return place
