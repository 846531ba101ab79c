"""What each robot folds over those that it looks at becomes one node, or stays written out."""

import pytest

from bbsd.compiler.passes import folds
from bbsd.compiler.passes.families import Families
from bbsd.compiler.passes.robot_graph import RobotGraph
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind
from tests.unit.compiler.passes.test_families import shown
from tests.unit.compiler.passes.test_pairs import ROBOTS, best, distance, graph, sums, x

__all__ = ["graph"]


@pytest.fixture(autouse=True)
def few(monkeypatch):
    monkeypatch.setattr(folds, "MOST_PAIRS_WRITTEN_OUT", 2)


def each(nodes, *known):
    families = Families(RobotGraph(len(nodes)), frozenset())
    families.register(known)
    return families.make_family(nodes)


def test_a_sum_over_the_others_is_folded_in_a_loop(graph):
    made = each(sums(graph, lambda i, j: distance(graph, i, j)))
    assert (made.operation, made.data, made.level) == ("among", (True, (0,)), Level.EACH)
    term = "-(theirs(True, x), x)"
    assert [shown(node) for node in made.operands] == [f"+(so_far(0), {term})", term]


def test_a_fold_over_the_team_is_one_too(graph):
    nodes = [graph.fold("minimum", [distance(graph, i, j) for j in ROBOTS]) for i in ROBOTS]
    made = each(nodes)
    assert (made.operation, made.data[0]) == ("among", False)


def test_an_argmin_shares_the_loop_of_the_least_value(graph):
    made = each(best(graph, lambda i, j: distance(graph, i, j), graph.number))
    assert made.data == (True, (0, 1))
    chosen, label, least, value = made.operands
    distances = "-(theirs(True, x), x)"
    better = f"<({distances}, so_far(1))"
    assert shown(value) == distances
    assert shown(least) == f"select({better}, {distances}, so_far(1))"
    assert shown(chosen) == f"select({better}, {shown(label)}, so_far(0))"
    assert label.operands[0].data == tuple((float(robot), str(float(robot))) for robot in ROBOTS)


def test_a_value_of_the_robot_looked_at_is_read_where_that_robot_computes_it(graph):
    doubled = [graph.apply("*", x(graph, robot), graph.number(2)) for robot in ROBOTS]
    nodes = sums(graph, lambda i, j: graph.apply("*", doubled[j], x(graph, i)))
    _, term = each(nodes).operands
    assert shown(term) == "*(theirs(True, *(x, 2.0)), x)"


def test_what_is_folded_of_the_robot_alone_is_not_a_loop(graph):
    nodes = [graph.fold("+", [x(graph, i, name) for name in "abc"]) for i in ROBOTS]
    assert each(nodes).operation == "+"


@pytest.mark.parametrize("odd", [(0, 3), (3, 0), (2, 3)])
def test_one_pair_that_does_otherwise_has_all_written_out(graph, odd):
    nodes = sums(graph, lambda i, j: distance(graph, *((j, i) if (i, j) == odd else (i, j))))
    assert each(nodes).operation != "among"


def test_draws_for_each_pair_are_written_out(graph):
    nodes = sums(graph, lambda i, j: graph.draw("normal", 10 * i + j, (x(graph, i), x(graph, j))))
    assert each(nodes).operation == "+"


def test_few_are_written_out(graph, monkeypatch):
    monkeypatch.setattr(folds, "MOST_PAIRS_WRITTEN_OUT", 4)
    assert each(sums(graph, lambda i, j: distance(graph, i, j))).operation == "+"


def test_two_folds_of_the_same_are_one(graph):
    nodes = sums(graph, lambda i, j: distance(graph, i, j))
    families = Families(RobotGraph(len(nodes)), frozenset())
    assert families.make_family(nodes) is families.make_family(list(nodes))
    half = [graph.apply("*", node, graph.leaf("step", None, Kind.NUMBER, Level.STEP)) for node in nodes]
    assert families.make_family(half).operands[0] is families.make_family(nodes)
