"""Values of state by name: the elements of a list together, as nested lists."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, TypeVar

from bbsd.expression.node_data import variable_text

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping, Sequence

    from bbsd.expression.node_data import Variable

T = TypeVar("T")


def by_name(
    variables: Sequence[Variable],
    values: Sequence[T],
    lengths: Mapping[str, tuple[int, ...]],
    listed: Callable[[list[T]], T],
) -> dict[str, T]:
    """Return values by name, those of a list nested by `listed`; elements of a list that is not whole, one by one.

    `lengths` has the lengths of the nested lists of each name, () for a single value.
    """
    groups: dict[str, dict[tuple[int, ...], T]] = {}
    for (name, place), value in zip(variables, values, strict=True):
        groups.setdefault(name, {})[place] = value
    found: dict[str, T] = {}
    for name, group in groups.items():
        if len(group) == prod(lengths[name]):
            found[name] = _nested(group, lengths[name], (), listed)
        else:
            found |= {variable_text((name, place)): value for place, value in group.items()}
    return found


def lengths_of(variables: Iterable[Variable]) -> dict[str, tuple[int, ...]]:
    """Return for each name the lengths of the nested lists that have these places, () for a single value."""
    places: dict[str, list[tuple[int, ...]]] = {}
    for name, place in variables:
        places.setdefault(name, []).append(place)
    return {
        name: tuple(1 + max(indices) for indices in zip(*all_places, strict=True))
        for name, all_places in places.items()
    }


def _nested(
    group: Mapping[tuple[int, ...], T],
    lengths: tuple[int, ...],
    place: tuple[int, ...],
    listed: Callable[[list[T]], T],
) -> T:
    if len(place) == len(lengths):
        return group[place]
    return listed([_nested(group, lengths, (*place, index), listed) for index in range(lengths[len(place)])])
