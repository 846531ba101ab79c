import pytest

from bbsd.compiler.passes.robot_graph import RobotGraph
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot


@pytest.fixture
def robots():
    return RobotGraph(3)


def slot(robots, name, robot):
    return robots.graph.leaf("slot", Slot(name, robot, (1,)), Kind.NUMBER, Level.LANE)


def test_slots_stand_for_all_robots_or_for_the_world(robots):
    own = robots.slot(slot(robots, "x", 2), Level.EACH)
    assert (own.data, own.level) == (("x", 0, (1,)), Level.EACH)
    world = robots.slot(slot(robots, "wind", None), Level.LANE)
    assert (world.data, world.level) == (("wind", None, (1,)), Level.LANE)


def test_each_robot_s_own_value_is_the_family(robots):
    family = robots.choice()
    assert robots.other(family, [0, 1, 2]) is family
    assert robots.other(family, [1, 0, 0]).data == (1, 0, 0)


def test_the_same_is_the_same_node(robots):
    family = robots.choice()
    assert robots.of(family, 1) is robots.of(family, 1)
    assert robots.over(family, "maximum") is not robots.over(family, "minimum")


def test_a_draw_of_the_team_has_one_word(robots):
    graph = robots.graph
    drawn = graph.draw("normal", 5, (graph.number(0), graph.number(1)))
    again = robots.copy([drawn], drawn.operands)
    assert (again.data, again.level) == (("normal", 5), Level.LANE)


def test_literals_and_leaves_are_made_again_as_they_are(robots):
    graph = robots.graph
    for node in (
        graph.number(-0.0),
        graph.truth(value=True),
        graph.leaf("constant", 3, Kind.NUMBER, Level.CALL),
    ):
        assert robots.copy([node], []) is node
