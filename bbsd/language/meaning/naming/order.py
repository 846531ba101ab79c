"""Names in the order of their dependencies, and the circles that prevent an order."""

from __future__ import annotations

from graphlib import CycleError, TopologicalSorter
from typing import TYPE_CHECKING

from bbsd.expression.syntax.tree import functions_called, names_used
from bbsd.language.field_types import Expression

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping


MAX_CIRCLES = 50
"""Circles reported of one spec: as many as mistakes are shown of it at most."""

Uses = dict[str, set[str]]
"""For each name, the other names that its value needs."""


def names_used_in(expressions: Iterable[Expression]) -> frozenset[str]:
    """Return all names that some expressions use, without those of functions."""
    return frozenset().union(*(names_used(expression.tree) for expression in expressions))


def functions_called_in(expressions: Iterable[Expression]) -> frozenset[str]:
    """Return the names of all functions that some expressions call."""
    return frozenset().union(*(functions_called(expression.tree) for expression in expressions))


def within_definitions(
    expressions: Iterable[Expression], definitions: Mapping[str, Expression]
) -> list[Expression]:
    """Return some expressions, and those of the definitions that they use, and these use, by their keys in a spec."""
    by_name = {key.strip(): expression for key, expression in definitions.items() if "(" not in key}
    by_function = {
        key.partition("(")[0].strip(): expression for key, expression in definitions.items() if "(" in key
    }
    waiting, found = [*expressions], dict[int, Expression]()
    while waiting:
        found |= {id(expression): expression for expression in waiting}
        used = [by_name[name] for name in sorted(names_used_in(waiting) & by_name.keys())]
        used += [by_function[name] for name in sorted(functions_called_in(waiting) & by_function.keys())]
        waiting = [expression for expression in used if id(expression) not in found]
    return [*found.values()]


def uses_among(uses: Mapping[str, frozenset[str]]) -> Uses:
    """Return what each name uses of the others."""
    return {name: set(others & uses.keys()) for name, others in uses.items()}


def dependency_order(uses: Uses) -> list[str]:
    """Return the names, each after those that it uses; there must be no circles."""
    return list(TopologicalSorter(uses).static_order())


def find_circles(uses: Uses) -> tuple[list[tuple[str, ...]], set[str]]:
    """Return circles of dependency, (a, b, a) where a uses b and b uses a; and all names that have no order."""
    circles: list[tuple[str, ...]] = []
    left = {name: set(others) for name, others in uses.items()}
    while len(circles) < MAX_CIRCLES and (circle := _find_circle(left)):
        circles.append(circle)
        left = {name: others - set(circle) for name, others in left.items() if name not in circle}
    return circles, (uses.keys() - left.keys()) | _blocked(left)


def _find_circle(uses: Uses) -> tuple[str, ...] | None:
    try:
        TopologicalSorter(uses).prepare()
    except CycleError as error:
        return tuple(reversed(error.args[1]))
    return None


def _blocked(uses: Uses) -> set[str]:
    """Return the names that stand in a circle or need one that does."""
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
    """Return for each name the weight of the heaviest chain of names that ends in it; there must be no circles."""
    heaviest: dict[str, int] = {}
    for name in dependency_order(uses):
        heaviest[name] = weights[name] + max((heaviest[other] for other in uses[name]), default=0)
    return heaviest
