import numpy as np
import pytest

from bbsd.expression.graph import Graph, Level
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Draw, Gather, RobotDraws, Slot


@pytest.mark.parametrize(
    ("slot", "robots", "text"),
    [
        (("height", 0, ()), 3, "height_0"),
        (("height", 0, ()), 1, "height"),
        (("wind", None, ()), 3, "wind"),
        (("sonar", 1, (4,)), 2, "sonar_1_4"),
        (("sonar", 0, (4, 0)), 1, "sonar_4_0"),
    ],
)
def test_slots_are_called_by_name_robot_and_place(slot, robots, text):
    assert Slot(*slot).text(robots) == text


def test_slots_of_all_robots_are_one_variable():
    assert {Slot("sonar", robot, (4,)).variable for robot in (0, 1, None)} == {("sonar", (4,))}


def test_nodes_with_equal_fields_of_other_types_are_different():
    graph, fields = Graph(), ("normal", 3)
    slot, draw = Slot(*fields), Draw(*fields)
    read = graph.leaf("slot", slot, Kind.NUMBER, Level.LANE)
    drawn = graph.draw(*fields, ())
    assert tuple(slot)[:2] == tuple(draw)
    assert read is not drawn
    assert (read.slot, drawn.draw) == (slot, draw)
    assert graph.leaf("slot", Slot(*fields), Kind.NUMBER, Level.LANE) is read
    assert graph.draw(*fields, ()) is drawn
    with pytest.raises(TypeError, match="the data of draw are no Slot"):
        _ = drawn.slot
    with pytest.raises(TypeError, match="the data of slot are no Draw"):
        _ = read.draw


def test_an_element_of_the_constants_is_clamped_in_each_dimension():
    constants = np.arange(100).tolist()
    gather = Gather(10, (5, 1), (3, 5))
    assert gather.places == [*range(10, 25)]
    assert [gather.read(constants, at) for at in ((0, 0), (2, 4), (1, 3))] == [10, 24, 18]
    assert [gather.read(constants, at) for at in ((-1, 9), (7, -7), (np.nan, np.inf))] == [14, 20, 14]


def test_kernels_have_words_with_the_top_bit():
    assert Draw("normal", 5).kernel_word == 5 + 2**63
    assert Draw("normal", 5 + 2**63).kernel_word == 5 + 2**63
    assert RobotDraws("normal", (5, 6)).kernel_words == (5 + 2**63, 6 + 2**63)
