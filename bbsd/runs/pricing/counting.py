"""How long the episodes of a sample lasted, where an environment is stepped in Python: there time goes by steps."""

from __future__ import annotations

from dataclasses import dataclass
from time import process_time
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    from numpy.typing import NDArray

    from bbsd.environments.stepping import Stepper


@dataclass(slots=True)
class Counter:
    """Episodes that were begun, the steps of all of them, and the processor seconds of their beginnings."""

    episodes: int = 0
    steps: int = 0
    beginning: float = 0.0

    def clear(self) -> None:
        """Count from here on."""
        self.episodes, self.steps, self.beginning = 0, 0, 0.0

    @property
    def length(self) -> float:
        """The mean length of an episode, in steps."""
        return self.steps / max(self.episodes, 1)

    def stretched(self, seconds: float, length: float) -> float:
        """Return the seconds that the same episodes would take if each lasted so many steps."""
        return self.beginning + max(seconds - self.beginning, 0.0) * max(length / max(self.length, 1.0), 1.0)

    def counted(self, stepper: Callable[[], Stepper]) -> Callable[[], Stepper]:
        """Return what makes the same steppers, which are counted."""
        return lambda: _Counted(stepper(), self)


class _Counted:
    """A stepper that is counted."""

    def __init__(self, stepper: Stepper, counter: Counter) -> None:
        self._stepper, self._counter = stepper, counter

    def reset(self, lanes: NDArray[np.int64], keys: NDArray[np.uint64], outside: NDArray[np.float64]) -> None:
        """Begin episodes."""
        began = process_time()
        self._stepper.reset(lanes, keys, outside)
        self._counter.beginning += process_time() - began
        self._counter.episodes += len(lanes)

    def step(self, lanes: NDArray[np.int64], sent: NDArray[np.float64], outside: NDArray[np.float64]) -> None:
        """Step some of them."""
        self._counter.steps += len(lanes)
        self._stepper.step(lanes, sent, outside)
