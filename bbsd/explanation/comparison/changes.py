"""What differs between two designs as they are written: cells of tables, definitions, the order of layers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.explanation.comparison.common import definition_differences
from bbsd.explanation.comparison.hosting import same_behaviors
from bbsd.explanation.comparison.results import Order, Redefined, RuleChange
from bbsd.explanation.conditions import places_in_words
from bbsd.language.models import NO_ACTION_TEXT

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from bbsd.explanation.comparison.hosting import Design


def changed_cells(a: Design, b: Design) -> Iterator[tuple[str, int, int, NDArray[np.bool_]]]:
    """Yield each behavior, decision of A and other decision of B, and the cells (n_cells,) that have them.

    Only of behaviors that stand in both structures and are defined the same.
    """
    for name in same_behaviors(a, b):
        if name not in a.order or name not in b.order:
            continue
        before, after = (design.architecture.tables[design.problem.names.index(name)] for design in (a, b))
        pairs = np.stack([before, after], axis=1)[before != after]
        for one, other in np.unique(pairs, axis=0).tolist():
            yield name, one, other, (before == one) & (after == other)


def rule_changes(a: Design, b: Design) -> Iterator[tuple[RuleChange, NDArray[np.bool_]]]:
    """Yield the same in words, and the cells."""
    for name, before, after, cells in changed_cells(a, b):
        module = a.modules[name]
        words, nowhere = (NO_ACTION_TEXT, *module.actions), np.zeros_like(cells)
        where = tuple(place.where for place in places_in_words(cells, nowhere, module.inputs))
        yield RuleChange(name, words[before], words[after], int(cells.sum()), where), cells


def redefined(a: Design, b: Design) -> tuple[Redefined, ...]:
    """Return the behaviors of both structures that are not defined the same."""
    same, ours, theirs = same_behaviors(a, b), a.loaded.spec.behaviors, b.loaded.spec.behaviors
    names = [name for name in a.order if name in b.order and name not in same]
    return tuple(
        Redefined(name, definition_differences(ours[name], theirs[name]) or ("inputs",)) for name in names
    )


def order(a: Design, b: Design) -> Order:
    """Return both structures, and what moved."""
    return Order(a.order, b.order, moved(a.order, b.order))


def moved(one: Sequence[str], other: Sequence[str]) -> tuple[str, ...]:
    """Return the fewest names of both orders without which the rest of them has the same order."""
    common = [name for name in one if name in other]
    places = [other.index(name) for name in common]
    best: list[list[int]] = []
    for index, place in enumerate(places):
        before = [chain for chain, at in zip(best, places, strict=False) if at < place]
        best.append([*max(before, key=len, default=[]), index])
    kept = max(best, key=len, default=[])
    return tuple(name for index, name in enumerate(common) if index not in kept)
