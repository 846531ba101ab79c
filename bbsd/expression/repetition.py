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
"""A function, where its value goes, and where its operands stand."""


def values_for(node: Node, numbers: Iterable[float]) -> Iterator[Any]:
    """The value of a node for each of the numbers that all of its leaves are; the same as `graph.evaluate` gives."""
    nodes = needed([node])
    place = {each.number: index for index, each in enumerate(nodes)}
    values = [value_of(each) if each.literal else None for each in nodes]
    leaves = [place[each.number] for each in nodes if each.operation in LEAVES]
    steps: list[Step] = [
        (_function(each), place[each.number], tuple(place[operand.number] for operand in each.operands))
        for each in nodes
        if each.operands and each.operation not in LEAVES
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


def _with_data(function: Callable[..., Any], data: object, *operands: object) -> Any:  # noqa: ANN401 - as `value_of`
    return function(*operands, data)
