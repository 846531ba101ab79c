"""One robot that decides in plain Python, value by value as its C does: what the C is held against."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi
from typing import TYPE_CHECKING, Any

from bbsd.architecture.controller import command
from bbsd.architecture.needs import ACTED
from bbsd.expression.graph import evaluate, needed
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot, Variable
from bbsd.kernel.functions import cos, floor, log, maximum, minimum, sqrt
from bbsd.kernel.streams import GOLDEN, fold, mix64, unit, word_of

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from bbsd.architecture.controller import Controller
    from bbsd.architecture.needs import Needs, RobotNeeds
    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Draw

Stored = dict[Slot, Any]


def random_number(draw: Draw, key: int, step: int) -> float:
    """Return the standard random number of which a draw of an episode is made: uniform in [0, 1), or normal."""
    bits = fold(key, fold(draw.kernel_word, word_of(step)))
    if draw.distribution == "normal":
        return sqrt(-2.0 * log(1.0 - unit(bits))) * cos(2.0 * pi * unit(mix64(bits ^ GOLDEN)))
    return unit(bits)


def drawn(distribution: str, random: float, operands: Sequence[float]) -> float | bool:
    """Return a draw, made of a standard random number as `bbsd.kernel.streams` makes it."""
    match distribution, [*operands]:
        case "chance", [probability]:
            return random < probability
        case "normal", [mean, sd]:
            return mean + sd * random
        case "uniform", [low, high]:
            return low + (high - low) * random
    first, last = operands
    span = maximum(last - first + 1.0, 1.0)
    return first + minimum(floor(random * span), span - 1.0)


@dataclass(frozen=True, slots=True)
class Situation:
    """All on which a step of a robot depends: what it is given, what it keeps, the step, its random numbers."""

    robot: int
    given: Stored
    kept: Stored
    step: int
    random: Mapping[Draw, float]


@dataclass(frozen=True, slots=True)
class Answer:
    """What a robot does: the action's number, what state that actions set is then, and what it keeps."""

    action: int
    set_values: dict[Variable, Any]
    kept: Stored


@dataclass(frozen=True, slots=True)
class Player:
    """A robot of a team, in plain Python."""

    controller: Controller
    needs: Needs
    constants: Sequence[float]

    def start(self, robot: int) -> Stored:
        """Return what a robot keeps before the first step."""
        start = self.needs.robots[robot].start
        empty = dict.fromkeys(self.needs.robots[robot].next, 0.0)
        values = self.values(start.values(), Situation(robot, {}, {}, 0, {}))
        return {**empty, **dict(zip(start, values, strict=True))}

    def draws_of(self, robot: int) -> list[Draw]:
        """Return the draws of a robot's assignments."""
        nodes = [node for sets in self.needs.robots[robot].sets.values() for node in sets.values()]
        return [node.draw for node in needed(nodes) if node.operation == "draw"]

    def answer(self, situation: Situation) -> Answer:
        """Return what a robot does in a situation."""
        own = self.needs.robots[situation.robot]
        cells = [0] * len(self.controller.dimensions)
        values = self.values(own.cells.values(), situation)
        for axis, value in zip(own.cells, values, strict=True):
            cells[axis] = int(value)
        action = command(self.controller, cells)
        acted = dict(zip(own.held, self.values(own.held.values(), situation), strict=True))
        sets = own.sets.get(action, {})
        acted |= dict(zip(sets, self.values(sets.values(), situation), strict=True))
        return Answer(action, acted, self._kept(own, situation, acted, action))

    def _kept(self, own: RobotNeeds, situation: Situation, acted: dict[Variable, Any], action: int) -> Stored:
        later = {
            Slot(f"{ACTED}{name}", situation.robot, place): value for (name, place), value in acted.items()
        }
        after = replace(situation, given=situation.given | later)
        return dict(zip(own.next, self.values(own.next.values(), after, action), strict=True))

    def literal(self, node: Node) -> float:
        """Return the value of a literal or a constant."""
        return float(self.values([node], Situation(0, {}, {}, 0, {}))[0])

    def values(self, nodes: Iterable[Node], situation: Situation, action: int | None = None) -> list[Any]:
        """Return the values of nodes in a situation."""

        def leaf(node: Node, operands: list[Any]) -> Any:  # noqa: ANN401 - a number or a truth
            match node.operation:
                case "slot":
                    value = situation.kept.get(node.slot, situation.given.get(node.slot))
                    return bool(value) if node.kind is Kind.TRUTH else value
                case "step":
                    return float(situation.step)
                case "choice":
                    return action
                case "draw":
                    return drawn(node.draw.distribution, situation.random[node.draw], operands)
            return node.read(self.constants, operands)

        return evaluate(nodes, leaf)
