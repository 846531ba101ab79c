"""Environments with one robot: Gymnasium's, and classes of one's own that are called the same way."""

from __future__ import annotations

from typing import TYPE_CHECKING

from bbsd.environments.lanes.common import Lanes, checked_results, checked_start

if TYPE_CHECKING:
    from bbsd.environments.lanes.common import Floats


class GymnasiumLanes(Lanes):
    """Steps an environment with `reset(seed=...)` and `step(action)` in each lane."""

    def _begin(self, lane: int, seed: int, outside: Floats) -> None:
        observation = checked_start(self._environments[lane].reset(seed=seed))
        outside[: self.dealings.n_fields, lane] = self.dealings.read(observation)

    def _advance(self, lane: int, sent: Floats, outside: Floats) -> bool:
        dealings = self.dealings
        action = dealings.send(sent[:, lane].tolist())
        results = checked_results(self._environments[lane].step(action))
        observation, reward, terminated, truncated, _ = results
        outside[: dealings.n_fields, lane] = dealings.read(observation)
        outside[dealings.n_fields, lane] = float(reward)
        return bool(terminated or truncated)
