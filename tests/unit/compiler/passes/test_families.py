"""Three robots, each with nodes of its own, and what a loop over robots computes for all of them."""

import pytest

from bbsd.compiler.passes.families import CircularError, Families
from bbsd.compiler.passes.robot_graph import RobotGraph
from bbsd.expression.graph import Graph, Level, value_of
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot

ROBOTS = range(3)


@pytest.fixture
def graph():
    return Graph()


def slot(graph, name, robot, kind=Kind.NUMBER):
    return graph.leaf("slot", Slot(name, robot), kind, Level.LANE)


def slots(graph, name):
    return [slot(graph, name, robot) for robot in ROBOTS]


def plus(graph, nodes, value):
    return [graph.apply("+", node, graph.number(value)) for node in nodes]


def shown(node):
    """A node on one line: a slot is its name, any other operation is called with its data and operands."""
    if node.literal:
        return str(value_of(node))
    if node.operation == "slot":
        return node.data[0]
    data = [] if node.data is None else [str(node.data)]
    return f"{node.operation}({', '.join([*data, *map(shown, node.operands)])})"


def each(nodes, *known, team_slots=()):
    families = Families(RobotGraph(3), frozenset(team_slots))
    families.register(known)
    return families.make_family(nodes)


def team(node, *known, team_slots=()):
    families = Families(RobotGraph(3), frozenset(team_slots))
    families.register(known)
    return families.make_team_value(node)


# --- Families


def test_robots_that_do_the_same_have_one_node(graph):
    made = each(plus(graph, slots(graph, "x"), 1))
    assert shown(made) == "+(x, 1.0)"
    assert made.level is Level.EACH


def test_what_all_robots_do_alike_is_the_team_s(graph):
    world = slot(graph, "wind", None)
    made = each(plus(graph, [world] * 3, 1))
    assert shown(made) == "+(wind, 1.0)"
    assert made.level is Level.LANE


def test_a_slot_that_all_robots_hold_alike_is_the_team_s(graph):
    made = each([slot(graph, "x", 0)] * 3, team_slots=[("x", ())])
    assert (shown(made), made.level) == ("x", Level.LANE)


def test_literals_that_differ_are_a_table(graph):
    made = each([graph.number(value) for value in (0.0, -0.0, 2.0)])
    assert made.operation == "table"
    assert [str(value) for value, _ in made.data] == ["0.0", "-0.0", "2.0"]
    assert made.level is Level.ROBOT


def test_truths_that_differ_are_a_table_of_truths(graph):
    made = each([graph.truth(value=robot == 0) for robot in ROBOTS])
    assert (made.operation, made.kind) == ("table", Kind.TRUTH)


def test_constants_that_differ_are_picked(graph):
    made = each([graph.leaf("constant", place, Kind.NUMBER, Level.CALL) for place in (4, 2, 4)])
    assert (shown(made), made.level) == ("pick((4, 2, 4))", Level.ROBOT)


def test_what_differs_only_from_robot_to_robot_is_computed_once_a_robot(graph):
    fixed = [graph.leaf("constant", robot, Kind.NUMBER, Level.CALL) for robot in ROBOTS]
    step = graph.leaf("step", None, Kind.NUMBER, Level.STEP)
    once = [graph.apply("*", each_one, step) for each_one in fixed]
    assert each(once).level is Level.ROBOT
    assert each([graph.apply("+", one, slot(graph, "wind", None)) for one in once]).level is Level.EACH


def test_draws_have_a_word_for_each_robot(graph):
    bounds = graph.number(0), graph.number(1)
    made = each([graph.draw("uniform", word, bounds) for word in (7, 8, 9)])
    assert (made.data, made.level) == (("uniform", (7, 8, 9)), Level.EACH)


def test_a_draw_keeps_its_kind(graph):
    made = each([graph.draw("chance", word, (graph.number(0.5),)) for word in (7, 8, 9)])
    assert made.kind is Kind.TRUTH


def test_different_distributions_have_nothing_in_common(graph):
    bounds = graph.number(0), graph.number(1)
    ways = ["uniform", "normal", "uniform"]
    made = each([graph.draw(way, word, bounds) for word, way in enumerate(ways)])
    assert made.operation == "each"
    assert [operand.data for operand in made.operands] == [("uniform", 0), ("normal", 1), ("uniform", 2)]


def test_elements_of_the_constants_have_a_base_for_each_robot(graph):
    xs = slots(graph, "x")
    made = each([graph.gather(base, (2,), (5,), (x,)) for base, x in zip((0, 10, 20), xs, strict=True)])
    assert (made.data, made.level) == (((0, 10, 20), (2,), (5,)), Level.EACH)
    alike = each([graph.gather(3, (2,), (5,), (x,)) for x in xs])
    assert alike.data == (3, (2,), (5,))
    step = graph.leaf("step", None, Kind.NUMBER, Level.STEP)
    assert each([graph.gather(base, (1,), (5,), (step,)) for base in (0, 5, 0)]).level is Level.ROBOT


def test_elements_of_different_tables_have_nothing_in_common(graph):
    made = each([graph.gather(0, (1,), (length,), (x,)) for length, x in enumerate(slots(graph, "x"), 2)])
    assert made.operation == "each"


def test_values_that_have_nothing_in_common_are_computed_one_by_one(graph):
    x0, x1, x2 = slots(graph, "x")
    made = each([x0, graph.apply("+", x1, graph.number(1)), graph.apply("*", x2, x0)])
    assert shown(made) == "each(of(0, x), +(of(1, x), 1.0), *(of(2, x), of(0, x)))"


def test_operations_of_the_same_name_with_other_data_differ(graph):
    powers = [graph.apply("whole_power", x, data=exponent) for exponent, x in enumerate(slots(graph, "x"), 2)]
    assert each(powers).operation == "each"
    assert (
        shown(each([graph.apply("whole_power", x, data=2) for x in slots(graph, "x")])) == "whole_power(2, x)"
    )


def test_numbers_and_truths_are_never_one_operation(graph):
    truths = [graph.apply("<", x, graph.number(1)) for x in slots(graph, "x")]
    numbers = [graph.number(value) for value in (1, 2)]
    chosen = [
        graph.apply("select", truths[0], *numbers),
        graph.apply("select", truths[1], truths[0], truths[2]),
        graph.apply("select", truths[2], *numbers),
    ]
    assert each(chosen).operation == "each"


# --- Other robots' values


def test_what_another_robot_holds_is_seen(graph):
    x0, x1, x2 = slots(graph, "x")
    assert shown(each([x1, x0, x0])) == "other((1, 0, 0), x)"
    assert shown(each([x2, x2, x1])) == "other((2, 2, 1), x)"


def test_slots_that_were_partly_merged_are_read_from_the_first(graph):
    x0, _, x2 = slots(graph, "x")
    assert shown(each([x0, x0, x2])) == "other((0, 0, 2), x)"


def test_what_another_robot_computes_is_computed_by_that_one_alone(graph):
    family = plus(graph, slots(graph, "x"), 1)
    seen = [family[robot] for robot in (1, 0, 0)]
    assert shown(each(seen, family)) == "other((1, 0, 0), +(x, 1.0))"
    assert shown(each(seen)) == "+(other((1, 0, 0), x), 1.0)"  # not a value that has a name


def test_others_of_others_are_seen_through_each_other(graph):
    x0, x1, x2 = slots(graph, "x")
    mates = [graph.apply("-", mine, theirs) for mine, theirs in ((x0, x1), (x1, x2), (x2, x0))]
    mates_mates = [graph.apply("*", mates[robot], mates[(robot + 1) % 3]) for robot in ROBOTS]
    gap = "-(x, other((1, 2, 0), x))"
    assert shown(each(mates_mates, mates)) == f"*({gap}, other((1, 2, 0), {gap}))"


def test_what_controls_another_robot_is_seen(graph):
    choices = [graph.leaf("choice", robot, Kind.CELL, Level.LANE) for robot in ROBOTS]
    assert shown(each(choices)) == "choice(0)"
    assert shown(each([choices[2], choices[2], choices[0]])) == "other((2, 2, 0), choice(0))"
    assert shown(team(choices[1])) == "of(1, choice(0))"


def test_another_robot_s_value_that_is_the_same_for_all_is_the_team_s(graph):
    wind = slot(graph, "wind", None)
    family = plus(graph, [wind] * 3, 1)
    assert shown(each([family[1], family[0], family[0]], family)) == "+(wind, 1.0)"


def test_another_robot_s_table_is_a_table(graph):
    one, step = graph.number(1), graph.leaf("step", None, Kind.NUMBER, Level.STEP)
    family = [graph.apply("*", step, graph.number(robot + 2)) for robot in ROBOTS]
    made = each([graph.apply("+", family[robot], one) for robot in (1, 0, 0)], family)
    assert made.level is Level.ROBOT
    assert [value for value, _ in made.operands[0].operands[1].data] == [3, 2, 2]


# --- Values of the team


def test_one_robot_s_value_is_read_from_its_family(graph):
    family = plus(graph, slots(graph, "x"), 1)
    assert shown(team(slot(graph, "x", 2))) == "of(2, x)"
    assert shown(team(family[1], family)) == "of(1, +(x, 1.0))"
    assert shown(team(family[1])) == "+(of(1, x), 1.0)"


def test_one_robot_s_table_is_a_literal(graph):
    family = [
        graph.apply("*", graph.leaf("step", None, Kind.NUMBER, Level.STEP), graph.number(k))
        for k in (2, 3, 4)
    ]
    assert shown(team(family[2], family)) == "*(step(), 4.0)"


@pytest.mark.parametrize("operation", ["+", "*", "minimum", "maximum"])
def test_a_fold_goes_over_the_family(graph, operation):
    made = team(graph.fold(operation, slots(graph, "x")))
    assert shown(made) == f"over({operation}, x)"
    assert (made.kind, made.level) == (Kind.NUMBER, Level.LANE)


@pytest.mark.parametrize("operation", ["&", "|"])
def test_a_fold_of_truths_is_a_truth(graph, operation):
    near = [graph.apply("<", x, graph.number(1)) for x in slots(graph, "x")]
    made = team(graph.fold(operation, near))
    assert (shown(made), made.kind) == (f"over({operation}, <(x, 1.0))", Kind.TRUTH)


def test_a_fold_is_from_the_first_to_the_last(graph):
    x0, x1, x2 = slots(graph, "x")
    assert shown(team(graph.fold("+", [x2, x1, x0]))) == "over(+, other((2, 1, 0), x))"
    later = graph.apply("+", x0, graph.apply("+", x1, x2))
    assert shown(team(later)) == "+(of(0, x), +(of(1, x), of(2, x)))"


def test_a_fold_of_some_robots_or_of_more_is_no_fold_of_the_team(graph):
    x0, x1, x2 = slots(graph, "x")
    assert "over" not in shown(team(graph.fold("+", [x0, x1])))
    more = graph.fold("+", [x0, x1, x2, slot(graph, "wind", None)])
    assert shown(team(more)) == "+(over(+, x), wind)"
    before = graph.fold("+", [slot(graph, "wind", None), x0, x1, x2])
    assert "over" not in shown(team(before))


def test_a_fold_of_what_has_nothing_in_common_is_no_fold(graph):
    x0, x1, x2 = (graph.apply("abs", x) for x in slots(graph, "x"))
    inner = [x0, graph.apply("abs", graph.apply("*", x1, x0)), x2]
    assert shown(team(graph.fold("+", inner))).startswith("over(+, abs(each(")
    mixed = graph.fold("+", [graph.apply("*", x0, x1), graph.apply("*", x0, x0), x2])
    assert "over" not in shown(team(mixed))


def test_a_fold_of_a_table_is_no_fold(graph):
    step = graph.leaf("step", None, Kind.NUMBER, Level.STEP)
    parts = [graph.apply("*", step, graph.number(robot + 2)) for robot in ROBOTS]
    assert shown(team(graph.fold("+", parts))) == "+(+(*(step(), 2.0), *(step(), 3.0)), *(step(), 4.0))"


# --- What does not do


def circular(graph):
    """Robot 0's value of b is a part of what robots 1 and 2 have as a, from which b is made."""
    x0, one = slot(graph, "x", 0), graph.number(1)
    follows = graph.apply("*", graph.apply("+", x0, one), graph.number(2))
    a = [x0, follows, follows]
    return [graph.apply("+", node, one) for node in a]


def test_families_that_need_one_another_are_told(graph):
    b = circular(graph)
    with pytest.raises(CircularError):
        each(b, b)
    assert each(b).operation == "+"


@pytest.mark.slow
def test_deep_families_are_made_without_recursion(graph):
    nodes = slots(graph, "x")
    for _ in range(20_000):
        nodes = [graph.apply("negate", node) for node in nodes]
    assert each(nodes).operation == "negate"


def test_what_was_made_is_known(graph):
    families = Families(RobotGraph(3), frozenset())
    family = plus(graph, slots(graph, "x"), 1)
    assert families.find_family(family) is None
    made = families.make_family(plus(graph, family, 2))
    assert families.find_family(family) is made.operands[0]
