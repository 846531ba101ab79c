"""Lines of source on their way into the loops of a function."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, NamedTuple

from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from collections.abc import Mapping


@dataclass(slots=True)
class Block:
    """Lines of one level and stage, and the nodes that have a name there."""

    level: Level
    stage: int = 0
    lines: list[str] = field(default_factory=list)
    names: dict[int, str] = field(default_factory=dict)
    kinds: dict[str, Kind] = field(default_factory=dict)
    """What those names hold that hold no number."""
    read: dict[str, str] = field(default_factory=dict)
    """For names of values that other blocks compute, the source that reads them."""
    kept: dict[str, str] = field(default_factory=dict)
    """For names of values that other blocks need, the arrays that they are kept in."""
    head: list[str] = field(default_factory=list)
    """Lines that come before the loop over lanes."""
    last: list[str] = field(default_factory=list)
    """Lines that come after all others."""

    def assign(self, name: str, text: str, kind: Kind = Kind.NUMBER) -> None:
        """Write a line that gives a value its name."""
        self.lines.append(f"{name} = {text}")
        if kind is not Kind.NUMBER:
            self.kinds[name] = kind

    def kind_of(self, name: str) -> Kind:
        """What a name that the block defines holds."""
        return self.kinds.get(name, Kind.NUMBER)


class Stage(NamedTuple):
    """A stage's block, what is once a robot before it, and loops over the others, or the team, before it."""

    block: Block
    robot: Block | None
    pairs: Mapping[bool, Block]

    @property
    def is_empty(self) -> bool:
        """Whether nothing is computed in it."""
        return not self.block.lines and not self.pairs


@dataclass(slots=True)
class Blocks:
    """The blocks of a step: once a call, once a step, and for each stage its loop and what comes before it."""

    call: Block
    looped: bool
    """Whether there are loops over robots: the odd stages."""
    step: Block = field(default_factory=lambda: Block(Level.STEP))
    stages: dict[int, Block] = field(default_factory=dict)
    robots: dict[int, Block] = field(default_factory=dict)
    pairs: dict[tuple[int, bool], Block] = field(default_factory=dict)

    def stage(self, number: int) -> Block:
        """The block of a stage."""
        level = Level.EACH if self.looped and number % 2 else Level.LANE
        return self.stages.setdefault(number, Block(level, number))

    def robot(self, number: int) -> Block:
        """What is computed once a robot, before the lanes of a stage."""
        return self.robots.setdefault(number, Block(Level.ROBOT, number))

    def pair(self, number: int, *, others: bool) -> Block:
        """What is computed for every robot that a robot looks at, before the lanes of a stage."""
        self.stage(number)
        return self.pairs.setdefault((number, others), Block(Level.PAIR, number))

    def every(self) -> list[Stage]:
        """All stages in their order."""
        return [
            Stage(
                self.stages[number],
                self.robots.get(number),
                {others: block for (stage, others), block in self.pairs.items() if stage == number},
            )
            for number in sorted(self.stages)
        ]
