"""In which loop of a step each value is computed, where there are loops over robots.

Loops over the team's lanes (even stages, from 0) and loops over robots and lanes (odd stages) take turns. A value
stands in the first loop in which all that it needs is there. Without loops over robots all is in stage 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.expression.graph import Level, Node, needed

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    from bbsd.compiler.emission import Block, Emitter
    from bbsd.compiler.frame import Frame


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
    return max((_from(node, found, level) for node in nodes), default=level is Level.EACH)


@dataclass(frozen=True, slots=True)
class Closing:
    """The blocks in which a step ends; without loops over robots they are all the same."""

    each: Block
    """Where all is known of a robot."""
    team: Block
    """Where all is known of the team."""
    store_each: Block
    store_team: Block
    """Where slots are stored that the next step reads: nothing reads them any more in this one."""

    def block_of(self, node: Node) -> Block:
        """Where a value is certainly known."""
        return self.each if node.level in (Level.EACH, Level.ROBOT) else self.team

    def block_at(self, array: str, frame: Frame) -> Block:
        """Where all is known that an array may hold."""
        return self.each if frame.is_own(array) else self.team

    def store_of(self, array: str, frame: Frame) -> Block:
        """Where a slot's array is written."""
        return self.store_each if frame.is_own(array) else self.store_team


def closing(emitter: Emitter, outputs: Iterable[Node]) -> Closing:
    """The last blocks of a step that computes these outputs."""
    block = emitter.blocks.stage
    if not emitter.blocks.looped:
        return Closing(block(0), block(0), block(0), block(0))
    stage = last(outputs, emitter.stage_of, Level.EACH)
    return Closing(*(block(stage + further) for further in range(4)))


def _stage(node: Node, found: Mapping[int, int], decided: int) -> int:
    operands: Sequence[Node] = node.operands
    match node.operation:
        case "choice":
            return decided
        case "of" | "over" if operands[0].operation == "slot":
            return 0 if node.operation == "of" else 2
        case "other" if operands[0].operation == "slot":
            return 1
        case "of" | "over":
            return found[operands[0].number] + 1
        case "other":
            return found[operands[0].number] + 2
    if node.level not in (Level.LANE, Level.EACH):
        return 0
    return last(operands, found, node.level)


def _from(node: Node, found: Mapping[int, int], level: Level) -> int:
    """The first stage of that level that may use a value."""
    stage = found.get(node.number, 0)
    each = level is Level.EACH
    if node.operation == "slot" or node.level not in (Level.LANE, Level.EACH):
        return int(each)
    return stage if stage % 2 == each else stage + 1
