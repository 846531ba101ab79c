"""Environments whose agents act at the same time, PettingZoo's `ParallelEnv`: the agents are the robots."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.environments.lanes.common import Lanes, checked_results, checked_start
from bbsd.environments.spaces.reading import WrongObservationError

if TYPE_CHECKING:
    from bbsd.environments.lanes.common import Floats


class PettingZooLanes(Lanes):
    """Steps an environment with `agents`, `reset(seed=...)` and `step(actions)` in each lane.

    An agent that is done earns 0 from then on, keeps its last observation, and is sent nothing.
    """

    def _begin(self, lane: int, seed: int, outside: Floats) -> None:
        observations = checked_start(self._environments[lane].reset(seed=seed))
        for robot, agent in enumerate(self.dealings.agents):
            if agent not in observations:
                raise WrongObservationError(f"the agent {agent} has no observation at the start")
            self._observe(robot, observations[agent], lane, outside)

    def _advance(self, lane: int, sent: Floats, outside: Floats) -> bool:
        dealings, environment = self.dealings, self._environments[lane]
        robots, alive = len(dealings.agents), set(environment.agents)
        commands = sent[:, lane].tolist()
        actions = {
            agent: dealings.send(commands[robot::robots])
            for robot, agent in enumerate(dealings.agents)
            if agent in alive
        }
        results = checked_results(environment.step(actions))
        observations, rewards, *_ = results
        earned = dealings.n_fields * robots
        for robot, agent in enumerate(dealings.agents):
            outside[earned + robot, lane] = float(rewards.get(agent, 0.0)) if agent in alive else 0.0
            if agent in alive and agent in observations:
                self._observe(robot, observations[agent], lane, outside)
        return not environment.agents

    def _observe(self, robot: int, observation: object, lane: int, outside: Floats) -> None:
        robots = len(self.dealings.agents)
        end = self.dealings.n_fields * robots
        outside[robot:end:robots, lane] = self.dealings.read(observation)
