"""A scope with a little of everything, for the tests of expressions."""

from typing import Any

from bbsd.expression.elaboration import elaboration
from bbsd.expression.graph import Graph, Level, Node, evaluate
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.scope import Definition, Findings, PerRobot, Scope, Shared, Unusable, Value
from bbsd.expression.syntax.mistakes import Mistake
from bbsd.expression.syntax.parsing import parse

VALUES = {"x": (1.5, -2.0, 4.0), "ok": (True, False, True), "k": (0.0, 1.0, 2.0)}
"""State of three robots."""


def scope(robot: int | None = 0, *, draws: bool = False) -> Scope:
    graph = Graph()
    kinds = {"x": Kind.NUMBER, "ok": Kind.TRUTH, "k": Kind.NUMBER}

    def stored(name: str, robot: int) -> Node:
        return graph.leaf("slot", Slot(name, robot), kinds[name], Level.LANE)

    def sonar(robot: int) -> Value:
        return tuple(
            graph.leaf("slot", Slot("sonar", robot, (place,)), Kind.NUMBER, Level.LANE) for place in range(4)
        )

    names = {
        "x": PerRobot(lambda robot: stored("x", robot)),
        "ok": PerRobot(lambda robot: stored("ok", robot)),
        "k": PerRobot(lambda robot: stored("k", robot)),
        "sonar": PerRobot(sonar),
        "robot": PerRobot(graph.number),
        "goal": Shared(graph.number(3)),
        "table": Shared(((graph.number(1), graph.number(2)), (graph.number(3), graph.number(4)))),
        "twice": Definition(("v",), parse("2 * v"), ("definitions", "twice(v)")),
        "double": Definition((), parse("twice(x)"), ("definitions", "double")),
        "hidden": Unusable(),
        "early": Unusable("BB066", "early is not known yet"),
    }
    return Scope(graph, names, Findings(), robots=3).at(("here",), robot, draws=draws)


def value_at(node: Node) -> Any:
    def leaf(node: Node, _operands: list[Any]) -> Any:
        name, robot, place = node.slot
        return 10.0 * robot + place[0] if name == "sonar" else VALUES[name][robot]

    return evaluate([node], leaf)[0]


def valued(text: str, robot: int | None = 0) -> Any:
    """What an expression is for a robot; there must be no mistake in it."""
    here = scope(robot)
    found = elaboration.value(parse(text), here)
    assert not here.findings.mistakes
    return _plain(found)


def _plain(found: Value) -> Any:
    return [_plain(item) for item in found] if isinstance(found, tuple) else value_at(found)


def mistakes(text: str, robot: int | None = 0) -> list[Mistake]:
    """What is wrong with an expression."""
    here = scope(robot)
    elaboration.value(parse(text), here)
    return [mistake for _, mistake in here.findings.mistakes]


def marked(text: str, robot: int | None = 0) -> list[tuple[str, str]]:
    """The codes of the mistakes in an expression and the parts of its text that they are about."""
    return [
        (mistake.code, text[mistake.span.start : mistake.span.start + mistake.span.length])
        for mistake in mistakes(text, robot)
    ]
