import pytest

from bbsd.expression.graph import Graph, Level, evaluate
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.repetition import values_for


@pytest.fixture
def graph():
    return Graph()


def leaf(graph):
    return graph.leaf("slot", Slot("generation"), Kind.NUMBER, Level.CALL)


def expressions(graph):
    number = leaf(graph)
    near = graph.apply("<", number, graph.number(3))
    yield number
    yield graph.number(7)
    yield graph.apply("divide", graph.number(1), number)
    yield graph.apply("whole_power", number, data=3)
    yield graph.apply("select", near, graph.apply("negate", number), graph.apply("log2", number))
    yield graph.apply("select", graph.apply("not", near), number, graph.apply("*", number, number))
    yield graph.apply("clamp_index", number, data=2)


def test_values_are_those_of_one_evaluation_after_the_other(graph):
    numbers = [0.0, 1.0, 2.5, 4.0]
    for node in expressions(graph):
        one_by_one = [evaluate([node], lambda _node, _operands, n=n: n)[0] for n in numbers]
        assert list(values_for(node, numbers)) == one_by_one


def test_no_values_for_no_numbers(graph):
    assert list(values_for(leaf(graph), [])) == []
