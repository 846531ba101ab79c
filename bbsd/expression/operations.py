"""What each operation of a graph does to numbers: the meaning that folding, plain and compiled code share."""

from __future__ import annotations

import operator
from types import MappingProxyType
from typing import TYPE_CHECKING, Any

from bbsd.expression.vocabulary import FUNCTIONS
from bbsd.kernel import functions

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

INFIX: Mapping[str, Callable[[Any, Any], Any]] = MappingProxyType(
    {
        "+": operator.add,
        "-": operator.sub,
        "*": operator.mul,
        "<": operator.lt,
        "<=": operator.le,
        ">": operator.gt,
        ">=": operator.ge,
        "==": operator.eq,
        "!=": operator.ne,
        "&": operator.and_,
        "|": operator.or_,
    }
)
"""Operations that the kernel's source writes between their operands."""

CALLED: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {
        function.operation: getattr(functions, function.operation)
        for function in FUNCTIONS.values()
        if function.operation != "abs"
    }
    | {
        "abs": abs,
        "divide": functions.divide,
        "floor_divide": functions.floor_divide,
        "modulo": functions.modulo,
        "power": functions.power,
        "whole_power": functions.whole_power,
        "minimum": functions.minimum,
        "maximum": functions.maximum,
        "tangent_slack": functions.tangent_slack,
        "select": functions.select,
        "cell_of": functions.cell_of,
        "clamp_index": functions.clamp_index,
    }
)
"""Operations that the kernel's source writes as calls."""

COMPARISONS = frozenset({"<", "<=", ">", ">=", "==", "!="})
