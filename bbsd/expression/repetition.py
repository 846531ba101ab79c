"""One expression for many values of what it depends on, such as a rate for every generation."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Any

from bbsd.expression.graph import LEAVES, needed, value_of
from bbsd.expression.operations import OPERATIONS

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from bbsd.expression.graph import Node

Step = tuple[Callable[..., Any], int, tuple[int, ...]]
"""A function, the place of its value, and the places of its operands."""


def values_for(output: Node, numbers: Iterable[float]) -> Iterator[Any]:
    """Yield the value of an expression for each number, which all of its leaves have then, as `evaluate` would."""
    nodes = needed([output])
    places = {node.number: index for index, node in enumerate(nodes)}
    values = [value_of(node) if node.literal else None for node in nodes]
    leaves = [places[node.number] for node in nodes if node.operation in LEAVES]
    steps: list[Step] = [
        (_function(node), places[node.number], tuple(places[operand.number] for operand in node.operands))
        for node in nodes
        if node.operands and node.operation not in LEAVES
    ]
    for number in numbers:
        for leaf in leaves:
            values[leaf] = number
        for function, into, operands in steps:
            values[into] = function(*[values[operand] for operand in operands])
        yield values[-1]


def _function(node: Node) -> Callable[..., Any]:
    function = OPERATIONS[node.operation].compute
    return function if node.data is None else partial(_with_data, function, node.data)


def _with_data(function: Callable[..., Any], data: object, *operands: object) -> Any:  # noqa: ANN401 - a number or a truth
    return function(*operands, data)
