"""Environments whose agents act at the same time, PettingZoo's `ParallelEnv`: the agents are the robots."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.environments.lanes.common import Lanes, checked_results, checked_start
from bbsd.environments.spaces.reading import WrongObservationError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from bbsd.environments.lanes.common import Dealings, Row


class PettingZooLanes(Lanes):
    """Steps an environment with `agents`, `reset(seed=...)` and `step(actions)` in each lane.

    An agent that is done earns 0 from then on, keeps its last observation, and is sent nothing.
    """

    def __init__(self, dealings: Dealings) -> None:
        super().__init__(dealings)
        self._observed: dict[int, list[Sequence[float]]] = {}
        """Of each lane, what each robot observed last."""

    def _begin(self, lane: int, seed: int) -> Row:
        observations = checked_start(self._environments[lane].reset(seed=seed))
        missing = [agent for agent in self.dealings.agents if agent not in observations]
        if missing:
            raise WrongObservationError(f"the agent {missing[0]} has no observation at the start")
        read = self.dealings.read
        self._observed[lane] = [list(read(observations[agent])) for agent in self.dealings.agents]
        return self._row(lane, [0.0] * len(self.dealings.agents), ended=False)

    def _advance(self, lane: int, command: list[float]) -> Row:
        dealings, environment = self.dealings, self._environments[lane]
        robots, alive = len(dealings.agents), set(environment.agents)
        actions = {
            agent: dealings.send(command[robot::robots])
            for robot, agent in enumerate(dealings.agents)
            if agent in alive
        }
        observations, rewards, *_ = checked_results(environment.step(actions))
        earned = [float(rewards.get(agent, 0.0)) if agent in alive else 0.0 for agent in dealings.agents]
        for robot, agent in enumerate(dealings.agents):
            if agent in alive and agent in observations:
                self._observed[lane][robot] = list(dealings.read(observations[agent]))
        return self._row(lane, earned, ended=not environment.agents)

    def _row(self, lane: int, earned: list[float], *, ended: bool) -> Row:
        """Return what a lane is filled with: each field of all robots, what they earned, whether it is over."""
        fields = [number for numbers in zip(*self._observed[lane], strict=True) for number in numbers]
        return [*fields, *earned, float(ended)]
