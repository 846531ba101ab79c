"""The syntax tree of expressions; each part has the span of text in which it is written."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Callable


class Span(NamedTuple):
    """Characters `start` to `start + length` of an expression's text."""

    start: int
    length: int


@dataclass(frozen=True, slots=True)
class Number:
    """A number as written."""

    value: float
    span: Span


@dataclass(frozen=True, slots=True)
class Truth:
    """`true` or `false`."""

    value: bool
    span: Span


@dataclass(frozen=True, slots=True)
class Name:
    """A name, to be looked up where the expression is used."""

    name: str
    span: Span


@dataclass(frozen=True, slots=True)
class Unary:
    """`-x`, `+x` or `not x`."""

    operator: str
    operand: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class Binary:
    """Two operands and one of `+ - * / // % **`."""

    operator: str
    left: Expr
    right: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class Comparison:
    """`a < b <= c`: one operator fewer than operands."""

    operators: tuple[str, ...]
    operands: tuple[Expr, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Logical:
    """Operands joined by `and` or by `or`."""

    operator: str
    operands: tuple[Expr, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Conditional:
    """`then if condition else otherwise`; both arms are evaluated."""

    condition: Expr
    then: Expr
    otherwise: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class Call:
    """A listed function, aggregate, draw or definition with its arguments."""

    function: str
    arguments: tuple[Expr, ...]
    span: Span


@dataclass(frozen=True, slots=True)
class Index:
    """`of[index]`."""

    of: Expr
    index: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class Generator:
    """`element for names in source`, the only argument of an aggregate."""

    element: Expr
    names: tuple[str, ...]
    source: Expr
    span: Span


@dataclass(frozen=True, slots=True)
class OneOf:
    """`one of [a, b]`, perhaps `starting` with an expression or `at random`: what a state can be, and at first is."""

    names: tuple[str, ...]
    start: Expr | None
    at_random: bool
    span: Span


Expr = (
    Number
    | Truth
    | Name
    | Unary
    | Binary
    | Comparison
    | Logical
    | Conditional
    | Call
    | Index
    | Generator
    | OneOf
)


def parts(expr: Expr) -> tuple[Expr, ...]:
    """Return the direct parts of an expression in the order in which they are written."""
    match expr:
        case Number() | Truth() | Name():
            return ()
        case Unary(operand=operand):
            return (operand,)
        case Binary(left=left, right=right):
            return (left, right)
        case Comparison(operands=operands) | Logical(operands=operands):
            return operands
        case Conditional(condition=condition, then=then, otherwise=otherwise):
            return (then, condition, otherwise)
        case Call(arguments=arguments):
            return arguments
        case Index(of=of, index=index):
            return (of, index)
        case Generator(element=element, source=source):
            return (element, source)
        case OneOf(start=start):
            return () if start is None else (start,)


def with_spans(expr: Expr, new: Callable[[Span], Span]) -> Expr:
    """Return an expression with every span of it replaced."""

    def renewed(part: Any) -> Any:  # noqa: ANN401 - a span, an expression, a tuple of them, or what is written
        match part:
            case Span():
                return new(part)
            case tuple():
                return tuple(map(renewed, part))
            case str() | bool() | float() | None:
                return part
        return with_spans(part, new)

    return replace(expr, **{field.name: renewed(getattr(expr, field.name)) for field in fields(expr)})


def names_used(expr: Expr, hidden: frozenset[str] = frozenset()) -> frozenset[str]:
    """Return all names in an expression that it does not bind itself, without those of functions."""
    match expr:
        case Name(name=name):
            return frozenset({name}) - hidden
        case Generator(element=element, names=names, source=source):
            return names_used(source, hidden) | names_used(element, hidden | frozenset(names))
        case _:
            return frozenset().union(*(names_used(part, hidden) for part in parts(expr)))


def functions_called(expr: Expr) -> frozenset[str]:
    """Return the names of all functions, aggregates, draws and definitions that an expression calls."""
    own = {expr.function} if isinstance(expr, Call) else ()
    return frozenset(own).union(*map(functions_called, parts(expr)))


def stack_depth(expr: Expr) -> int:
    """Return the most frames on Python's stack while an expression is elaborated, without those for its names."""
    match expr:
        case Number() | Truth() | Name():
            return 1
        case Call():
            own = 7
        case Logical():
            own = 4
        case Generator():
            own = 0
        case _:
            own = 3
    return own + max((stack_depth(part) for part in parts(expr)), default=0)
