"""What a comparison of two designs says. The first is called A, the second B, and differences are B minus A."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from bbsd.evaluation import Interval


@dataclass(frozen=True, slots=True)
class Command:
    """Which behavior controls, and its action; both are '' where nobody does."""

    behavior: str
    action: str


@dataclass(frozen=True, slots=True)
class CommandDifference:
    """Situations in which A and B command something else."""

    a: Command
    b: Command
    share_a: float
    """Of A's robot-steps in its episodes, the part that began in such a situation; `share_b` of B's in B's."""
    share_b: float
    where: tuple[str, ...]
    """Conditions, none of which holds in any other situation that was met; empty for rare differences."""
    left: int
    """Situations that were met and fulfill none of the conditions."""


@dataclass(frozen=True, slots=True)
class Commands:
    """How often A and B would have commanded something else, along the episodes of each."""

    share_a: float
    """Of A's robot-steps, those in which B would have commanded something else; `share_b` the other way round."""
    share_b: float
    steps_a: int
    steps_b: int
    episodes: int
    """Of each design, the episodes that were watched."""
    differences: tuple[CommandDifference, ...]
    """The most frequent first."""


@dataclass(frozen=True, slots=True)
class RuleChange:
    """Cells of a behavior for which A's table says `before`, and B's `after`."""

    behavior: str
    before: str
    after: str
    cells: int
    where: tuple[str, ...]
    """Conditions, one of which holds in each of these cells, and in no other; empty where they would be too long."""
    asked_a: float | None = None
    """Of A's robot-steps, those in which A's behavior was asked there: it was excited, and no higher one acted."""
    asked_b: float | None = None


@dataclass(frozen=True, slots=True)
class Redefined:
    """A behavior that both have, and that has other inputs, excitement or actions, as `parts` names them."""

    behavior: str
    parts: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Order:
    """The structures, highest layer first, and the behaviors that moved: without them the rest has the same order."""

    a: tuple[str, ...]
    b: tuple[str, ...]
    moved: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class TermDifference:
    """What a reward term gave per episode; None where a design's reward does not have it."""

    term: str
    a: float | None
    b: float | None
    difference: Interval | None


@dataclass(frozen=True, slots=True)
class Source:
    """A change of A that makes a part of B of it, and what it changes alone."""

    kind: str
    """`rules` for the cells of one decision of a behavior, `behavior` for all its cells, `definition` for its inputs,
    excitement, actions and cells, `order` for the structure."""
    behavior: str
    """'' for the order."""
    before: str
    after: str
    """The decisions, '' for others than `rules`."""
    where: tuple[str, ...]
    in_a: Interval | None
    """What A earns more with this change alone."""
    in_b: Interval | None
    """What B earns more than without this change."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """Two designs compared."""

    a: str
    b: str
    """The paths of the designs."""
    episodes: int
    is_paired: bool
    """Whether differences are those of pairs: both move in the same world."""
    return_a: Interval
    return_b: Interval
    difference: Interval
    terms: tuple[TermDifference, ...]
    commands: Commands | None
    rules: tuple[RuleChange, ...]
    order: Order
    redefined: tuple[Redefined, ...]
    sources: tuple[Source, ...]
    unmeasured: int
    """The changes that were too many to measure."""
    notes: tuple[str, ...]
    """What could not be compared, or not as usual, and why."""

    @property
    def is_same(self) -> bool:
        """Whether tables and structure are the same, so that the designs do the same in every episode of a world."""
        return not (self.rules or self.redefined) and self.order.a == self.order.b

    def __repr__(self) -> str:
        low, high = self.difference.low, self.difference.high
        return f"<Comparison: {self.b} earns {self.difference.mean:+.6g} ({low:+.6g} to {high:+.6g}) beside {self.a}>"
