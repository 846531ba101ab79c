"""Which change the difference comes from: each alone, taken over into A and taken back in B, in the same episodes."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.architecture import Architecture
from bbsd.evaluation import RewardNotFinite, agents_of, paired_episodes
from bbsd.evaluation.statistics import interval
from bbsd.explanation.comparison.results import Source

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.evaluation import Interval
    from bbsd.explanation.comparison.hosting import Hosted
    from bbsd.explanation.comparison.results import Order, Redefined, RuleChange

MOST_CHANGES = 24
"""Changes that are measured."""
RULES, BEHAVIOR, DEFINITION, ORDER = "rules", "behavior", "definition", "order"


class Change(NamedTuple):
    """A change of one design that makes a part of another of it, without its effects; `cells` are those of `rules`."""

    source: Source
    cells: NDArray[np.bool_] | None = None


def changes(
    rules: Sequence[tuple[RuleChange, NDArray[np.bool_]]], redefined: Sequence[Redefined], order: Order
) -> list[Change]:
    """Return what can be taken over by itself; of a behavior with several changed decisions also all together."""
    found = [Change(Source(ORDER, "", "", "", (), None, None))] if order.a != order.b else []
    found += [Change(Source(DEFINITION, each.behavior, "", "", (), None, None)) for each in redefined]
    names = [change.behavior for change, _ in rules]
    for name in dict.fromkeys(names):
        if names.count(name) > 1:
            found.append(Change(Source(BEHAVIOR, name, "", "", (), None, None)))
        found += [
            Change(Source(RULES, name, rule.before, rule.after, rule.where, None, None), cells)
            for rule, cells in rules
            if rule.behavior == name
        ]
    return found


def measured(
    found: Sequence[Change],
    a: tuple[Hosted, int] | None,
    b: tuple[Hosted, int] | None,
    streams: NDArray[np.uint64],
) -> tuple[Source, ...]:
    """Return changes with what they are worth in both designs.

    None where the guest cannot act in the host's world, or a reward would not be finite.

    Args:
        found: the changes.
        a: the host A, and the generation in whose constants it runs.
        b: the host B, in which changes are taken back.
        streams: the keys of the episodes, (n_episodes,).
    """
    in_a = _effects(found, a, streams)
    in_b = _effects(found, b, streams)
    return tuple(
        replace(change.source, in_a=one, in_b=None if other is None else _negative(other))
        for change, one, other in zip(found, in_a, in_b, strict=True)
    )


def _effects(
    found: Sequence[Change], hosted: tuple[Hosted, int] | None, streams: NDArray[np.uint64]
) -> list[Interval | None]:
    """Return what the host earns more with each change than without it."""
    if hosted is None or not found:
        return [None] * len(found)
    host, generation = hosted
    designs = [host.own, *(taken_over(host, change) for change in found)]
    returns = np.empty((len(designs), len(streams)))
    for n_layers in {len(design.structure) for design in designs}:
        which = [index for index, design in enumerate(designs) if len(design.structure) == n_layers]
        returns[which] = _returns(host.problem, [designs[index] for index in which], streams, generation)
    return [interval(each - returns[0]) if np.isfinite(each).all() else None for each in returns[1:]]


def _returns(
    problem: Problem, designs: Sequence[Architecture], streams: NDArray[np.uint64], generation: int
) -> NDArray[np.float64]:
    """Return what designs with equally many layers earn, (n_designs, n_episodes); NaN where a reward is not finite."""
    try:
        return paired_episodes(problem, agents_of(designs), streams, generation).returns
    except RewardNotFinite:
        if len(designs) == 1:
            return np.full((1, len(streams)), np.nan)
    return np.concatenate([_returns(problem, [design], streams, generation) for design in designs])


def taken_over(host: Hosted, change: Change) -> Architecture:
    """Return the host's own design with one change that makes a part of the guest's of it."""
    own, guest, source = host.own, host.guest, change.source
    if source.kind == ORDER:
        return _reordered(host)
    index = host.names.index(source.behavior)
    if source.kind == DEFINITION:
        foreign = host.names.index(source.behavior, host.n_own)
        structure = np.where(own.structure == index, foreign, own.structure)
        return Architecture((*own.tables[: host.n_own], *guest.tables[host.n_own :]), structure)
    table = guest.tables[index]
    if change.cells is not None:
        table = np.where(change.cells, table, own.tables[index])
    return Architecture((*own.tables[:index], table, *own.tables[index + 1 :]), own.structure)


def _reordered(host: Hosted) -> Architecture:
    """Return the host's tables in the guest's structure; what the host has no layer for is the guest's."""
    own, guest = host.own, host.guest
    native = {name: index for index, name in enumerate(host.names[: host.n_own])}
    standing = set(own.structure.tolist())
    structure = [
        native[name] if native.get(name) in standing else index
        for index, name in ((index, host.names[index]) for index in guest.structure.tolist())
    ]
    tables = [
        own_table if index in standing else guest_table
        for index, (own_table, guest_table) in enumerate(zip(own.tables, guest.tables, strict=True))
    ]
    return Architecture(tuple(tables), np.array(structure, np.int64))


def _negative(value: Interval) -> Interval:
    return replace(value, mean=0.0 - value.mean, low=0.0 - value.high, high=0.0 - value.low)


def most_asked(
    rules: Sequence[tuple[RuleChange, NDArray[np.bool_]]],
) -> Iterator[tuple[RuleChange, NDArray[np.bool_]]]:
    """Yield changes of rules, those first whose cells are asked most often."""
    yield from sorted(rules, key=lambda each: -((each[0].asked_a or 0.0) + (each[0].asked_b or 0.0)))
