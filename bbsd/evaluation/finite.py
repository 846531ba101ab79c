"""Reinforcement that is not finite: an error that names the term, the step and the robot."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.evaluation.tracing.tracing import trace

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
    episode: str
    """The generation and episode, or the episode of an evaluation."""

    def __str__(self) -> str:
        quantity = f"the reward term {self.term}" if self.term else "the sum of all rewards"
        return f"{quantity} was {self.value} in step {self.step} for robot {self.robot} ({self.episode})"


def require_finite(
    problem: Problem,
    agents: Agents,
    keys: npt.NDArray[np.uint64],
    returns: npt.NDArray[np.float64],
    generation: int,
    episode: str = "",
) -> None:
    """Raise RewardNotFinite if any return (n_agents,) is not finite, and name the term by tracing the episode again."""
    if np.isfinite(returns).all():
        return
    agent = int(np.flatnonzero(~np.isfinite(returns))[0])
    traced = trace(problem, agents.architecture(agent), int(keys[agent]), generation)
    where = episode or f"episode {agent + 1} of those evaluated"
    for term, robots in traced.rewards.items():
        for robot, values in enumerate(robots):
            steps = np.flatnonzero(~np.isfinite(values))
            if steps.size:
                raise RewardNotFinite(term, float(values[steps[0]]), int(steps[0]) + 1, robot, where)
    raise RewardNotFinite("", float(returns[agent]), len(traced.steps), 0, where)
