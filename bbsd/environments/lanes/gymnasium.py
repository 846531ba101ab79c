"""Environments with one robot: Gymnasium's, and classes of one's own that are called the same way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.environments.lanes.common import Lanes, checked_results, checked_start

if TYPE_CHECKING:
    from bbsd.environments.lanes.common import Row


class GymnasiumLanes(Lanes):
    """Steps an environment with `reset(seed=...)` and `step(action)` in each lane."""

    def _begin(self, lane: int, seed: int) -> Row:
        observation = checked_start(self._environments[lane].reset(seed=seed))
        return [*self.dealings.read(observation), 0.0, 0.0]

    def _advance(self, lane: int, command: list[float]) -> Row:
        dealings = self.dealings
        results = checked_results(self._environments[lane].step(dealings.send(command)))
        observation, reward, terminated, truncated, _ = results
        return [*dealings.read(observation), float(reward), float(terminated or truncated)]
