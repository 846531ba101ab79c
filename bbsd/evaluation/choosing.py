"""The choice of an episode that is worth a look: the worst, the median, the best, or any by its number."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal, TypeAlias, get_args

import numpy as np

from bbsd.errors import UsageError

if TYPE_CHECKING:
    from numpy.typing import NDArray

Rank: TypeAlias = Literal["worst", "median", "best"]
"""An episode by its return among all."""
RANKS: tuple[Rank, ...] = get_args(Rank)


class NoSuchEpisode(UsageError):
    """An episode was asked for by a number that none has."""

    advice = "episodes are counted from 0"


def chosen_episode(returns: NDArray[np.float64], which: Rank | int) -> int:
    """Return the number of the worst, median or best of episodes with these returns (n,), or a given number.

    The median episode is the one whose return is nearest to the median. Of several the first counts.

    Raises:
        NoSuchEpisode: there is none with the given number.
    """
    if isinstance(which, int):
        if not 0 <= which < len(returns):
            raise NoSuchEpisode(f"there is no episode {which}: the last one is {len(returns) - 1}")
        return which
    match which:
        case "worst":
            return int(np.argmin(returns))
        case "best":
            return int(np.argmax(returns))
    return int(np.argmin(np.abs(returns - np.median(returns))))
