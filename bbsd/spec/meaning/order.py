"""Names in the order of their dependencies, and the circles among them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from graphlib import CycleError, TopologicalSorter

from bbsd.expression.tree import names_used
from bbsd.spec.written import Expression


def dependencies(written: Mapping[str, Iterable[Expression]]) -> dict[str, set[str]]:
    """Which of the names each name's expressions use."""
    return {
        name: set().union(*(names_used(expression.tree) for expression in expressions)) & written.keys()
        for name, expressions in written.items()
    }


def in_order(written: Mapping[str, Iterable[Expression]]) -> list[str]:
    """The names, each after those that it uses. There must be no circles."""
    return list(TopologicalSorter(dependencies(written)).static_order())


def circles(uses: Mapping[str, set[str]]) -> list[tuple[str, ...]]:
    """Circles of dependency, one after the other until none is left: (a, b, a) where a uses b and b uses a."""
    left = {name: set(others) for name, others in uses.items()}
    found = []
    while True:
        try:
            TopologicalSorter(left).prepare()
        except CycleError as error:
            circle = tuple(reversed(error.args[1]))
            found.append(circle)
            for name in circle:
                left.pop(name, None)
            left = {name: others - set(circle) for name, others in left.items()}
        else:
            return found
