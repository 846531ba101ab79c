"""A lifetime (V.A): before each episode the agent chooses a structure.

After it the agent learns what that was worth.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation import require_finite
from bbsd.kernel.keys import folded
from bbsd.kernel.streams import name_word
from bbsd.solver.structures import search_exact, search_sampled, update_values

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.evaluation import Agents
    from bbsd.solver.settings import Learning

EPISODE, SEARCH = name_word("episode"), name_word("search")


@dataclass(frozen=True, slots=True, eq=False)
class Lives:
    """What lifetimes left behind: returns (n_agents.

    N_episodes), final structures, Ṽ (n_agents, n_layers, n_behaviors).
    """

    returns: NDArray[np.float64]
    structures: NDArray[np.int64]
    values: NDArray[np.float64]


def live(
    problem: Problem, agents: Agents, keys: NDArray[np.uint64], generation: int, learning: Learning
) -> Lives:
    """Let agents live side by side, each in the streams of its own key.

    The first episode is lived with the structure an agent is born with; the one returned is the last episode's.
    """
    team = problem.assemble(agents.pools, agents.members, generation)
    structures = agents.structures
    values = np.zeros((len(agents), structures.shape[1], problem.n_behaviors))
    returns = np.empty((len(agents), learning.lifetime))
    for episode in range(1, learning.lifetime + 1):
        if learning.learned and episode > 1:
            structures = choose(problem, folded(folded(keys, SEARCH), episode), values, structures, learning)
        streams = folded(folded(keys, EPISODE), episode)
        outcome = team.episode(streams, structures)
        where = f"generation {generation}, episode {episode}"
        require_finite(problem, agents.living(structures), streams, outcome.returns, generation, where)
        update_values(values, structures, outcome.credit, float(learning.rate[episode - 1]))
        returns[:, episode - 1] = outcome.returns
    return Lives(returns, structures, values)


def choose(
    problem: Problem,
    keys: NDArray[np.uint64],
    values: NDArray[np.float64],
    structures: NDArray[np.int64],
    learning: Learning,
) -> NDArray[np.int64]:
    """The architecture T* that maximizes (9) by what each agent has learned so far."""
    if learning.search == "exact":
        return search_exact(values, structures, problem.layers, problem.candidates)
    return search_sampled(keys, values, structures, problem.layers, problem.candidates, learning.candidates)
