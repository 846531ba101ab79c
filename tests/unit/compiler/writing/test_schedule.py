"""Loops of the team are stages 0, 2, ..., loops over robots 1, 3, ..."""

import pytest

from bbsd.compiler.passes.robot_graph import RobotGraph
from bbsd.compiler.writing.blocks import Block, Blocks
from bbsd.compiler.writing.schedule import closing_of, first_stage_with, stages_of
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot

DECIDED = 3


@pytest.fixture
def robots():
    return RobotGraph(3)


def x(robots):
    return robots.graph.leaf("slot", Slot("x", 0), Kind.NUMBER, Level.EACH)


def wind(robots):
    return robots.graph.leaf("slot", Slot("wind"), Kind.NUMBER, Level.LANE)


def step(robots):
    return robots.graph.leaf("step", None, Kind.NUMBER, Level.STEP)


def stage_of(node):
    return stages_of([node], DECIDED)[node.number]


def test_without_loops_over_robots_all_is_in_one(robots):
    graph = robots.graph
    choice = graph.leaf("choice", 0, Kind.CELL, Level.LANE)
    value = graph.apply("*", graph.apply("+", wind(robots), step(robots)), graph.number(2))
    assert set(stages_of([value, choice], 0).values()) == {0}


def test_what_needs_only_slots_is_in_the_first_stage(robots):
    graph = robots.graph
    assert stage_of(graph.apply("+", wind(robots), graph.number(1))) == 0
    assert stage_of(graph.apply("+", x(robots), wind(robots))) == 1
    assert stage_of(robots.of(x(robots), 2)) == 0
    assert stage_of(robots.other(x(robots), (1, 0, 0))) == 1
    assert stage_of(robots.each([wind(robots), graph.number(1), graph.number(2)])) == 1


def test_what_is_computed_outside_lanes_is_there_from_the_start(robots):
    graph = robots.graph
    table = robots.varied("table", [graph.number(1), graph.number(2), graph.number(3)])
    assert stage_of(graph.apply("*", step(robots), graph.number(2))) == 0
    assert stage_of(graph.apply("*", step(robots), table)) == 0
    assert stage_of(graph.apply("*", x(robots), table)) == 1


def test_a_fold_is_known_to_the_team_after_the_loop_that_computes_it(robots):
    graph = robots.graph
    total = robots.over(x(robots), "+")
    assert stage_of(total) == 2
    gap = graph.apply("-", x(robots), total)
    assert stage_of(gap) == 3
    assert stage_of(robots.over(gap, "maximum")) == 4


def test_other_robots_values_are_known_when_all_robots_have_theirs(robots):
    graph = robots.graph
    double = graph.apply("*", x(robots), graph.number(2))
    assert stage_of(robots.of(double, 1)) == 2
    assert stage_of(robots.other(double, (1, 0, 0))) == 3
    assert stage_of(robots.other(robots.other(double, (1, 0, 0)), (1, 2, 0))) == 5


def test_what_follows_a_choice_is_in_its_stage_or_later(robots):
    graph = robots.graph
    acted = graph.apply(
        "select", graph.apply("==", robots.choice(), graph.cell(1)), graph.number(1), x(robots)
    )
    assert stage_of(robots.choice()) == DECIDED
    assert stage_of(acted) == DECIDED
    assert stage_of(robots.of(robots.choice(), 1)) == DECIDED + 1


def test_values_that_have_nothing_in_common_are_there_when_the_last_one_is(robots):
    total = robots.over(x(robots), "+")
    assert stage_of(robots.each([wind(robots), total, total])) == 3


def test_where_all_of_some_values_are_known(robots):
    graph = robots.graph
    total, nodes = robots.over(x(robots), "+"), [wind(robots), x(robots)]
    found = stages_of([total, *nodes], DECIDED)
    assert first_stage_with([], found, Level.LANE) == 0
    assert first_stage_with([], found, Level.EACH) == 1
    assert first_stage_with(nodes[:1], found, Level.LANE) == 0
    assert first_stage_with(nodes, found, Level.EACH) == 1
    assert first_stage_with([*nodes, total], found, Level.EACH) == 3
    assert first_stage_with([total, graph.number(1)], found, Level.LANE) == 2


def test_a_step_ends_where_all_is_known_and_then_stores(robots):
    blocks, gap = (
        Blocks(Block(Level.CALL), looped=True),
        robots.graph.apply("-", x(robots), robots.over(x(robots), "+")),
    )
    outputs = [gap, wind(robots)]
    end = closing_of(blocks, stages_of(outputs, DECIDED), outputs)
    assert [block.stage for block in (end.each, end.team, end.store_each, end.store_team)] == [3, 4, 5, 6]
    assert [block.level for block in (end.each, end.team)] == [Level.EACH, Level.LANE]
    assert end.knowing(own=True) is end.each
    assert end.knowing(own=False) is end.team
    assert end.storing(own=True) is end.store_each
    assert end.storing(own=False) is end.store_team


def test_without_loops_over_robots_a_step_ends_where_it_begins(robots):
    blocks = Blocks(Block(Level.CALL), looped=False)
    end = closing_of(blocks, stages_of([wind(robots)], 0), [wind(robots)])
    assert end.each is end.team is end.store_each is end.store_team is blocks.stage(0)


def among(robots, value):
    theirs = robots.theirs(value, others=True)
    following = robots.graph.apply("+", robots.so_far(0, Kind.NUMBER), theirs)
    return robots.among([(0, following, theirs)], others=True)


def test_a_loop_over_pairs_stands_before_the_lanes_of_a_stage_and_after_those_that_compute_what_it_reads(
    robots,
):
    graph = robots.graph
    seen = among(robots, x(robots))
    own = graph.apply("*", x(robots), x(robots))
    assert stage_of(seen) == 1
    assert stage_of(graph.apply("-", seen, own)) == 1
    assert stage_of(among(robots, own)) == 3
    assert stage_of(among(robots, robots.choice())) == DECIDED + 2
    assert stage_of(robots.over(seen, "minimum")) == 2
    assert stage_of(among(robots, seen)) == 3


def test_what_the_team_computes_is_there_for_pairs_in_the_next_stage(robots):
    graph = robots.graph
    total = graph.apply("*", robots.over(x(robots), "+"), wind(robots))
    far = graph.apply("*", robots.theirs(x(robots), others=False), total)
    assert stage_of(robots.among([(0, far, far)], others=False)) == stage_of(total) + 1 == 3
