"""A lifetime (V.A): before each episode the agent chooses a structure.

After it the agent learns what that was worth.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.compiler import DetailedOutcome
from bbsd.evaluation import require_finite
from bbsd.kernel.keys import folded, units
from bbsd.kernel.streams import name_word
from bbsd.solver.estimates import no_counters
from bbsd.solver.structures import random_structures, search_exact, search_sampled, update_values
from bbsd.stopping import raise_if_stopped

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.evaluation import Agents
    from bbsd.solver.settings import Learning

EPISODE, SEARCH, EXPLORE = name_word("episode"), name_word("search"), name_word("explore")
WHETHER = name_word("whether")


@dataclass(frozen=True, slots=True, eq=False)
class Lifetimes:
    """What lifetimes left behind: returns (n_agents.

    N_episodes), final structures, Ṽ (n_agents, n_layers, n_behaviors).
    """

    returns: NDArray[np.float64]
    structures: NDArray[np.int64]
    values: NDArray[np.float64]


def run_lifetimes(
    problem: Problem, agents: Agents, keys: NDArray[np.uint64], generation: int, learning: Learning
) -> Lifetimes:
    """Let agents live side by side, each in the streams of its own key.

    The first episode is lived with the structure an agent is born with; the one returned is the last episode's.
    """
    team = problem.assemble(agents.pools, agents.members, generation)
    structures = agents.structures
    values = np.zeros((len(agents), structures.shape[1], problem.n_behaviors))
    counters = no_counters(*values.shape) if learning.estimate == "counters" else None
    returns = np.empty((len(agents), learning.lifetime))
    episodes, searches, explorations = (folded(keys, purpose) for purpose in (EPISODE, SEARCH, EXPLORE))
    for episode in range(1, learning.lifetime + 1):
        raise_if_stopped()
        if learning.learned and episode > 1:
            structures = choose(problem, folded(searches, episode), values, structures, learning)
            structures = explore(problem, explorations, structures, learning, episode)
        streams = folded(episodes, episode)
        outcome = (
            team.episode(streams, structures)
            if counters is None
            else team.detailed_episode(streams, structures)
        )
        where = f"generation {generation}, episode {episode}"
        require_finite(
            problem, agents.with_structures(structures), streams, outcome.returns, generation, where
        )
        rate = float(learning.rate[episode - 1])
        if isinstance(outcome, DetailedOutcome) and counters is not None:
            counters.update(structures, outcome.credit, outcome.control, rate)
            values = counters.joint()
        else:
            update_values(values, structures, outcome.credit, rate)
        returns[:, episode - 1] = outcome.returns
    return Lifetimes(returns, structures, values)


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


def explore(
    problem: Problem,
    keys: NDArray[np.uint64],
    structures: NDArray[np.int64],
    learning: Learning,
    episode: int,
) -> NDArray[np.int64]:
    """A random structure for some agents, with the probability of the episode, never in the last K episodes.

    The keys (n_agents,) are those of the agents' explorations in all episodes.
    """
    probability = float(learning.exploration[episode - 1])
    if probability == 0.0 or episode > learning.lifetime - learning.last:
        return structures
    streams = folded(keys, episode)
    explores = units(folded(streams, WHETHER)) < probability
    random = random_structures(streams, problem.layers, problem.candidates)
    return np.where(explores[:, None], random, structures)
