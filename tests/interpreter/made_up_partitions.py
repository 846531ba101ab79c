"""Partitions that Hypothesis makes up, of every kind, with what rules can call their cells."""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

from hypothesis import strategies as st

from tests.interpreter.made_up_expressions import Draw, Reach, comparison, number, truth, whole

BOUNDS = (-1, 0, 0.5, 1, 2.5, 4, 10)


class Partition(NamedTuple):
    """A partition as plain data, and the cells that each label means."""

    data: Any
    cells: dict[str, frozenset[int]]


def partition(draw: Draw, reach: Reach) -> Partition:
    """A partition of any kind."""
    ways = [of_truth, of_cut, of_values, of_names, of_names_that_cover]
    found: Partition = draw(st.sampled_from(ways))(draw, reach)
    return found


def one_by_one(labels: list[str]) -> dict[str, frozenset[int]]:
    return {label: frozenset({cell}) for cell, label in enumerate(labels)}


TRUTHS = one_by_one(["false", "true"])


def of_truth(draw: Draw, reach: Reach) -> Partition:
    return Partition(truth(draw, reach), TRUTHS)


def of_cut(draw: Draw, reach: Reach) -> Partition:
    bounds = sorted(draw(st.lists(st.sampled_from(BOUNDS), unique=True, min_size=1, max_size=3)))
    cells = {}
    for first, low in enumerate(bounds, 1):
        cells[f"below {low}"] = frozenset(range(first))
        cells[f"from {low}"] = frozenset(range(first, len(bounds) + 1))
        for last, high in enumerate(bounds[first:], first):
            cells[f"{low} to {high}"] = frozenset(range(first, last + 1))
    what = draw(st.sampled_from([number, whole]))(draw, reach)
    return Partition(f"cut({what}, {', '.join(map(str, bounds))})", cells)


def of_values(draw: Draw, reach: Reach) -> Partition:
    first = draw(st.integers(-1, 2))
    last = first + draw(st.integers(1, 3))
    labels = [str(value) for value in range(first, last + 1)]
    return Partition(f"values({whole(draw, reach)}, {first}, {last})", one_by_one(labels))


def of_names(draw: Draw, reach: Reach) -> Partition:
    names = ["low", "far away", "3"][: draw(st.integers(1, 3))]
    conditions = {name: truth(draw, reach, 2) for name in names}
    return Partition({**conditions, "else": "otherwise"}, one_by_one([*names, "else"]))


def of_names_that_cover(draw: Draw, reach: Reach) -> Partition:
    condition = comparison(draw, replace(reach, draws=False), 1)
    return Partition({"this": condition, "that": f"not {condition}"}, one_by_one(["this", "that"]))
