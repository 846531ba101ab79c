"""From the values of a spec's actions to what an environment takes."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import isfinite
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.environments.spaces.kinds import Box, Discrete, MultiDiscrete, Several

if TYPE_CHECKING:
    from bbsd.environments.spaces.kinds import Space

Sender = Callable[[Sequence[float]], Any]
"""Returns the action that some values are, in the order of the spec's actions; raises WrongValueError."""


class WrongValueError(Exception):
    """A value that an environment does not take: its number among the actions, and what would be taken."""

    def __init__(self, index: int, value: float, taken: str) -> None:
        super().__init__(index, value, taken)
        self.index, self.value, self.taken = index, value, taken


def sender_of(space: Space | None, n_actions: int) -> Sender:
    """Return what makes an action of values.

    Whole numbers are sent as whole numbers and never rounded, arrays in the type of their space. Where the environment
    names no space, one value is sent as a float, several as an array of them.
    """
    if space is None:
        return (lambda values: values[0]) if n_actions == 1 else (lambda values: np.array(values, np.float64))
    if isinstance(space, Discrete):
        return _whole_sender(space)
    make = _maker(space)

    def send(values: Sequence[float]) -> Any:  # noqa: ANN401 - whatever an environment takes
        for index, value in enumerate(values):
            if not takes(space, index, value):
                raise WrongValueError(index, value, taken_text(space, index))
        return make(values)

    return send


def _whole_sender(space: Discrete) -> Sender:
    """Return what makes an action of the one whole number that is sent, as `takes` allows it."""
    first, end = space.start, space.start + space.n

    def send(values: Sequence[float]) -> int:
        value = values[0]
        if first <= value < end and value == (number := int(value)):
            return number
        raise WrongValueError(0, value, taken_text(space, 0))

    return send


def takes(space: Space, index: int, value: float) -> bool:
    """Say whether a value is taken as one of the values of an action."""
    match space:
        case Discrete(n, start):
            return start <= value < start + n and value == int(value)
        case Box(_, low, high, dtype):
            return _is_between(value, low[index], high[index], dtype)
        case MultiDiscrete(ns, starts):
            return takes(Discrete(ns[index], starts[index]), 0, value)
        case Several(parts):
            return takes(parts[index], 0, value)
    return True


def taken_text(space: Space, index: int) -> str:
    """Return in words what is taken as one of the values of an action."""
    match space:
        case Discrete(n, start):
            return f"a whole number from {start} to {start + n - 1}" if n > 1 else f"{start} alone"
        case Box(_, low, high, dtype):
            kind = "a whole number" if _is_whole(dtype) else "a number"
            return f"{kind} from {low[index]:.7g} to {high[index]:.7g}"
        case MultiDiscrete(ns, starts):
            return taken_text(Discrete(ns[index], starts[index]), 0)
        case Several(parts):
            return taken_text(parts[index], 0)
    return "a number"


def n_sent(space: Space | None) -> int | None:
    """Return how many values an action of a space has; None where the space is not known, 0 where it is no numbers."""
    match space:
        case None:
            return None
        case Discrete():
            return 1
        case Box():
            return space.size
        case MultiDiscrete():
            return len(space.ns)
        case Several(parts) if all(n_sent(part) == 1 for part in parts):
            return len(parts)
    return 0


def _is_whole(dtype: str) -> bool:
    return np.dtype(dtype).kind in "iub"


def _is_between(value: float, low: float, high: float, dtype: str) -> bool:
    """Say whether a finite value is between bounds, both included, once it has the type in which it is sent."""
    if not isfinite(value):
        return False
    if _is_whole(dtype):
        return low <= value <= high and value == int(value)
    with np.errstate(over="ignore"):
        sent = float(
            np.float64(value).astype(dtype)
        )  # a bound of 0.1 is another number in float32, and so is 0.1
    return isfinite(sent) and low <= sent <= high


def _maker(space: Space) -> Sender:
    match space:
        case Discrete():
            return lambda values: int(values[0])
        case Box(shape, dtype=dtype) | MultiDiscrete(shape=shape, dtype=dtype):
            return lambda values: np.array(values, dtype).reshape(shape)[()]
        case Several(parts):
            makers = [_maker(part) for part in parts]
            return lambda values: tuple(make([value]) for make, value in zip(makers, values, strict=True))
    raise TypeError(f"no action can be made for {space}")
