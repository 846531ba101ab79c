import pytest

from bbsd.expression.graph import Graph, Level, Node
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.whole_numbers import whole_nodes


def slot(graph: Graph, name: str, kind: Kind = Kind.NUMBER) -> Node:
    return graph.leaf("slot", Slot(name), kind, Level.LANE)


@pytest.mark.parametrize(
    ("operation", "operands", "data", "whole"),
    [("+", "nn", None, True), ("+", "nx", None, False), ("divide", "nn", None, False), ("floor", "x", None, True),
     ("round_half_even", "x", None, True), ("negate", "n", None, True), ("minimum", "nn", None, True),
     ("whole_power", "n", 2, True), ("whole_power", "n", -1, False), ("sqrt", "n", None, False)],
)  # fmt: skip
def test_whole_numbers_are_inferred(operation: str, operands: str, data: int | None, whole: bool) -> None:
    graph = Graph()
    node = graph.apply(operation, *(slot(graph, name) for name in operands), data=data)
    assert whole_nodes([node], {Slot("n"): True, Slot("x"): False}, lambda _: False)[node.number] is whole
