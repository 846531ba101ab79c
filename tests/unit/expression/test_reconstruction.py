import pytest

from bbsd.expression.elaboration import elaboration
from bbsd.expression.graph import Graph, Level, evaluate
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.reconstruction import reconstruct
from bbsd.expression.scope import Findings, Scope, Shared
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.text import render


def scope():
    graph = Graph()
    speed = graph.leaf("slot", Slot("speed"), Kind.NUMBER, Level.LANE)
    return Scope(graph, {"speed": Shared(speed)}, Findings())


@pytest.mark.parametrize(
    "text",
    [
        "1 + speed * 2 - speed / 3",
        "speed // 3 % 2 ** speed",
        "speed ** 2 - -speed",
        "max(speed, 1, sin(speed))",
        "min(atan2(speed, 2), round(speed), abs(speed))",
        "2 if speed < 1 and not 1 >= speed or speed != 0.5 else log10(speed)",
        "1 if true == (speed == 1) else 0",
    ],
)
def test_what_is_reconstructed_means_the_same_node(text):
    here = scope()
    node = elaboration.value(parse(text), here)
    again = elaboration.value(parse(render(reconstruct(node))), here)
    assert again is node


@pytest.mark.parametrize("value", [0.0, -0.0, 1.5, -2.0, 1e300])
def test_all_numbers_can_be_written(value):
    here = scope()
    again = elaboration.value(parse(render(reconstruct(here.graph.number(value)))), here)
    assert str(evaluate([again], lambda *_: None)[0]) == str(value)
