"""The loop of a step in which each value is computed, where there are loops over robots.

Loops over the team's lanes (even stages, from 0) and loops over robots and lanes (odd stages) take turns. A value
is computed in the first loop that has all its operands. Loops over pairs of robots stand in a loop over robots, before
its lanes. Without loops over robots all is in stage 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from bbsd.expression.graph import Level, needed

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from bbsd.compiler.writing.blocks import Block, Blocks
    from bbsd.expression.graph import Node

FIRST = {Level.LANE: 0, Level.EACH: 1}
"""The first stage of the team, and of the robots."""


def stages_of(outputs: Iterable[Node], decided: int) -> dict[int, int]:
    """Return the stage of every node that the outputs need, by its number; choices are known from stage `decided` on.

    Nodes that are computed outside the loops over lanes have stage 0.
    """
    stage_of: dict[int, int] = {}
    for node in needed(outputs):
        stage_of[node.number] = _stage(node, stage_of, decided)
    return stage_of


def first_stage_with(nodes: Iterable[Node], stage_of: Mapping[int, int], level: Level) -> int:
    """Return the first stage of a level, LANE or EACH, in which all these values are known."""
    return max((_usable_from(node, stage_of, level) for node in nodes), default=FIRST[level])


def _stage(node: Node, stage_of: Mapping[int, int], decided: int) -> int:
    if node.operation == "choice":
        return decided
    if node.level is Level.PAIR or node.operation == "among":
        return max(
            (_read_by_pairs_from(operand, stage_of) for operand in node.operands), default=FIRST[Level.EACH]
        )
    if node.level not in FIRST:
        return 0
    if node.operation in ("of", "over", "other"):
        return _after_family(node, node.operands[0], stage_of)
    return first_stage_with(node.operands, stage_of, node.level)


def _read_by_pairs_from(node: Node, stage_of: Mapping[int, int]) -> int:
    """Return the first stage whose loop over pairs may read a value: that loop comes before the stage's lanes."""
    if node.level is Level.PAIR:
        return stage_of[node.number]
    if node.operation == "slot" or node.level not in FIRST:
        return FIRST[Level.EACH]
    return stage_of[node.number] + (2 if node.level is Level.EACH else 1)


def _after_family(node: Node, family: Node, stage_of: Mapping[int, int]) -> int:
    """Return the stage of a node that reads a family's values of other robots: they stand in an array by then."""
    if family.operation == "slot":
        return 2 if node.operation == "over" else FIRST[node.level]
    return stage_of[family.number] + (2 if node.operation == "other" else 1)


def _usable_from(node: Node, stage_of: Mapping[int, int], level: Level) -> int:
    """Return the first stage of a level that may use a value."""
    if node.operation == "slot" or node.level not in FIRST:
        return FIRST[level]
    stage = stage_of.get(node.number, 0)
    return stage if stage % 2 == FIRST[level] else stage + 1


@dataclass(frozen=True, slots=True)
class Closing:
    """The blocks in which a step ends, of the robots and of the team; the same without loops over robots."""

    each: Block
    """The block in which all of a robot's values are known."""
    team: Block
    """The block in which all of the team's values are known."""
    store_each: Block
    """The block that stores the robots' slots for the next step: nothing reads them any more in this one."""
    store_team: Block
    """The block that stores the team's slots."""

    def knowing(self, *, own: bool) -> Block:
        """Return the block in which all of a robot's own values, or the team's, are known."""
        return self.each if own else self.team

    def storing(self, *, own: bool) -> Block:
        """Return the block that stores a robot's own slots, or the team's."""
        return self.store_each if own else self.store_team


def closing_of(blocks: Blocks, stage_of: Mapping[int, int], outputs: Iterable[Node]) -> Closing:
    """Return the last blocks of a step that computes these outputs."""
    block = blocks.stage
    if not blocks.looped:
        return Closing(block(0), block(0), block(0), block(0))
    stage = first_stage_with(outputs, stage_of, Level.EACH)
    return Closing(*(block(stage + further) for further in range(4)))
