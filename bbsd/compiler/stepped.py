"""A rollout whose environment is stepped in Python, between the phases of its kernel."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from bbsd.compiler.details import PHASES, Detail

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.environments.stepping import Stepper
    from bbsd.language.meaning import Meaning

Phase = Callable[..., bool | None]
"""Does a part of a rollout in one batch of lanes."""


class Phases(NamedTuple):
    """The functions of a rollout in phases."""

    start: Phase
    decide: Phase
    outcome: Phase
    finish: Phase


def phase_names(detail: Detail) -> tuple[str, ...]:
    """Return what the functions of a rollout in phases are called."""
    return tuple(f"{detail.value}_{phase}" for phase in PHASES)


def phases_of(module: Any, detail: Detail) -> Phases:  # noqa: ANN401 - a generated module
    """Return the phases of a rollout that a module was printed with."""
    return Phases(*(getattr(module, name) for name in phase_names(detail)))


class Between(NamedTuple):
    """What a batch keeps from phase to phase besides its memory: the last arguments of each phase."""

    outside: NDArray[np.float64]
    """What the environment gives, (n_outside, lanes)."""
    sent: NDArray[np.float64]
    """What it is given, (n_sent, lanes)."""
    chosen: NDArray[np.int64]
    """The number of the action that controls each robot, (n_robots, lanes)."""
    living: NDArray[np.float64]
    """1 while a lane's episode goes on, (lanes,)."""


def new_between(meaning: Meaning, lanes: int) -> Between:
    """Return what a batch of so many lanes begins with."""
    robots = meaning.spec.environment.robots
    outside, sent = (
        np.zeros((len(slots), lanes)) for slots in (meaning.episode.outside, meaning.episode.sent)
    )
    return Between(outside, sent, np.zeros((robots, lanes), np.int64), np.ones(lanes))


@dataclass(frozen=True)
class SteppedRollout:
    """Runs an episode in each lane; is called with the arguments of a whole rollout."""

    phases: Phases
    meaning: Meaning
    lanes: int
    stepper: Stepper

    def __call__(
        self, first: int, last: int, numbers: NDArray[np.float64], keys: NDArray[np.uint64], *arrays: object
    ) -> bool:
        """Run the lanes from `first` to before `last`, batch by batch, and return whether one is uncertain."""
        return any(
            self._run_batch(base, min(self.lanes, last - base), numbers, keys, *arrays)
            for base in range(first, last, self.lanes)
        )

    def _run_batch(
        self,
        base: int,
        n_agents: int,
        numbers: NDArray[np.float64],
        keys: NDArray[np.uint64],
        *arrays: object,
    ) -> bool:
        """Run a batch, of which only the lanes that have an agent and an episode that goes on are stepped."""
        start, decide, outcome, finish = self.phases
        between, alive = new_between(self.meaning, self.lanes), np.arange(n_agents)
        arguments = (numbers, keys, *arrays, *between)
        self.stepper.reset(alive, keys[base : base + self.lanes], between.outside)
        start(base, 0, *arguments)
        for step in range(1, self.meaning.spec.environment.steps + 1):
            decide(base, step, *arguments)
            self.stepper.step(alive, between.sent, between.outside)
            outcome(base, step, *arguments)
            alive = alive[between.living[alive] > 0.0]
            if not alive.size:
                break
        return bool(finish(base, 0, *arguments))
