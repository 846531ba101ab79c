"""The order of the layers: which other structures do as well as the given one, and what must stand above what."""

from __future__ import annotations

from itertools import combinations, permutations
from math import isnan
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture import Architecture, behavior_keys, joint_space
from bbsd.evaluation import paired_episodes
from bbsd.explanation.worth.results import Order, Precedence, clearly_below
from bbsd.explanation.worth.variants import Variants

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.evaluation import PairedEpisodes

    Structure = NDArray[np.int64]

MOST_LAYERS = 5
"""Layers up to which all orders are tried."""
SHOWN = 5
"""The best orders that are shown."""


def tried_orders(structure: Structure) -> tuple[list[Structure], bool]:
    """Return the structures to compare with one, itself first, and whether these are all there are.

    With many layers they are those in which two behaviors are exchanged, or one has another place.
    """
    layers = structure.tolist()
    whole = len(layers) <= MOST_LAYERS
    others = permutations(layers) if whole else map(tuple, _neighbors(structure))
    orders = dict.fromkeys([tuple(layers), *others])
    return [np.array(order, np.int64) for order in orders], whole


def _neighbors(structure: Structure) -> Iterator[list[int]]:
    for low, high in combinations(range(len(structure)), 2):
        yield swapped(structure, low, high).tolist()
    for place, behavior in enumerate(structure.tolist()):
        others = np.delete(structure, place)
        for other_place in range(len(structure)):
            yield np.insert(others, other_place, behavior).tolist()


def swapped(structure: Structure, one: int, other: int) -> Structure:
    """Return a structure with two layers exchanged."""
    changed = structure.copy()
    changed[[one, other]] = structure[[other, one]]
    return changed


def compare_orders(
    problem: Problem,
    architecture: Architecture,
    choosing: NDArray[np.uint64],
    judging: NDArray[np.uint64],
    generation: int,
) -> tuple[tuple[Order, ...], Precedence]:
    """Return the best orders of a design's layers, and what must stand above what.

    Orders are chosen in other episodes than those in which the best are measured, else the best would look too good.

    Args:
        problem: the spec.
        architecture: the design.
        choosing, judging: keys of the episodes for each, (n_episodes,).
        generation: in whose constants they run.
    """
    structures, whole = tried_orders(architecture.structure)
    designs = [Architecture(architecture.tables, structure) for structure in structures]
    groups: dict[bytes, list[int]] = {}
    for number, key in enumerate(behavior_keys(joint_space(problem.meaning), designs)):
        groups.setdefault(key, []).append(number)
    distinct = list(groups.values())
    chosen = _in_episodes(problem, architecture, [structures[g[0]] for g in distinct], choosing, generation)
    finite = [index for index in range(1, len(distinct) + 1) if not isnan(chosen.difference(index).mean)]
    ranked = sorted(finite, key=lambda index: -chosen.difference(index).mean)
    best = ranked[:SHOWN]
    judged = _in_episodes(
        problem, architecture, [structures[distinct[index - 1][0]] for index in best], judging, generation
    )
    orders = [
        Order(
            _named(problem, structures[distinct[index - 1][0]]),
            judged.difference(place),
            len(distinct[index - 1]),
        )
        for place, index in enumerate(best, start=1)
    ]
    good = [
        structures[number]
        for index in finite
        if not clearly_below(chosen.difference(index))
        for number in distinct[index - 1]
    ]
    above = _reduced(_in_all(good), len(architecture.tables))
    names = problem.names
    precedence = Precedence(tuple((names[one], names[other]) for one, other in above), len(structures), whole)
    return tuple(sorted(orders, key=lambda order: -order.change.mean)), precedence


def _in_episodes(
    problem: Problem,
    architecture: Architecture,
    structures: Sequence[Structure],
    keys: NDArray[np.uint64],
    generation: int,
) -> PairedEpisodes:
    """Run the design, the number 0, and the same tables in other structures, numbers 1, 2 and so on."""
    variants = Variants(architecture)
    for structure in structures:
        variants.with_structure(structure, f"in the order {' '.join(_named(problem, structure))}")
    agents, labels = variants.agents, variants.labels
    return paired_episodes(problem, agents, keys, generation, labels=labels, all_finite=False)


def _named(problem: Problem, structure: Structure) -> tuple[str, ...]:
    """Return a structure by names, highest layer first."""
    return tuple(problem.names[behavior] for behavior in reversed(structure.tolist()))


def _in_all(structures: Sequence[Structure]) -> set[tuple[int, int]]:
    """Return the pairs (upper, lower) that all structures have in this order."""
    pairs = [
        {(order[high], order[low]) for low, high in combinations(range(len(order)), 2)}
        for order in (structure.tolist() for structure in structures)
    ]
    return set.intersection(*pairs)


def _reduced(above: set[tuple[int, int]], n_behaviors: int) -> list[tuple[int, int]]:
    """Return the pairs of a partial order that have nothing between them, in ascending order."""
    between = {
        (one, other)
        for one, other in above
        for middle in range(n_behaviors)
        if (one, middle) in above and (middle, other) in above
    }
    return sorted(above - between)
