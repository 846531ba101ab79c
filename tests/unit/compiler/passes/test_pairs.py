"""Folds over pairs of robots, told from what only looks like them."""

import pytest

from bbsd.compiler.passes.pairs import (
    Chain,
    Pairs,
    chain_before,
    chain_to,
    nodes_of_pairs,
    previous_link,
    robot_of_slot,
)
from bbsd.expression.graph import Graph, Level
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot

ROBOTS = range(5)


@pytest.fixture
def graph():
    return Graph()


def x(graph, robot, name="x"):
    return graph.leaf("slot", Slot(name, robot), Kind.NUMBER, Level.LANE)


def of_others(make):
    """A row for each robot, a column for each of the others."""
    return Pairs(tuple(tuple(make(i, j) for j in ROBOTS if j != i) for i in ROBOTS), others=True)


def of_team(make):
    return Pairs(tuple(tuple(make(i, j) for j in ROBOTS) for i in ROBOTS), others=False)


def distance(graph, one, other):
    return graph.apply("-", x(graph, other), x(graph, one))


def sums(graph, term):
    """For each robot the sum of its terms with the others."""
    return [graph.fold("+", [term(i, j) for j in ROBOTS if j != i]) for i in ROBOTS]


def best(graph, value, label):
    """For each robot what an argmin over the others makes: the last choice of a label, and of a value but the last."""
    found = []
    for i in ROBOTS:
        first, *others = [j for j in ROBOTS if j != i]
        least, chosen = value(i, first), label(first)
        for j in others:
            better = graph.apply("<", value(i, j), least)
            least, chosen = (
                graph.apply("select", better, value(i, j), least),
                graph.apply("select", better, label(j), chosen),
            )
        found.append(chosen)
    return found


# --- Pairs


def test_what_a_robot_has_whomever_it_looks_at_is_its_own(graph):
    assert of_others(lambda i, _: x(graph, i)).own() == [x(graph, robot) for robot in ROBOTS]
    assert of_others(lambda _, j: x(graph, j)).own() is None
    assert of_others(lambda i, j: x(graph, 0 if (i, j) == (2, 1) else i)).own() is None


def test_what_the_one_looked_at_has_is_theirs(graph):
    assert of_others(lambda _, j: x(graph, j)).are_theirs(robot_of_slot(("x", ())))
    assert of_team(lambda _, j: x(graph, j)).are_theirs(robot_of_slot(("x", ())))
    assert not of_others(lambda _, j: x(graph, j, "y")).are_theirs(robot_of_slot(("x", ())))
    assert not of_others(lambda i, _: x(graph, i)).are_theirs(robot_of_slot(("x", ())))
    assert not of_others(lambda _, j: graph.number(j)).are_theirs(robot_of_slot(("x", ())))


def test_what_is_the_same_whoever_looks_is_known_by_robot(graph):
    assert of_others(lambda _, j: x(graph, j)).by_robot() == [x(graph, robot) for robot in ROBOTS]
    assert of_others(lambda i, j: graph.number(i + j)).by_robot() is None


def test_of_a_robot_that_nobody_looks_at_any_literal_will_do_but_no_other_value(graph):
    of = of_others(lambda _, j: graph.apply("-", x(graph, j), graph.number(j)))
    rest = Pairs(tuple(row[1:] for row in of.rows), others=True, first=1)
    assert rest.by_robot() is None
    assert rest.operand(1).by_robot() == [graph.number(robot) for robot in (2, 1, 2, 3, 4)]


def test_pairs_are_alike_as_one_operation_on_operands(graph):
    of = of_others(lambda i, j: distance(graph, i, j))
    assert of.are_alike()
    assert of.operand(0) == of_others(lambda _, j: x(graph, j))
    assert not of_others(lambda _, j: x(graph, j)).are_alike()
    assert not of_others(lambda i, j: graph.apply("+" if j else "-", x(graph, j), x(graph, i))).are_alike()


# --- Chains


def test_a_sum_over_the_others_is_a_chain_of_its_terms(graph):
    chain = chain_to(sums(graph, lambda i, j: distance(graph, i, j)), 4, others=True)
    assert chain.operation == "+"
    assert chain.terms == of_others(lambda i, j: distance(graph, i, j))
    assert chain.conditions is None


def test_what_is_no_chain_of_so_many_links_is_none(graph):
    assert chain_to(sums(graph, lambda i, j: distance(graph, i, j)), 5, others=False) is None
    assert chain_to([x(graph, robot) for robot in ROBOTS], 4, others=True) is None


def test_an_argmin_is_a_chain_of_choices_that_needs_another_one(graph):
    chosen = best(graph, lambda i, j: distance(graph, i, j), graph.number)
    chain = chain_to(chosen, 4, others=True)
    assert chain.terms == of_others(lambda _, j: graph.number(j))
    assert chain.conditions.first == 1
    before = chain.conditions.operand(1)
    least = chain_before(before)
    assert least.links.rows == before.rows
    assert least.terms.rows == tuple(row[:3] for row in of_others(lambda i, j: distance(graph, i, j)).rows)


def test_what_comes_before_is_a_chain_only_link_by_link(graph):
    chosen = best(graph, lambda i, j: distance(graph, i, j), graph.number)
    before = chain_to(chosen, 4, others=True).conditions.operand(1)
    (first, second, *more), *rest = before.rows
    assert chain_before(Pairs(((second, first, *more), *rest), others=True, first=1)) is None
    assert chain_before(Pairs(before.rows, others=True, first=0)) is None
    assert previous_link(second, "select") is first
    assert previous_link(second, "+") is None


def test_the_beginning_of_a_chain_begins_it(graph):
    links = chain_to(sums(graph, lambda i, j: distance(graph, i, j)), 4, others=True).links
    whole, begun = Chain(links), Chain(Pairs(tuple(row[:2] for row in links.rows), others=True))
    assert whole.begins(begun)
    assert not begun.begins(whole)
    assert not whole.begins(Chain(Pairs(links.rows, others=False)))


def test_a_loop_over_pairs_computes_only_what_changes_with_the_pair(graph):
    theirs = graph.make("theirs", (x(graph, 0),), True, Kind.NUMBER, Level.PAIR)
    own = graph.apply("+", x(graph, 0), graph.number(1))
    assert {node.operation for node in nodes_of_pairs([graph.apply("*", theirs, own), own])} == {
        "*",
        "theirs",
    }
