"""In which loop of a step each value is computed, where there are loops over robots.

Loops over the team's lanes (even stages, from 0) and loops over robots and lanes (odd stages) take turns. A value
stands in the first loop in which all that it needs is there. Loops over pairs of robots stand in a loop over robots,
before its lanes. Without loops over robots all is in stage 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.expression.graph import Level, needed

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from bbsd.compiler.writing.blocks import Block
    from bbsd.compiler.writing.emission import Emitter
    from bbsd.expression.graph import Node

FIRST = {Level.LANE: 0, Level.EACH: 1}
"""The first stage of the team, and of the robots."""


def stages(outputs: Iterable[Node], decided: int) -> dict[int, int]:
    """The stage of every node, by its number, that the outputs need; choices are known from stage `decided` on.

    Nodes that are computed outside the loops over lanes have stage 0.
    """
    found: dict[int, int] = {}
    for node in needed(outputs):
        found[node.number] = _stage(node, found, decided)
    return found


def last(nodes: Iterable[Node], found: Mapping[int, int], level: Level) -> int:
    """The first stage of that level, LANE or EACH, in which all these values are there."""
    return max((_from(node, found, level) for node in nodes), default=FIRST[level])


def _stage(node: Node, found: Mapping[int, int], decided: int) -> int:
    if node.operation == "choice":
        return decided
    if node.level is Level.PAIR or node.operation == "among":
        return max((_kept_before(operand, found) for operand in node.operands), default=FIRST[Level.EACH])
    if node.level not in FIRST:
        return 0
    if node.operation in ("of", "over", "other"):
        return _after(node, node.operands[0], found)
    return last(node.operands, found, node.level)


def _kept_before(node: Node, found: Mapping[int, int]) -> int:
    """The first stage of the robots in which a loop over pairs reads a value: it comes before the lanes of a stage."""
    if node.level is Level.PAIR:
        return found[node.number]
    if node.operation == "slot" or node.level not in FIRST:
        return FIRST[Level.EACH]
    return found[node.number] + (2 if node.level is Level.EACH else 1)


def _after(node: Node, family: Node, found: Mapping[int, int]) -> int:
    """The stage of what reads a family from outside: its values stand in an array then."""
    if family.operation == "slot":
        return 2 if node.operation == "over" else FIRST[node.level]
    return found[family.number] + (2 if node.operation == "other" else 1)


def _from(node: Node, found: Mapping[int, int], level: Level) -> int:
    """The first stage of that level that may use a value."""
    if node.operation == "slot" or node.level not in FIRST:
        return FIRST[level]
    stage = found.get(node.number, 0)
    return stage if stage % 2 == FIRST[level] else stage + 1


@dataclass(frozen=True, slots=True)
class Closing:
    """The blocks in which a step ends, of the robots and of the team; the same without loops over robots."""

    each: Block
    """Where all is known of a robot."""
    team: Block
    """Where all is known of the team."""
    store_each: Block
    store_team: Block
    """Where slots are stored that the next step reads: nothing reads them any more in this one."""

    def knowing(self, *, own: bool) -> Block:
        """Where all is known that is a robot's own, or the team's."""
        return self.each if own else self.team

    def storing(self, *, own: bool) -> Block:
        """Where a slot is stored that is a robot's own, or the team's."""
        return self.store_each if own else self.store_team


def closing(emitter: Emitter, outputs: Iterable[Node]) -> Closing:
    """The last blocks of a step that computes these outputs."""
    block = emitter.blocks.stage
    if not emitter.blocks.looped:
        return Closing(block(0), block(0), block(0), block(0))
    stage = last(outputs, emitter.stage_of, Level.EACH)
    return Closing(*(block(stage + further) for further in range(4)))
