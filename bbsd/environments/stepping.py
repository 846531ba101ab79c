"""What a rollout asks of an environment that is stepped in Python: to begin episodes, and to step them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Protocol

from bbsd.errors import UsageError

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray


class EnvironmentNotImported(UsageError):
    """Episodes of an environment that is stepped in Python, asked of what imports nothing for a spec."""

    advice = (
        "commands that run episodes import what a spec names with --allow-import NAME; "
        "in Python with allow_import=[NAME]"
    )


def not_imported(outside: object) -> EnvironmentNotImported:
    """Return the error of what is asked for episodes of an environment (a `language.outside.Outside`) it has not."""
    target = getattr(outside, "target", outside)
    return EnvironmentNotImported(f"episodes need the environment {target}, which was not imported")


class Stepper(Protocol):
    """Steps an environment of its own in each lane: an agent in an episode.

    Rows of `sent` and `outside` are those of the episode's `sent` and `outside`; a column belongs to a lane. Lanes are
    reset before they are first stepped, in any order and number, and again for their next episode. What a lane gives
    depends on its key and what was sent to it, on nothing else.
    """

    def reset(self, lanes: NDArray[np.int64], keys: NDArray[np.uint64], outside: NDArray[np.float64]) -> None:
        """Begin an episode in some lanes.

        Args:
            lanes: the columns to fill, (n,).
            keys: the key of each lane's episode, of all lanes, (n_lanes,); all that is random follows from it.
            outside: (n_outside, n_lanes); of these lanes it is filled with what is observed, 0 earned, 0 ended.
        """

    def step(self, lanes: NDArray[np.int64], sent: NDArray[np.float64], outside: NDArray[np.float64]) -> None:
        """Step some lanes, none of which has ended.

        Args:
            lanes: the columns to step, (n,).
            sent: what the robots do, (n_sent, n_lanes).
            outside: (n_outside, n_lanes); of these lanes it is filled with what is observed now, what the step earned,
                and 1 where the episode ended with it.
        """
