import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.expression import graph as graphs
from bbsd.expression.graph import (
    Graph,
    GraphTooLargeError,
    Level,
    Node,
    compute,
    evaluate,
    needed,
    replace_leaves,
)
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot

FLOATS = st.floats(allow_nan=True)


def slot(graph: Graph, name: str, kind: Kind = Kind.NUMBER) -> Node:
    return graph.leaf("slot", Slot(name), kind, Level.LANE)


def test_equal_values_are_one_node() -> None:
    graph = Graph()
    x = slot(graph, "x")
    assert graph.apply("+", x, graph.number(1)) is graph.apply("+", x, graph.number(1))
    assert graph.number(0.0) is not graph.number(-0.0)
    assert graph.number(1) is not graph.truth(value=True)


def test_operands_come_before_what_is_made_of_them() -> None:
    graph = Graph()
    total = graph.fold("+", [slot(graph, name) for name in "abcd"])
    numbers = [node.number for node in needed([total])]
    assert numbers == sorted(numbers)
    assert all(operand.number < node.number for node in needed([total]) for operand in node.operands)


@given(
    st.sampled_from(["+", "-", "*", "divide", "modulo", "floor_divide", "minimum", "maximum", "power"]),
    FLOATS,
    FLOATS,
)
def test_literals_are_folded_with_the_kernels_own_operations(
    operation: str, left: float, right: float
) -> None:
    graph = Graph()
    folded = graph.apply(operation, graph.number(left), graph.number(right))
    assert folded.literal
    (found,) = evaluate([folded], lambda _node, _operands: None)
    expected = compute(operation, [left, right])
    assert found == expected or (math.isnan(found) and math.isnan(expected))


def test_choices_that_are_none_are_simplified() -> None:
    graph = Graph()
    x, ok = slot(graph, "x"), slot(graph, "ok", Kind.TRUTH)
    assert graph.apply("select", graph.truth(value=True), x, graph.number(1)) is x
    assert graph.apply("select", ok, x, x) is x
    assert graph.apply("&", ok, graph.truth(value=True)) is ok
    assert graph.apply("|", graph.truth(value=True), ok) is graph.truth(value=True)
    assert graph.apply("&", graph.truth(value=False), ok) is graph.truth(value=False)


def test_what_is_unknown_makes_all_unknown_that_uses_it() -> None:
    graph = Graph()
    assert graph.apply("+", graph.unknown, graph.number(1)) is graph.unknown
    assert graph.apply("&", graph.unknown, graph.truth(value=False)) is graph.unknown


def test_levels_are_the_highest_of_the_operands() -> None:
    graph = Graph()
    constant, step = (
        graph.leaf("constant", 0, Kind.NUMBER, Level.CALL),
        graph.leaf("step", None, Kind.NUMBER, Level.STEP),
    )
    assert graph.apply("+", constant, graph.number(1)).level is Level.CALL
    assert graph.apply("+", constant, step).level is Level.STEP
    assert graph.apply("+", slot(graph, "x"), step).level is Level.LANE


def test_rebuilding_replaces_leaves_and_folds_again() -> None:
    graph = Graph()
    node = graph.apply("*", graph.apply("+", slot(graph, "x"), graph.number(1)), graph.number(2))
    again = replace_leaves(node, graph, lambda _leaf, _operands: graph.number(4))
    assert again is graph.number(10)


def test_a_deep_graph_is_no_deep_recursion() -> None:
    graph = Graph()
    total = graph.fold("+", [slot(graph, str(place)) for place in range(5000)])
    assert evaluate([total], lambda _node, _operands: 1.0) == [5000.0]


def test_a_graph_has_a_largest_size(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(graphs, "MAX_NODES", 100)
    graph = Graph()
    with pytest.raises(GraphTooLargeError):
        graph.fold("+", [slot(graph, str(place)) for place in range(100)])


def test_a_graph_costs_only_so_much_work(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(graphs, "MAX_WORK", 100)
    graph = Graph()
    with pytest.raises(GraphTooLargeError):
        graph.fold("+", [graph.number(1)] * 100 + [graph.number(place) for place in range(100)])


def test_a_fork_begins_with_the_same_nodes_and_adds_none_to_the_first() -> None:
    graph = Graph()
    x = slot(graph, "x")
    fork = graph.fork()
    assert slot(fork, "x") is x
    before = dict(graph.nodes)
    aside = fork.apply("+", x, fork.number(1))
    assert graph.nodes == before
    later = graph.apply("*", x, graph.number(2))
    assert aside.number not in {node.number for node in needed([later])}
    assert needed([aside])[-1] is aside
