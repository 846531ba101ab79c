"""Names in the order of their dependencies, and what stands in the way of an order."""

from __future__ import annotations

from graphlib import CycleError, TopologicalSorter
from typing import TYPE_CHECKING

from bbsd.expression.tree import names_used

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from bbsd.language.field_types import Expression

MAX_CIRCLES = 50

Uses = dict[str, set[str]]
"""For each name, the others that its value needs."""


def names_used_in(expressions: Iterable[Expression]) -> frozenset[str]:
    """All names that some expressions use."""
    return frozenset().union(*(names_used(expression.tree) for expression in expressions))


def uses_among(uses: Mapping[str, frozenset[str]]) -> Uses:
    """What each name uses of the others."""
    return {name: set(others & uses.keys()) for name, others in uses.items()}


def dependency_order(uses: Uses) -> list[str]:
    """The names, each after those that it uses. There must be no circles."""
    return list(TopologicalSorter(uses).static_order())


def find_circles(uses: Uses) -> tuple[list[tuple[str, ...]], set[str]]:
    """Circles of dependency, (a, b, a) where a uses b and b uses a; and all names that have no order."""
    found: list[tuple[str, ...]] = []
    left = {name: set(others) for name, others in uses.items()}
    while len(found) < MAX_CIRCLES and (circle := _circle(left)):
        found.append(circle)
        left = {name: others - set(circle) for name, others in left.items() if name not in circle}
    return found, (uses.keys() - left.keys()) | _blocked(left)


def _circle(uses: Uses) -> tuple[str, ...] | None:
    try:
        TopologicalSorter(uses).prepare()
    except CycleError as error:
        return tuple(reversed(error.args[1]))
    return None


def _blocked(uses: Uses) -> set[str]:
    """The names that stand in a circle or need one that does."""
    sorter, blocked = TopologicalSorter(uses), set(uses)
    try:
        sorter.prepare()
    except CycleError:
        while ready := sorter.get_ready():
            blocked -= set(ready)
            sorter.done(*ready)
        return blocked
    return set()


def chain_weights(uses: Uses, weights: Mapping[str, int]) -> dict[str, int]:
    """For each name, the weight of the heaviest chain of names that ends in it. There must be no circles."""
    found: dict[str, int] = {}
    for name in dependency_order(uses):
        found[name] = weights[name] + max((found[other] for other in uses[name]), default=0)
    return found
