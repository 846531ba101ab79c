"""Values of state by name: the elements of a list together, as nested lists."""

from __future__ import annotations

from math import prod
from typing import TYPE_CHECKING, TypeVar

from bbsd.expression.node_data import variable_text

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from bbsd.expression.node_data import Variable

T = TypeVar("T")


def by_name(
    variables: Sequence[Variable], values: Sequence[T], listed: Callable[[list[T]], T]
) -> dict[str, T]:
    """Return values by name, those of a list nested by `listed`; elements of a list that is not whole, one by one."""
    groups: dict[str, dict[tuple[int, ...], T]] = {}
    for (name, place), value in zip(variables, values, strict=True):
        groups.setdefault(name, {})[place] = value
    found: dict[str, T] = {}
    for name, group in groups.items():
        lengths = lengths_of(group)
        if lengths is None:
            found |= {variable_text((name, place)): value for place, value in group.items()}
        else:
            found[name] = _nested(group, lengths, (), listed)
    return found


def lengths_of(places: Mapping[tuple[int, ...], object]) -> tuple[int, ...] | None:
    """Return the lengths of the nested lists that have exactly these places, () for a single value; None for none."""
    lengths = tuple(1 + max(indices) for indices in zip(*places, strict=True))
    return lengths if prod(lengths) == len(places) else None


def _nested(
    group: Mapping[tuple[int, ...], T],
    lengths: tuple[int, ...],
    place: tuple[int, ...],
    listed: Callable[[list[T]], T],
) -> T:
    if len(place) == len(lengths):
        return group[place]
    return listed([_nested(group, lengths, (*place, index), listed) for index in range(lengths[len(place)])])
