"""What a designer should know of the worth of a design's parts, in words."""

from __future__ import annotations

from dataclasses import dataclass
from math import floor, log10
from typing import TYPE_CHECKING, get_args

from bbsd.explanation.conditions import join_words
from bbsd.explanation.lines import percent
from bbsd.explanation.worth.results import (
    Finding,
    FindingKind,
    clearly_above,
    clearly_below,
    never_changes,
)
from bbsd.explanation.worth.robots import are_alike

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from bbsd.evaluation import Interval
    from bbsd.explanation.worth.results import BehaviorWorth, Order, RobotsAlike, RuleWorth

SELDOM = 0.01
"""The share of time below which a behavior is hardly in control."""
SMALL, SMALL_SPREAD = 0.01, 0.05
"""A change is small if its interval is within this part of the mean return, or of the return's standard deviation."""
DIGITS = 5
"""Significant digits of the return, which say how many decimals its changes have."""
KEPT = 0.9
"""The share of its steps in which an expectation should hold."""


def findings_of(
    behaviors: Sequence[BehaviorWorth],
    orders: Sequence[Order],
    alike: Sequence[RobotsAlike],
    returns: Interval,
    steps: float,
) -> tuple[Finding, ...]:
    """Return what stands out, the gravest first; `steps` is the mean length of an episode."""
    judge = _Judge(returns, steps)
    found = [
        *(finding for each in behaviors for finding in judge.of_behavior(each)),
        *(finding for each in behaviors for rule in each.rules for finding in judge.of_rule(each, rule)),
        *judge.of_orders(orders),
        *_of_robots([pair for pair in alike if are_alike(pair)]),
    ]
    kinds = get_args(FindingKind)
    return tuple(sorted(found, key=lambda finding: kinds.index(finding.kind)))


@dataclass(frozen=True, slots=True)
class _Judge:
    """Judges changes beside the return of the design and the mean length of an episode."""

    returns: Interval
    steps: float

    def of_behavior(self, worth: BehaviorWorth) -> Iterator[Finding]:
        name, change = worth.behavior, self.change(worth.dropped)
        if clearly_above(worth.dropped):
            pace, steps = self.returns.mean / self.steps, worth.control * self.steps
            if steps and worth.own / steps > max(pace, 0.0):
                own = f"earns {worth.own / steps:.3g} in each step that it controls, where the mean is {pace:.3g}"
                text = f"{name} is selfish: it {own}, and the team does better without it: {change}"
                yield Finding("selfish", (name,), text)
            else:
                yield Finding("harmful", (name,), f"the team does better without {name}: {change}")
        elif not worth.control:
            yield Finding("idle", (name,), f"{name} never controls: it can be removed, {change}")
        elif self.is_removable(worth.dropped):
            kind: FindingKind = "idle" if worth.control < SELDOM else "removable"
            hardly = "is hardly in control and " if kind == "idle" else ""
            yield Finding(kind, (name,), f"{name} {hardly}can be removed: {change}")
        if worth.expectation is not None and worth.expectation < KEPT:
            text = f"{name} breaks its expectation: it held after {percent(worth.expectation)} of its steps"
            yield Finding("broken expectation", (name,), text)

    def of_rule(self, worth: BehaviorWorth, rule: RuleWorth) -> Iterator[Finding]:
        """Judge a rule, unless it is all that a behavior has, or that can be removed as a whole."""
        if rule.dropped is None or len(worth.rules) < 2 or self.is_removable(worth.dropped):
            return
        named, change = f"{worth.behavior}: the rule {rule.text}", self.change(rule.dropped)
        if clearly_above(rule.dropped):
            if not clearly_above(worth.dropped):
                yield Finding("harmful rule", (worth.behavior,), f"{named} does harm, without it {change}")
        elif never_changes(rule.dropped) and not rule.control and rule.acts:
            yield Finding("useless rule", (worth.behavior,), f"{named} is never used, it can be removed")
        elif self.is_removable(rule.dropped):
            yield Finding("useless rule", (worth.behavior,), f"{named} can be removed: {change}")

    def of_orders(self, orders: Sequence[Order]) -> Iterator[Finding]:
        """Name the best order of those that are clearly better."""
        for order in [each for each in orders if clearly_above(each.change)][:1]:
            text = f"another order does better: {' '.join(order.structure)}, {self.change(order.change)}"
            yield Finding("better order", order.structure, text)

    def is_removable(self, change: Interval) -> bool:
        """Return whether a change of the return is nothing, or its interval holds 0 and is narrow."""
        if never_changes(change):
            return True
        if clearly_below(change) or clearly_above(change) or not change.low <= 0 <= change.high:
            return False
        small = max(SMALL * abs(self.returns.mean), SMALL_SPREAD * self.returns.sd)
        return max(-change.low, change.high) <= small

    def change(self, change: Interval) -> str:
        """Return a change of the return in words."""
        return change_text(change, self.returns)


def change_text(change: Interval, returns: Interval) -> str:
    """Return a change of the return in words, such as `return -0.02 to +0.01`; `returns` are those before it."""
    if never_changes(change):
        return "the return never changes"
    largest = max(abs(returns.mean), returns.sd, 1e-9)
    decimals = max(0, DIGITS - 1 - floor(log10(largest)))
    ends = [round(value, decimals) + 0.0 for value in (change.low, change.high)]
    if not any(ends):
        return f"the return changes by less than {10**-decimals:g}"
    low, high = (f"{value:+.{decimals}f}" for value in ends)
    return f"return {low} to {high}"


def _of_robots(pairs: Sequence[RobotsAlike]) -> Iterator[Finding]:
    """Name each group of robots that are all alike, in pairs or over others."""
    groups: list[set[int]] = []
    for pair in pairs:
        joined = {pair.first, pair.second}.union(
            *(group for group in groups if {pair.first, pair.second} & group)
        )
        groups = [group for group in groups if not group & joined] + [joined]
    for group in sorted(groups, key=min):
        within = [pair for pair in pairs if pair.first in group]
        more = " at least" if len(within) > 1 else ""
        doing = f"did the same in{more} {percent(min(pair.same_action for pair in within))} of the steps"
        places = [pair.same_place for pair in within if pair.same_place is not None]
        if places:
            doing += f", and stood in the same place after{more} {percent(min(places))}"
        else:
            same = min(pair.same_state for pair in within)
            doing += f", and were in the same state after{more} {percent(same)}"
        robots = [str(robot) for robot in sorted(group)]
        yield Finding("robots alike", tuple(robots), f"robots {join_words(robots, 'and')} {doing}")
