"""Why a run ends before its budget is spent: its return is enough, nothing got better, or its time is over."""

from __future__ import annotations

from math import sqrt
from typing import Literal, NamedTuple

import numpy as np

from bbsd.evaluation.sums import deviation, mean

EndedBy = Literal["", "return", "unimproved", "time"]
ENDINGS: tuple[EndedBy, ...] = ("", "return", "unimproved", "time")
"""By their numbers in a state; '' where a run has its whole budget."""
NOT_ENDED, RETURN, UNIMPROVED, TIME = range(len(ENDINGS))

QUANTILE = 1.96
"""Standard errors below the mean at which the 95 % interval begins."""
FEWEST = 30
"""Episodes in which a return is measured at least; in fewer, returns that are rare are not seen."""


class Measured(NamedTuple):
    """The mean return of a design in episodes that had no part in choosing it."""

    mean: float = 0.0
    squares: float = 0.0
    """The sum of the squared deviations from the mean."""
    episodes: int = 0

    def joined(self, other: Measured) -> Measured:
        """Return both measurements of the same design together (Chan, Golub and LeVeque 1979)."""
        episodes = self.episodes + other.episodes
        if not self.episodes:
            return other
        apart = self.mean - other.mean
        return Measured(
            (other.mean * other.episodes + self.mean * self.episodes) / episodes,
            self.squares + other.squares + apart**2 * (self.episodes * other.episodes / episodes),
            episodes,
        )

    @property
    def low(self) -> float:
        """Where the 95 % interval of the mean begins; -inf where there are too few episodes to tell."""
        if self.episodes < FEWEST:
            return -np.inf
        return self.mean - QUANTILE * sqrt(self.squares / (self.episodes - 1) / self.episodes)


def measured(returns: np.ndarray[tuple[int], np.dtype[np.float64]]) -> Measured:
    """Return what returns (n,) measure."""
    squares = deviation(returns) ** 2 * (len(returns) - 1) if len(returns) > 1 else 0.0
    return Measured(mean(returns), squares, len(returns))
