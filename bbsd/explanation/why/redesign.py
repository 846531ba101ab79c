"""The smallest change of rules or order after which a robot would have acted otherwise in one situation.

A change is another decision in one cell of one table, an exchange of two layers, or a behavior that is in no layer in
the place of another one.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations
from typing import TYPE_CHECKING, TypeAlias

from bbsd.explanation.why.aim import Act

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence

    from bbsd.architecture import Architecture
    from bbsd.explanation.why.situation import Situation


@dataclass(frozen=True, slots=True)
class Deciding:
    """All that a decision depends on: by behavior the wish in its cell and whether it is excited; the structure."""

    wishes: tuple[int, ...]
    excited: tuple[bool, ...]
    structure: tuple[int, ...]
    """Lowest layer first."""

    @property
    def activated(self) -> list[int]:
        """The behaviors that are excited and want something, from the highest layer down."""
        return [each for each in reversed(self.structure) if self.excited[each] and self.wishes[each]]

    @property
    def act(self) -> Act:
        """What controls: the wish of the highest activated behavior, or nobody."""
        for behavior in self.activated:
            return Act(behavior, self.wishes[behavior])
        return Act(-1, 0)


def deciding(architecture: Architecture, situation: Situation) -> Deciding:
    """Return what an architecture's decision in a situation depends on."""
    wishes = tuple(int(table[cell]) for table, cell in zip(architecture.tables, situation.cells, strict=True))
    return Deciding(wishes, situation.excited, tuple(architecture.structure.tolist()))


@dataclass(frozen=True, slots=True)
class NewWish:
    """Another decision in the present cell of a behavior's table."""

    behavior: int
    wish: int

    def apply(self, now: Deciding) -> Deciding:
        """Return what decides after the change."""
        wishes = (*now.wishes[: self.behavior], self.wish, *now.wishes[self.behavior + 1 :])
        return replace(now, wishes=wishes)


@dataclass(frozen=True, slots=True)
class Exchange:
    """Two layers, counted from 0, exchange their behaviors."""

    lower: int
    higher: int

    def apply(self, now: Deciding) -> Deciding:
        """Return what decides after the change."""
        structure = [*now.structure]
        structure[self.lower], structure[self.higher] = structure[self.higher], structure[self.lower]
        return replace(now, structure=tuple(structure))


@dataclass(frozen=True, slots=True)
class Replacement:
    """A behavior that is in no layer takes the place of the one in a layer, counted from 0."""

    layer: int
    behavior: int

    def apply(self, now: Deciding) -> Deciding:
        """Return what decides after the change."""
        structure = (*now.structure[: self.layer], self.behavior, *now.structure[self.layer + 1 :])
        return replace(now, structure=structure)


Change: TypeAlias = NewWish | Exchange | Replacement
Changes: TypeAlias = tuple[Change, ...]


def single_changes(now: Deciding, n_actions: Sequence[int]) -> Iterator[Change]:
    """Yield every single change; `n_actions` of each behavior."""
    for behavior, count in enumerate(n_actions):
        yield from (NewWish(behavior, wish) for wish in range(count + 1) if wish != now.wishes[behavior])
    layers = range(len(now.structure))
    yield from (Exchange(lower, higher) for lower, higher in combinations(layers, 2))
    left_out = [behavior for behavior in range(len(n_actions)) if behavior not in now.structure]
    yield from (Replacement(layer, behavior) for layer in layers for behavior in left_out)


def smallest_changes(now: Deciding, n_actions: Sequence[int], wanted: Collection[Act]) -> tuple[Changes, ...]:
    """Return the smallest sets of changes after which one of the wanted acts controls; none where no set does.

    All of one change are returned. Of two changes those in which an excited behavior decides otherwise: where nothing
    single helps, these help if any two do, since to raise a behavior takes one change of order. Where no two help,
    nobody is wanted, or only behaviors without another action are excited: then all that are activated must be silent.
    """
    singles = [*single_changes(now, n_actions)]
    one = [(change,) for change in singles if change.apply(now).act in wanted]
    if one:
        return tuple(one)
    decisive = [change for change in singles if isinstance(change, NewWish) and now.excited[change.behavior]]
    if any(act.behavior >= 0 and now.excited[act.behavior] for act in wanted):
        two = [
            (each, other)
            for each, other in _pairs(decisive, singles)
            if _both(each, other, now).act in wanted
        ]
        if two:
            return tuple(two)
    silenced = tuple(NewWish(behavior, 0) for behavior in now.activated)
    return (silenced,) if Act(-1, 0) in wanted else ()


def _pairs(decisive: Sequence[NewWish], singles: Sequence[Change]) -> Iterator[tuple[Change, Change]]:
    """Yield pairs of a new wish with another change, each once."""
    for place, each in enumerate(decisive):
        later = {*decisive[place + 1 :]}
        for other in singles:
            if not isinstance(other, NewWish) or (other in later and other.behavior != each.behavior):
                yield each, other


def _both(each: Change, other: Change, now: Deciding) -> Deciding:
    return other.apply(each.apply(now))
