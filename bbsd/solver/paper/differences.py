"""What each behavior is worth to an agent: what the agent earns less where that behavior is held to No Action."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation import require_finite
from bbsd.stopping import raise_if_stopped

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.evaluation import Agents


class Differences:
    """The sums of these differences over episodes, which run again for each behavior that evolves."""

    def __init__(self, problem: Problem, agents: Agents, generation: int) -> None:
        self._problem, self._generation = problem, generation
        self._held = {
            behavior: agents.held(behavior)
            for behavior in range(problem.n_behaviors)
            if problem.evolves(behavior)
        }
        self._teams = {
            behavior: problem.assemble(held.pools, held.members, generation)
            for behavior, held in self._held.items()
        }
        self._sums = np.zeros((len(agents), problem.n_behaviors))
        self._episodes = 0

    def add(
        self,
        keys: NDArray[np.uint64],
        structures: NDArray[np.int64],
        returns: NDArray[np.float64],
        where: str,
    ) -> None:
        """Run an episode again with each behavior held to No Action.

        Args:
            keys: name the episode's random streams, (n_agents,).
            structures: (n_agents, n_layers).
            returns: what the agents earned in it, (n_agents,).
            where: the episode in words, for a reward that is not finite.
        """
        self._episodes += 1
        for behavior, team in self._teams.items():
            raise_if_stopped()
            if not np.any(structures == behavior):
                continue
            without = team.episode(keys, structures).returns
            held = self._held[behavior].with_structures(structures)
            place = f"{where}, {self._problem.names[behavior]} held to No Action"
            require_finite(self._problem, held, keys, without, self._generation, place)
            self._sums[:, behavior] += returns - without

    @property
    def means(self) -> NDArray[np.float64]:
        """The mean differences of an episode, (n_agents, n_behaviors); 0 for behaviors that do not evolve."""
        return self._sums / self._episodes
