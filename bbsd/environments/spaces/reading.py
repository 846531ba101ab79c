"""From what an environment shows to the numbers of a spec's fields."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.environments.spaces.kinds import Box, Discrete, Mapping, MultiDiscrete, Several

if TYPE_CHECKING:
    from bbsd.environments.spaces.kinds import Space
    from bbsd.language.outside import Field, ObservationPath

Reader = Callable[[Any], Sequence[float]]
"""Returns the numbers of the used fields, in their order; raises WrongObservationError."""

MOST_TABULATED = 100_000
"""Values of a discrete observation up to which their digits are kept in a table."""


class WrongObservationError(Exception):
    """An observation that is not in the space that its environment names; the message says how."""


def reader_of(fields: Sequence[Field], space: Space) -> Reader:
    """Return what reads the fields of a spec from an observation; they must fit the space (see `matching`)."""
    if any(field.path is not None for field in fields):
        return _paths_reader(fields, space)
    if any(field.size is not None for field in fields) and isinstance(space, Discrete):
        return _digits_reader([field.size or 1 for field in fields], space, _used(fields))
    return _list_reader(space, _used(fields), [field.size for field in fields])


def flat(space: Space) -> Reader:
    """Return what lists all numbers of an observation in C order."""
    match space:
        case Mapping(parts):
            inner = [(key, flat(part)) for key, part in parts]
            return lambda value: [number for key, read in inner for number in read(value[key])]
        case Several(several):
            each = [flat(part) for part in several]
            return lambda value: [
                number for read, part in zip(each, value, strict=True) for number in read(part)
            ]
        case Box(shape) | MultiDiscrete(shape=shape) if shape:
            return lambda value: _numbers(value, shape)
    return lambda value: (float(value),)


def digits(value: int, sizes: Sequence[int]) -> tuple[int, ...]:
    """Return the digits of a number in mixed radix, the first the most significant."""
    found = []
    for size in reversed(sizes):
        value, digit = divmod(value, size)
        found.append(digit)
    return tuple(reversed(found))


def _used(fields: Sequence[Field]) -> list[int] | None:
    """Return the indices of the fields that have names; None where all have."""
    used = [index for index, field in enumerate(fields) if field.is_used]
    return None if len(used) == len(fields) else used


def _numbers(value: object, shape: tuple[int, ...]) -> Sequence[float]:
    array = value if isinstance(value, np.ndarray) else np.asarray(value, np.float64)
    if array.shape != shape:
        raise WrongObservationError(f"an observation has the shape {array.shape}, not {shape}")
    numbers: list[float] = array.ravel().tolist()
    return numbers


def _list_reader(space: Space, used: list[int] | None, sizes: Sequence[int | None]) -> Reader:
    read_all = flat(space)
    if used is None and not any(sizes):
        return read_all
    sized = [(index, size) for index, size in enumerate(sizes) if size is not None]

    def read(value: object) -> Sequence[float]:
        numbers = read_all(value)
        for index, size in sized:
            if numbers[index] not in range(size):
                raise WrongObservationError(
                    f"number {index + 1} of an observation is {numbers[index]:g}, not a whole number below {size}"
                )
        return [numbers[index] for index in (range(len(sizes)) if used is None else used)]

    return read


def _digits_reader(sizes: Sequence[int], space: Discrete, used: list[int] | None) -> Reader:
    def digits_of(number: int) -> tuple[float, ...]:
        found = digits(number, sizes)
        return tuple(float(found[index]) for index in (range(len(sizes)) if used is None else used))

    known = [digits_of(number) for number in range(space.n)] if space.n <= MOST_TABULATED else None

    def read(value: Any) -> Sequence[float]:  # noqa: ANN401 - whatever an environment shows
        number = int(value) - space.start
        if not 0 <= number < space.n or number + space.start != value:
            raise WrongObservationError(f"an observation is {value}, which is not in {space}")
        return digits_of(number) if known is None else known[number]

    return read


def _paths_reader(fields: Sequence[Field], space: Space) -> Reader:
    paths = [_subscripts(field.path or (), space) for field in fields if field.is_used]

    def read(value: Any) -> Sequence[float]:  # noqa: ANN401 - whatever an environment shows
        numbers = []
        for path in paths:
            part = value
            for subscript in path:
                part = part[subscript]
            numbers.append(float(part))
        return numbers

    return read


def _subscripts(path: ObservationPath, space: Space) -> tuple[object, ...]:
    """Return the subscripts that lead to a number: keys, places in tuples, and last all indices of an array at once."""
    found: list[object] = []
    for place, segment in enumerate(path):
        match space:
            case Mapping(parts):
                space = dict(parts)[str(segment)]
            case Several(several) if isinstance(segment, int):
                space = several[segment]
            case _:
                return (*found, path[place:])
        found.append(segment)
    return tuple(found)
