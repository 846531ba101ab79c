"""A lifetime (V.A): before each episode an agent chooses a structure, after it the agent learns what it was worth."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation import require_finite
from bbsd.kernel.keys import folded, units
from bbsd.kernel.streams import name_word
from bbsd.solver.paper.differences import Differences
from bbsd.solver.paper.estimates import no_experience
from bbsd.solver.structures import random_structures, search_exact, search_sampled
from bbsd.stopping import raise_if_stopped

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.evaluation import Agents
    from bbsd.solver.paper.settings import Settings

EPISODE, SEARCH, EXPLORE = name_word("episode"), name_word("search"), name_word("explore")
WHETHER = name_word("whether")


@dataclass(frozen=True, slots=True, eq=False)
class Lifetimes:
    """What the lifetimes of agents leave behind.

    returns (n_agents, n_episodes), structures of the last episode (n_agents, n_layers), values Ṽ at the end (n_agents,
    n_layers, n_behaviors).
    """

    returns: NDArray[np.float64]
    structures: NDArray[np.int64]
    values: NDArray[np.float64]
    differences: NDArray[np.float64] | None = None
    """What an agent earns less in its last K episodes with each behavior held to No Action, (n_agents, n_behaviors).

    None where fitness is not shared by it.
    """


def run_lifetimes(
    problem: Problem, agents: Agents, keys: NDArray[np.uint64], generation: int, settings: Settings
) -> Lifetimes:
    """Run the lifetimes of agents side by side, each with the random streams of its own key (n_agents,).

    In the first episode an agent has the structure that it was given.
    """
    team = problem.assemble(agents.pools, agents.members, generation)
    incumbents = agents.structures
    estimate = no_experience(settings.learning, (*incumbents.shape, problem.n_behaviors))
    returns = np.empty((len(agents), settings.learning.episodes))
    differences = Differences(problem, agents, generation) if settings.sharing == "difference" else None
    episodes, searches, explorations = (folded(keys, purpose) for purpose in (EPISODE, SEARCH, EXPLORE))
    # For a lifetime do
    for episode in range(1, settings.learning.episodes + 1):
        raise_if_stopped()
        structures = incumbents
        # Select the architecture T* that maximizes (9); skip if it is fixed.
        if settings.learned and episode > 1:
            incumbents = choose(problem, folded(searches, episode), estimate.values, incumbents, settings)
            structures = explore(problem, explorations, incumbents, settings, episode)
        # Let the agent interact with the environment, receive reinforcement.
        streams = folded(episodes, episode)
        outcome = estimate.run_episode(team, streams, structures)
        present = agents.with_structures(structures)
        where = f"generation {generation}, episode {episode}"
        require_finite(problem, present, streams, outcome.returns, generation, where)
        returns[:, episode - 1] = outcome.returns
        # Update the estimates, (13), by the learning rate of the episode.
        estimate.update(structures, outcome, settings.rates.learning[episode - 1])
        if differences is not None and episode > settings.learning.episodes - settings.learning.last:
            differences.add(streams, structures, outcome.returns, where)
        if settings.learning.explored == "kept":
            incumbents = structures
    compared = None if differences is None else differences.means
    return Lifetimes(returns, structures, estimate.values, compared)


def choose(
    problem: Problem,
    keys: NDArray[np.uint64],
    values: NDArray[np.float64],
    structures: NDArray[np.int64],
    settings: Settings,
) -> NDArray[np.int64]:
    """Return the structure T* of each agent that maximizes (9) by the values it has learned, (n_agents, n_layers)."""
    if settings.learning.search == "exact":
        return search_exact(values, structures, problem.layers, problem.candidates)
    n_random = settings.learning.candidates
    return search_sampled(keys, values, structures, problem.layers, problem.candidates, n_random)


def explore(
    problem: Problem,
    keys: NDArray[np.uint64],
    structures: NDArray[np.int64],
    settings: Settings,
    episode: int,
) -> NDArray[np.int64]:
    """Replace structures by random ones with the probability of the episode, but never in the last K episodes.

    The keys (n_agents,) are those of the agents' explorations in all episodes.
    """
    probability = settings.rates.exploration[episode - 1]
    if probability == 0.0 or episode > settings.learning.episodes - settings.learning.last:
        return structures
    streams = folded(keys, episode)
    explores = units(folded(streams, WHETHER)) < probability
    random = random_structures(streams, problem.layers, problem.candidates)
    return np.where(explores[:, None], random, structures)
