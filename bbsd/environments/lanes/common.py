"""An environment in each lane, stepped one after another in plain Python; what each kind of library does is below."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.environments.lanes.calling import calling
from bbsd.environments.lanes.time_limit import DEFAULT_LIMIT, CallWatch
from bbsd.environments.spaces.reading import WrongObservationError
from bbsd.kernel.streams import fold, name_word
from bbsd.stopping import raise_if_stopped

if TYPE_CHECKING:
    from collections.abc import Callable
    from contextlib import AbstractContextManager

    from numpy.typing import NDArray

    from bbsd.environments.spaces.reading import Reader
    from bbsd.environments.spaces.sending import Sender

    Integers = NDArray[np.int64]
    Keys = NDArray[np.uint64]
    Floats = NDArray[np.float64]

SEED = name_word("seed of an environment's episode")
SEED_BITS = 31
"""Bits of a seed: what every generator of random numbers takes, also where seeds are signed."""
RESULTS = 5
"""What a step returns: an observation, a reward, terminated, truncated, and what else there is to say."""


def seed_of(key: int) -> int:
    """Return the seed with which the episode of a key is begun."""
    return fold(key, SEED) >> (64 - SEED_BITS)


@dataclass(frozen=True)
class Dealings:
    """How lanes deal with an environment: how it is made, what is read of it, what is sent to it."""

    name: str
    make: Callable[[], Any]
    read: Reader
    send: Sender
    n_fields: int
    """Fields that have names."""
    actions: tuple[str, ...]
    agents: tuple[str, ...] = ()
    """The agents of a PettingZoo environment, which are the robots; none of others."""
    most_steps: int | None = None
    """Steps after which an episode is truncated, as its registration says."""
    seconds: float = DEFAULT_LIMIT
    """How long a call may take."""


Row = list[float]
"""What a lane is filled with: its column of `outside`."""


class Lanes:
    """Steps an environment of its own in each lane; made when the lane is first used."""

    def __init__(self, dealings: Dealings) -> None:
        self.dealings = dealings
        self._environments: dict[int, Any] = {}
        self._seeds: dict[int, int] = {}
        self._steps: dict[int, int] = {}
        self._watch = CallWatch(dealings.seconds)
        self._lane = -1

    def reset(self, lanes: Integers, keys: Keys, outside: Floats) -> None:
        """Begin an episode in some lanes, as `bbsd.environments.stepping.Stepper` says."""
        with self._calling():
            rows = [self._reset_lane(lane, seed_of(int(keys[lane]))) for lane in lanes.tolist()]
        if rows:
            outside[:, lanes] = np.array(rows, np.float64).T

    def step(self, lanes: Integers, sent: Floats, outside: Floats) -> None:
        """Step some lanes, as `bbsd.environments.stepping.Stepper` says."""
        with self._calling():
            commands = sent[:, lanes].T.tolist()
            rows = [
                self._step_lane(lane, command) for lane, command in zip(lanes.tolist(), commands, strict=True)
            ]
        if rows:
            outside[:, lanes] = np.array(rows, np.float64).T

    def _reset_lane(self, lane: int, seed: int) -> Row:
        self._lane, self._seeds[lane], self._steps[lane] = lane, seed, 0
        self._watch.calls += 1
        if lane not in self._environments:
            self._environments[lane] = self.dealings.make()
            self._watch.calls += 1
        return self._begin(lane, seed)

    def _step_lane(self, lane: int, command: list[float]) -> Row:
        self._lane = lane
        self._watch.calls += 1
        steps = self._steps[lane] = self._steps[lane] + 1
        row = self._advance(lane, command)
        if steps == self.dealings.most_steps:
            row[-1] = 1.0
        return row

    def _begin(self, lane: int, seed: int) -> Row:
        """Begin the episode of a seed in a lane's environment."""
        raise NotImplementedError

    def _advance(self, lane: int, command: list[float]) -> Row:
        """Step a lane's environment with what its robots do."""
        raise NotImplementedError

    def _calling(self) -> AbstractContextManager[None]:
        raise_if_stopped()
        return calling(self._where, self._watch, self.dealings.actions)

    def _where(self) -> str:
        steps, seed = self._steps.get(self._lane, 0), self._seeds.get(self._lane, 0)
        what = f"step {steps}" if steps else "the reset"
        return f"{self.dealings.name}, in {what} of an episode (seed {seed})"


def checked_results(results: Any) -> Any:  # noqa: ANN401 - whatever an environment returns
    """Return what a step returned; raise WrongObservationError where it is not five things."""
    if not isinstance(results, tuple) or len(results) != RESULTS:
        given = f"{len(results)} values" if isinstance(results, tuple) else type(results).__name__
        wanted = "observation, reward, terminated, truncated, info"
        raise WrongObservationError(f"step returned {given}, not five: {wanted}")
    return results


def checked_start(results: Any) -> Any:  # noqa: ANN401 - whatever an environment returns
    """Return the observation that a reset returned; raise WrongObservationError where it did not return two things."""
    if not isinstance(results, tuple) or len(results) != 2:
        given = f"{len(results)} values" if isinstance(results, tuple) else type(results).__name__
        raise WrongObservationError(f"reset returned {given}, not two: observation, info")
    return results[0]
