"""What an environment shows and takes, as plain data: its spaces, read without knowing whose classes they are."""

from __future__ import annotations

from dataclasses import dataclass
from math import prod
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.language.outside import ObservationPath

Floats = npt.NDArray[np.float64]
MOST_SHOWN = 6
"""Numbers of an array that a text shows."""


@dataclass(frozen=True, slots=True)
class Discrete:
    """A whole number from `start` to `start + n - 1`."""

    n: int
    start: int = 0

    def __str__(self) -> str:
        return f"Discrete({self.n})" if not self.start else f"Discrete({self.n}, start={self.start})"


@dataclass(frozen=True, slots=True)
class Box:
    """An array of numbers, each between bounds; `low` and `high` are flat, in C order."""

    shape: tuple[int, ...]
    low: tuple[float, ...]
    high: tuple[float, ...]
    dtype: str

    @property
    def size(self) -> int:
        """How many numbers it has."""
        return prod(self.shape)

    def __str__(self) -> str:
        return f"Box({_bounds_text(self.low)}, {_bounds_text(self.high)}, {self.shape}, {self.dtype})"


@dataclass(frozen=True, slots=True)
class MultiDiscrete:
    """An array of whole numbers, each from its `start` to `start + n - 1`; flat, in C order. A MultiBinary is one."""

    ns: tuple[int, ...]
    starts: tuple[int, ...]
    shape: tuple[int, ...]
    dtype: str = "int64"

    def __str__(self) -> str:
        if set(self.ns) == {2} and self.dtype == "int8":
            return f"MultiBinary({len(self.ns)})"
        starts = f", start={list(self.starts)}" if any(self.starts) else ""
        return f"MultiDiscrete({list(self.ns)}{starts})"


@dataclass(frozen=True, slots=True)
class Mapping:
    """Several spaces by their keys, in the order of the environment."""

    parts: tuple[tuple[str, Space], ...]

    def __str__(self) -> str:
        return f"Dict({', '.join(f'{key!r}: {part}' for key, part in self.parts)})"


@dataclass(frozen=True, slots=True)
class Several:
    """Several spaces, one after another."""

    parts: tuple[Space, ...]

    def __str__(self) -> str:
        return f"Tuple({', '.join(map(str, self.parts))})"


@dataclass(frozen=True, slots=True)
class Other:
    """A space that is not of numbers, such as texts and graphs."""

    name: str

    def __str__(self) -> str:
        return self.name


Space: TypeAlias = Discrete | Box | MultiDiscrete | Mapping | Several | Other


def space_of(space: Any) -> Space:  # noqa: ANN401 - whatever an environment calls its space
    """Return a space of Gymnasium as plain data; its kind is known by the name of its class or of one above."""
    kinds = {kind.__name__ for kind in type(space).__mro__}
    if "Discrete" in kinds:
        return Discrete(int(space.n), int(getattr(space, "start", 0)))
    if "Box" in kinds:
        low, high = (
            tuple(np.asarray(bound, np.float64).ravel().tolist()) for bound in (space.low, space.high)
        )
        return Box(tuple(map(int, space.shape)), low, high, np.dtype(space.dtype).name)
    if "MultiDiscrete" in kinds:
        ns = np.asarray(space.nvec)
        starts = np.broadcast_to(np.asarray(getattr(space, "start", 0)), ns.shape)
        return MultiDiscrete(_whole(ns), _whole(starts), ns.shape, np.dtype(space.dtype).name)
    if "MultiBinary" in kinds:
        shape = tuple(map(int, space.shape))
        return MultiDiscrete((2,) * prod(shape), (0,) * prod(shape), shape, "int8")
    if "Dict" in kinds:
        return Mapping(tuple((str(key), space_of(part)) for key, part in space.spaces.items()))
    if "Tuple" in kinds:
        return Several(tuple(map(space_of, space.spaces)))
    return Other(type(space).__name__)


def space_of_value(value: Any) -> Space:  # noqa: ANN401 - whatever an environment shows
    """Return the space that an observation suggests, where the environment names none: numbers without bounds."""
    if isinstance(value, dict):
        return Mapping(tuple((str(key), space_of_value(part)) for key, part in value.items()))
    try:
        array = np.asarray(value)
        is_numbers = array.dtype.kind in "biuf"
    except ValueError:  # arrays of several shapes
        is_numbers = False
    if not is_numbers:
        return (
            Several(tuple(map(space_of_value, value)))
            if isinstance(value, tuple)
            else Other(type(value).__name__)
        )
    unbounded = (np.inf,) * array.size
    return Box(array.shape, tuple(-bound for bound in unbounded), unbounded, array.dtype.name)


def leaves(space: Space, path: ObservationPath = ()) -> Iterator[tuple[ObservationPath, Space]]:
    """Yield the parts of a space that have no parts themselves, with the path that leads to each."""
    match space:
        case Mapping(parts):
            for key, part in parts:
                yield from leaves(part, (*path, key))
        case Several(parts):
            for index, part in enumerate(parts):
                yield from leaves(part, (*path, index))
        case _:
            yield path, space


def count(space: Space) -> int | None:
    """Return how many numbers a space has; None where not all of it are numbers."""
    match space:
        case Discrete():
            return 1
        case Box():
            return space.size
        case MultiDiscrete():
            return len(space.ns)
        case Mapping(parts):
            counts = [count(part) for _, part in parts]
        case Several(several):
            counts = [count(part) for part in several]
        case _:
            return None
    return None if None in counts else sum(filter(None, counts))


def is_one_number(space: Space) -> bool:
    """Say whether a space is a single number without a shape."""
    return isinstance(space, Discrete) or (isinstance(space, Box) and not space.shape)


def path_text(path: ObservationPath) -> str:
    """Return a path as a spec has it: image[3,5,0]."""
    text, indices = "", []
    for segment in (*path, ""):
        if isinstance(segment, int):
            indices.append(str(segment))
            continue
        text += f"[{','.join(indices)}]" if indices else ""
        indices = []
        text += f".{segment}" if text and segment else segment
    return text


def _whole(values: Any) -> tuple[int, ...]:  # noqa: ANN401 - an array of whole numbers
    return tuple(int(value) for value in np.asarray(values).ravel())


def _bounds_text(bounds: tuple[float, ...]) -> str:
    if len(set(bounds)) == 1:
        return f"{bounds[0]:.7g}"
    shown = [f"{bound:.7g}" for bound in bounds[:MOST_SHOWN]]
    return f"[{', '.join([*shown, *(['...'] if len(bounds) > MOST_SHOWN else [])])}]"
