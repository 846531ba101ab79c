"""A run in the smallest, so that everything it calls is compiled."""

from __future__ import annotations

from contextlib import suppress
from dataclasses import replace
from typing import TYPE_CHECKING

from bbsd.evaluation import RewardNotFinite
from bbsd.kernel.streams import name_word
from bbsd.solver.generation import initial_state, next_generation

if TYPE_CHECKING:
    from bbsd.compiler import Problem
    from bbsd.solver.settings import Settings

REHEARSAL = name_word("rehearsal")
AGENTS = 2
EPISODES = 2
"""The first is lived with the structure an agent is born with, the others with one that was searched for."""
GENERATIONS = 2
"""The first begins with random pools, the others with bred ones."""


def rehearse(problem: Problem, settings: Settings) -> None:
    """Call once whatever a run's generations compile. A reward that is not finite is left for the run to find."""
    small = in_the_smallest(settings)
    state = initial_state(problem, small, REHEARSAL)
    with suppress(RewardNotFinite):
        for _ in range(min(GENERATIONS, settings.coevolution.generations)):
            state, _ = next_generation(state, problem, small, REHEARSAL)


def in_the_smallest(settings: Settings) -> Settings:
    """The same settings for a few agents that live short lives."""
    evolved, learning = settings.coevolution, settings.learning
    population = min(AGENTS, evolved.population)
    lifetime = min(EPISODES, learning.lifetime)
    return replace(
        settings,
        coevolution=replace(
            evolved,
            population=population,
            agents=min(AGENTS, evolved.agents),
            elites=min(evolved.elites, population - 1),
        ),
        learning=replace(learning, lifetime=lifetime, last=min(learning.last, lifetime)),
    )
