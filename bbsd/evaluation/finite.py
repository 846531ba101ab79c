"""Reinforcement that is not finite: an error of the run that names the term, the step and the robot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.evaluation.tracing import trace

if TYPE_CHECKING:
    from bbsd.compiler import Problem
    from bbsd.evaluation.agents import Agents


@dataclass
class RewardNotFinite(Exception):
    """A reward term was infinite or not a number."""

    term: str
    """Empty where each term was finite and only their sum was not."""
    value: float
    step: int
    robot: int
    place: str
    """Where in the run: the generation, the agent, the episode."""

    def __str__(self) -> str:
        what = f"the reward term {self.term}" if self.term else "the sum of all rewards"
        return f"{what} was {self.value} in step {self.step} for robot {self.robot} ({self.place})"


def require_finite(
    problem: Problem,
    agents: Agents,
    keys: npt.NDArray[np.uint64],
    returns: npt.NDArray[np.float64],
    generation: int,
    place: str = "",
) -> None:
    """Raise RewardNotFinite if a return (n_agents,) is not finite: then some reinforcement in it was not."""
    if np.isfinite(returns).all():
        return
    agent = int(np.flatnonzero(~np.isfinite(returns))[0])
    traced = trace(problem, agents.architecture(agent), int(keys[agent]), generation)
    where = place or f"episode {agent + 1} of those evaluated"
    for term, robots in traced.rewards.items():
        for robot, values in enumerate(robots):
            odd = np.flatnonzero(~np.isfinite(values))
            if odd.size:
                raise RewardNotFinite(term, float(values[odd[0]]), int(odd[0]) + 1, robot, where)
    raise RewardNotFinite("", float(returns[agent]), len(traced.steps), 0, where)
