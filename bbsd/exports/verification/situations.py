"""Situations of robots for which a header with sensing is compared: recorded, at the edges of cells, drawn, odd."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass, replace
from itertools import pairwise
from math import inf, nan
from struct import Struct
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.compiler import compile_meaning
from bbsd.evaluation.tracing.recording import record_episode
from bbsd.exports.sensing.playing import Situation, random_number
from bbsd.expression.graph import needed
from bbsd.expression.kinds import Kind
from bbsd.expression.operations import COMPARISONS
from bbsd.kernel.streams import fold, name_word

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.exports.exported import Exported
    from bbsd.exports.sensing.playing import Answer, Player
    from bbsd.exports.sensing.values import Scalar
    from bbsd.exports.verification.sensing import Driver
    from bbsd.expression.graph import Node
    from bbsd.expression.node_data import Slot

ODD = (nan, inf, -inf, 0.0, -0.0, 1e308, -1e308, 5e-324, 2.0**31, -(2.0**63), 1e19)
"""Numbers that a robot should not meet, one at a time."""
BASES = 8
"""Situations from which edges are looked for."""
EDGES = 12
"""Edges of a comparison after which no more are looked for."""
IDLE = 0.2
"""What an edge counts at which another cell leads to the same action."""
EDGES_BETWEEN = 6
"""Edges between two numbers that are looked for."""
MOST_EVALUATIONS = 15_000
"""Situations in which the comparisons of a robot are looked at."""
DRAWN = 500
"""Situations that are drawn."""


@dataclass(frozen=True, slots=True)
class Step:
    """A situation and what the design does in it; `is_first` of an episode, and of a robot."""

    situation: Situation
    answer: Answer
    is_first: bool


def recorded_steps(exported: Exported, driver: Driver, episodes: int) -> Iterator[Step]:
    """Yield the steps of each robot in recorded episodes; answers have the actions that were recorded."""
    player, meaning = driver.sensing.player, exported.meaning
    problem = compile_meaning(meaning, compiled=False)
    generation = meaning.spec.design.coevolution.generations
    stream = name_word(f"verify {exported.controller.name}")
    for episode in range(episodes):
        key = fold(stream, episode)
        recording = record_episode(problem, exported.architecture, key, generation)
        for robot in range(len(player.needs.robots)):
            kept, draws = player.start(robot), player.draws_of(robot)
            for step, stored in enumerate(recording.stored, 1):
                given = {slot: stored[slot] for each in driver.inputs for slot in [each.of(robot)]}
                random = {draw: random_number(draw, key, step) for draw in draws}
                situation = Situation(robot, given, kept, step, random)
                answer = player.answer(situation)
                action = int(recording.choices[step - 1, robot])
                yield Step(situation, replace(answer, action=action), is_first=step == 1)
                kept = answer.kept


def other_steps(driver: Driver, recorded: Sequence[Step], name: str) -> list[Step]:
    """Return steps at the edges of cells, with odd numbers, and drawn ones."""
    rng = np.random.default_rng(name_word(f"situations {name}"))
    drawn = [_drawn(driver, rng) for _ in range(DRAWN)]
    bases = [step.situation for step in recorded[:: max(1, len(recorded) // BASES)]] or drawn[:BASES]
    found = [*_edges(driver, bases), *_odd(driver, bases), *drawn]
    player = driver.sensing.player
    return [Step(situation, player.answer(situation), is_first=False) for situation in found]


def _drawn(driver: Driver, rng: np.random.Generator) -> Situation:
    """Return a situation with numbers of all sizes, whole and not."""
    robot = int(rng.integers(len(driver.sensing.player.needs.robots)))
    given = {each.of(robot): _value(driver, each, rng) for each in driver.inputs}
    kept = {each.of(robot): _value(driver, each, rng) for each in driver.memory}
    random = {draw: float(rng.random()) for draw in driver.sensing.player.draws_of(robot)}
    return Situation(robot, given, kept, int(rng.integers(1, 100)), random)


def _value(driver: Driver, scalar: Scalar, rng: np.random.Generator) -> Any:  # noqa: ANN401 - a number, truth or cell
    if scalar.kind is Kind.TRUTH:
        return bool(rng.integers(2))
    if scalar.kind is Kind.CELL:
        return int(rng.integers(driver.sensing.program.n_cells(scalar.slot.name)))
    number = float(rng.normal() * 10.0 ** rng.integers(-2, 3))
    return float(round(number)) if rng.random() < 0.5 else number


def _odd(driver: Driver, bases: Sequence[Situation]) -> Iterator[Situation]:
    """Yield situations in which one number is odd."""
    for each in (*driver.inputs, *driver.memory):
        if each.kind is Kind.NUMBER:
            yield from (_with(bases[0], each, number) for number in ODD)


def _with(situation: Situation, scalar: Scalar, value: Any) -> Situation:  # noqa: ANN401
    slot = scalar.of(situation.robot)
    if slot in situation.given:
        return replace(situation, given={**situation.given, slot: value})
    return replace(situation, kept={**situation.kept, slot: value})


# --- Edges


def _edges(driver: Driver, bases: Sequence[Situation]) -> Iterator[Situation]:
    """Yield situations on both sides of where a comparison changes as one number does, and the numbers next to them."""
    tells = {robot: _Tells(driver.sensing.player, robot) for robot in {base.robot for base in bases}}
    for base in bases:
        own = tells[base.robot]
        for each in (*driver.inputs, *driver.memory):
            if each.kind is Kind.NUMBER:
                for low, high in pairwise(_places(each, base, bases, own)):
                    for edge in own.edges(base, each, low, high):
                        for place in range(edge - 1, edge + 3):
                            yield _with(base, each, _number_at(place))


def _places(scalar: Scalar, base: Situation, bases: Sequence[Situation], tells: _Tells) -> list[float]:
    """Return values of a number between which an edge may lie, from the least to the greatest."""
    seen = [_read(other, scalar.of(other.robot)) for other in bases]
    own = _read(base, scalar.of(base.robot))
    numbers = {own, own - 1.0, own + 1.0, -1e3, 0.0, 1e3, *seen, *tells.bounds}
    return sorted(float(number) for number in numbers if abs(number) < inf)


def _read(situation: Situation, slot: Slot) -> float:
    return float(situation.given[slot] if slot in situation.given else situation.kept.get(slot, 0.0))


class _Tells:
    """The comparisons on which a robot's decision depends."""

    def __init__(self, player: Player, robot: int) -> None:
        self.player, self.evaluations = player, 0
        self.found = defaultdict[int, float](float)
        """How many edges were found of each comparison; less of one at which the action stays the same."""
        nodes = needed(player.needs.robots[robot].cells.values())
        self.nodes = [node for node in nodes if _tells(node)]
        literals = (operand for node in self.nodes for operand in node.operands)
        self.bounds = [
            float(player.literal(node)) for node in literals if node.operation in ("literal", "constant")
        ]

    def at(self, situation: Situation) -> list[Any]:
        """Return what they say in a situation."""
        self.evaluations += 1
        return self.player.values(self.nodes, situation)

    def edges(self, base: Situation, scalar: Scalar, low: float, high: float) -> Iterator[int]:
        """Yield the places between two numbers after which a comparison says something else.

        No more are looked for once each comparison in sight changed often enough, or much was evaluated.
        """
        last, after = self.at(_with(base, scalar, high)), _place_of(low)
        for _ in range(EDGES_BETWEEN):
            first = self.at(_with(base, scalar, _number_at(after)))
            changed = {
                index for index, (one, other) in enumerate(zip(first, last, strict=True)) if one != other
            }
            if all(self.found[index] >= EDGES for index in changed) or self.evaluations > MOST_EVALUATIONS:
                return
            below, above = after, _place_of(high)
            while above - below > 1:
                middle = (below + above) // 2
                if self.at(_with(base, scalar, _number_at(middle))) == first:
                    below = middle
                else:
                    above = middle
            beyond = self.at(_with(base, scalar, _number_at(above)))
            sides = [_with(base, scalar, _number_at(place)) for place in (below, above)]
            matters = len({self.player.answer(side).action for side in sides}) > 1
            for index in changed:
                if first[index] != beyond[index]:
                    self.found[index] += 1.0 if matters else IDLE
            yield below
            after = above


def _tells(node: Node) -> bool:
    is_comparison = node.operation in COMPARISONS and node.operands[0].kind is Kind.NUMBER
    return is_comparison or node.operation == "clamp_index"


_FLOAT, _WHOLE = Struct("<d"), Struct("<q")


def _place_of(number: float) -> int:
    """Return the place of a number among all finite ones, 0 for both zeros."""
    bits: int = _WHOLE.unpack(_FLOAT.pack(number))[0]
    return bits if bits >= 0 else -(bits & 0x7FFFFFFFFFFFFFFF)


def _number_at(place: int) -> float:
    number: float = _FLOAT.unpack(_WHOLE.pack(abs(place)))[0]
    return number if place >= 0 else -number
