"""The worth of a design's parts, as values."""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, nan, sqrt
from typing import TYPE_CHECKING, Any, Literal

from bbsd.evaluation.frames import frame
from bbsd.language.models import NO_ACTION_TEXT

if TYPE_CHECKING:
    from collections.abc import Mapping

    from bbsd.evaluation import Interval

CLEAR = 3.0
"""Standard errors from 0 at which a change is called clear: many changes are looked at, so 95 % would be too little."""


def clearly_below(change: Interval) -> bool:
    """Return whether a mean change is certainly a loss, as far as its episodes can tell."""
    return change.mean < -CLEAR * _error(change)


def clearly_above(change: Interval) -> bool:
    """Return whether a mean change is certainly a gain, as far as its episodes can tell."""
    return change.mean > CLEAR * _error(change)


def never_changes(change: Interval) -> bool:
    """Return whether the change was 0 in every episode."""
    return change.mean == 0 and change.sd == 0


def _error(change: Interval) -> float:
    error = change.sd / sqrt(change.count)
    return error if isfinite(error) else float("inf")


@dataclass(frozen=True, slots=True)
class RuleWorth:
    """What a rule is worth: its share of the control of all robots, and the change of the return without it.

    `where` is the condition, '' otherwise. `dropped` is None where there is nothing to drop: No Action otherwise.
    """

    where: str
    decision: str
    control: float
    dropped: Interval | None

    @property
    def acts(self) -> bool:
        """Whether its decision is an action."""
        return self.decision != NO_ACTION_TEXT

    @property
    def text(self) -> str:
        """The rule in words: `push where place is low`, `push otherwise`."""
        return f"{self.decision} {f'where {self.where}' if self.where else 'otherwise'}"


@dataclass(frozen=True, slots=True)
class BehaviorWorth:
    """What a behavior and its layer are worth.

    `control`, `excited`, `activated` and `suppressed` are shares of all robot-steps, `earned` the reinforcement of an
    episode's steps in which it controls, by reward term. `dropped` is the change of the return where it is held to
    No Action, which is the same as leaving its layer out; `random` where its table is replaced by random ones, the mean
    and interval over these. `expectation` is the share of its controlled steps after which its expectation held, None
    where it expects nothing or never controls. `rules` are empty where they are too many.
    """

    behavior: str
    layer: int
    control: float
    excited: float
    activated: float
    suppressed: float
    earned: Mapping[str, float]
    dropped: Interval
    random: Interval
    expectation: float | None
    rules: tuple[RuleWorth, ...]

    @property
    def own(self) -> float:
        """All that is earned while it controls, per episode."""
        return sum(self.earned.values())


@dataclass(frozen=True, slots=True)
class Swap:
    """Two neighboring layers in exchanged order.

    `never` is True where the tables prove that no situation has another command then, None where there are too many.
    """

    upper: str
    lower: str
    change: Interval
    never: bool | None


@dataclass(frozen=True, slots=True)
class Order:
    """A structure, highest layer first, and the change of the return with it; `alike` structures do just the same."""

    structure: tuple[str, ...]
    change: Interval
    alike: int


@dataclass(frozen=True, slots=True)
class Precedence:
    """What must stand above what: the pairs that all structures have in common which are not clearly worse.

    `above` has only pairs with nothing between them. `tried` structures were compared, `whole` says whether these are
    all there are; else they are the given one, and those with two behaviors exchanged or one in another place.
    """

    above: tuple[tuple[str, str], ...]
    tried: int
    whole: bool


@dataclass(frozen=True, slots=True)
class RobotsAlike:
    """Two robots, and the shares of steps in which they did the same, and after which their own state was equal.

    `same_place` is the share after which they stood in the same place, None where the spec has no view.
    """

    first: int
    second: int
    same_action: float
    same_state: float
    same_place: float | None
    episodes: int


FindingKind = Literal[
    "selfish",
    "harmful",
    "harmful rule",
    "broken expectation",
    "better order",
    "robots alike",
    "idle",
    "removable",
    "useless rule",
]
"""The gravest first."""


@dataclass(frozen=True, slots=True)
class Finding:
    """Something that a designer should know, in words; `subjects` are the behaviors or robots that it is about."""

    kind: FindingKind
    subjects: tuple[str, ...]
    text: str


@dataclass(frozen=True, slots=True)
class Worth:
    """What the parts of a design are worth.

    `behaviors` go from the highest layer down. What they and `nobody` earned, added over all terms, is the mean return.
    """

    name: str
    returns: Interval
    robots: int
    steps: float
    behaviors: tuple[BehaviorWorth, ...]
    nobody: Mapping[str, float]
    nobody_control: float
    random_tables: int
    swaps: tuple[Swap, ...]
    orders: tuple[Order, ...]
    precedence: Precedence
    alike: tuple[RobotsAlike, ...]
    findings: tuple[Finding, ...]
    left_out: tuple[str, ...] = ()

    def to_frame(self) -> Any:  # noqa: ANN401 - pandas is optional
        """Return a pandas DataFrame with a row for each behavior, and one for each of its rules.

        Raises NoPandas where pandas is not installed.
        """
        rows = [
            (each.layer, each.behavior, rule, control, earned, change)
            for each in self.behaviors
            for rule, control, earned, change in (
                ("", each.control, each.own, each.dropped),
                *((rule.text, rule.control, nan, rule.dropped) for rule in each.rules),
            )
        ]
        changes = [
            (nan, nan, nan) if row[-1] is None else (row[-1].mean, row[-1].low, row[-1].high) for row in rows
        ]
        names = ("layer", "behavior", "rule", "control", "earned", "dropped", "low", "high")
        columns = zip(*((*row[:-1], *change) for row, change in zip(rows, changes, strict=True)), strict=True)
        return frame(dict(zip(names, map(list, columns), strict=True)))

    def __repr__(self) -> str:
        return f"<Worth of {self.name}: {len(self.behaviors)} behaviors, mean return {self.returns.mean:.6g}>"
