"""The operations of graphs in one table: what each computes, what its value is, how kernels and the language write it.

Operators stand here; functions of the language come from `vocabulary`, so that a new one is one line there.
"""

from __future__ import annotations

import operator
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, NamedTuple

from bbsd.expression.kinds import Kind, Wholeness
from bbsd.expression.vocabulary import FUNCTIONS
from bbsd.kernel import functions

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping


class Operation(NamedTuple):
    """What an operation computes, and how it is written."""

    compute: Callable[..., Any]
    """The function of its operands' values, and of its node's data if it has any, that all kinds of code share."""
    kind: Kind | int = 0
    """The kind of its value, or the position of the operand that has the same kind."""
    wholeness: Wholeness = Wholeness.NEVER
    """When its value is a whole number."""
    word: str = ""
    """The operator or function by which the language writes it; empty where it has a form of its own, or none."""
    aggregate: str = ""
    """The aggregate that joins elements by it, if there is one."""
    binds: int | None = None
    """How tightly it binds where kernels write it between its operands; None where they call a function."""
    is_expensive: bool = False
    """Whether it takes so long that kernels give it a line, and perhaps a loop, of its own."""


def _comparison(word: str, compute: Callable[..., Any]) -> Operation:
    return Operation(compute, Kind.TRUTH, word=word, binds=1)


def _function(name: str) -> Operation:
    function = FUNCTIONS[name]
    compute = abs if function.operation == "abs" else getattr(functions, function.operation)
    return Operation(compute, wholeness=function.wholeness, word=name, is_expensive=function.is_expensive)


_LIKE_OPERANDS = Wholeness.LIKE_OPERANDS

OPERATIONS: Mapping[str, Operation] = MappingProxyType(
    {
        "|": Operation(operator.or_, Kind.TRUTH, word="or", aggregate="any", binds=2),
        "&": Operation(operator.and_, Kind.TRUTH, word="and", aggregate="all", binds=3),
        "not": Operation(operator.not_, Kind.TRUTH),
        "<": _comparison("<", operator.lt),
        "<=": _comparison("<=", operator.le),
        ">": _comparison(">", operator.gt),
        ">=": _comparison(">=", operator.ge),
        "==": _comparison("==", operator.eq),
        "!=": _comparison("!=", operator.ne),
        "+": Operation(operator.add, 0, _LIKE_OPERANDS, "+", aggregate="sum", binds=5),
        "-": Operation(operator.sub, 0, _LIKE_OPERANDS, "-", binds=5),
        "*": Operation(operator.mul, 0, _LIKE_OPERANDS, "*", binds=6),
        "negate": Operation(operator.neg, 0, _LIKE_OPERANDS),
        "divide": Operation(functions.divide, word="/"),
        "floor_divide": Operation(functions.floor_divide, 0, _LIKE_OPERANDS, "//"),
        "modulo": Operation(functions.modulo, 0, _LIKE_OPERANDS, "%"),
        "quick_modulo": Operation(functions.quick_modulo, 0, _LIKE_OPERANDS),
        "power": Operation(functions.power, word="**", is_expensive=True),
        "whole_power": Operation(functions.whole_power, 0, _LIKE_OPERANDS),
        "minimum": Operation(functions.minimum, 0, _LIKE_OPERANDS, "min", "min"),
        "maximum": Operation(functions.maximum, 0, _LIKE_OPERANDS, "max", "max"),
        "select": Operation(functions.select, 1, _LIKE_OPERANDS),
        "cell_of": Operation(functions.cell_of, Kind.CELL, Wholeness.ALWAYS),
        "clamp_index": Operation(functions.clamp_index, Kind.CELL, Wholeness.ALWAYS),
        "tangent_slack": Operation(functions.tangent_slack),
    }
    | {function.operation: _function(name) for name, function in FUNCTIONS.items() if function.operation}
)

BINDING: Mapping[str, int] = MappingProxyType(
    {name: operation.binds for name, operation in OPERATIONS.items() if operation.binds is not None}
)
"""How tightly those operations bind that kernels write between their operands; comparisons do least."""

EXPENSIVE = frozenset(name for name, operation in OPERATIONS.items() if operation.is_expensive)
"""Operations that kernels give a line, and perhaps a loop, of their own."""

BY_WORD: Mapping[str, str] = MappingProxyType(
    {operation.word: name for name, operation in OPERATIONS.items() if operation.word}
)
"""The operations that operators and functions of the language mean."""

BY_AGGREGATE: Mapping[str, str] = MappingProxyType(
    {operation.aggregate: name for name, operation in OPERATIONS.items() if operation.aggregate}
)
"""The operations by which aggregates join their elements."""

MIRRORED: Mapping[str, str] = MappingProxyType(
    {"<": ">", "<=": ">=", ">": "<", ">=": "<=", "==": "==", "!=": "!="}
)
"""For each comparison the one that says the same of exchanged operands."""

COMPARISONS = frozenset(MIRRORED)
