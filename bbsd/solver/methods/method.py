"""What a method is: a state, and a round that takes the state further for some episodes."""

from __future__ import annotations

from dataclasses import dataclass, fields, is_dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

import numpy as np

from bbsd.solver.space import Designs

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from bbsd.solver.arena import Arena
    from bbsd.solver.champions import Champions

    Arrays = dict[str, NDArray[Any]]

S = TypeVar("S")

GROWING = frozenset({
    "tables", "structures", "fitness", "memes", "pools", "running", "gains", "squares", "tried",
    "tried_tables", "tried_structures",
})  # fmt: skip
"""Fields whose arrays may have more or fewer rows than before the first round; all others keep their shapes."""


@dataclass(frozen=True, eq=False, kw_only=True)
class SearchState:
    """What every method keeps; a method adds fields that are arrays, whole numbers, floats, or such states."""

    round: int = 0
    """Rounds so far; it names the random streams of the next one."""
    spent: int = 0
    """Episodes so far."""
    champions: Champions
    """The best designs met, with the mean of the few episodes that each had: mostly too high."""


class Method(NamedTuple):
    """A way to search for designs."""

    name: str
    begin: Callable[[Arena, int, int], Any]
    """Return the state before the first round, given the arena, the key of its streams and the budget.

    It spends nothing.
    """
    advance: Callable[[Any, Arena, int, int], Any]
    """Return the state after one more round, given the state, the arena, the key and the budget in all.

    A round spends at least one episode, and never more than what is left of the budget.
    """


def with_champions(champions: Champions, designs: Designs, fitness: NDArray[np.float64]) -> Champions:
    """Return the champions after designs were met with a mean return each, (n_designs,)."""
    tables = np.concatenate([champions.tables, designs.tables])
    structures = np.concatenate([champions.structures, designs.structures])
    values = np.concatenate([champions.fitness, fitness])
    order = np.argsort(-values, kind="stable")
    ordered = Designs(tables[order], structures[order])
    kept = ordered.distinct()[: champions.capacity]
    return replace(
        champions,
        tables=ordered.tables[kept],
        structures=ordered.structures[kept],
        fitness=values[order][kept],
    )


def arrays_of(state: object, prefix: str = "") -> Arrays:
    """Return a state as named arrays."""
    arrays: Arrays = {}
    for field in fields(state):  # type: ignore[arg-type]
        arrays |= _arrays_of_value(getattr(state, field.name), f"{prefix}{field.name}")
    return arrays


def _arrays_of_value(value: object, name: str) -> Arrays:
    if is_dataclass(value):
        return arrays_of(value, f"{name}.")
    if isinstance(value, tuple):
        parts = [_arrays_of_value(item, f"{name}.{index}") for index, item in enumerate(value)]
        return {key: array for part in parts for key, array in part.items()}
    return {name: np.asarray(value)}


def restored(template: S, arrays: Arrays, prefix: str = "") -> S:
    """Return a state from its arrays, given one of the same method and problem, such as that before the first round.

    Raises:
        ValueError: an array is missing, or has another type or another shape than the template's; of those that
            grow, other rows.
    """
    values = {
        field.name: _restored_value(getattr(template, field.name), arrays, f"{prefix}{field.name}")
        for field in fields(template)  # type: ignore[arg-type]
    }
    return replace(template, **values)  # type: ignore[type-var]


def _is_member(name: str) -> bool:
    """Return whether an array is one of several in a field that grows, such as the second of the pools."""
    stem, _, index = name.rpartition(".")
    return index.isdecimal() and stem.rpartition(".")[2] in GROWING


def _restored_value(template: object, arrays: Arrays, name: str) -> object:
    if is_dataclass(template):
        return restored(template, arrays, f"{name}.")
    if isinstance(template, tuple):
        return tuple(_restored_value(item, arrays, f"{name}.{index}") for index, item in enumerate(template))
    expected = np.asarray(template)
    if name not in arrays:
        raise ValueError(f"{name} is missing")
    array = arrays[name]
    if array.dtype != expected.dtype or array.ndim != expected.ndim:
        raise ValueError(
            f"{name} is {array.dtype} in {array.ndim} dimensions, not {expected.dtype} in {expected.ndim}"
        )
    rows = 1 if name.rpartition(".")[2] in GROWING or _is_member(name) else 0
    if array.shape[rows:] != expected.shape[rows:]:
        raise ValueError(f"{name} is of the shape {array.shape}, not {expected.shape}")
    return array if isinstance(template, np.ndarray) else array.item()
