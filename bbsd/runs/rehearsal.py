"""A run as small as possible, so that everything a run calls is compiled."""

from __future__ import annotations

from contextlib import suppress
from typing import TYPE_CHECKING

from bbsd.evaluation import RewardNotFinite
from bbsd.kernel.streams import name_word
from bbsd.runs.searching import Course
from bbsd.solver.paper.generation import initial_state, next_generation

if TYPE_CHECKING:
    from bbsd.compiler import Problem
    from bbsd.solver.paper.settings import Settings

REHEARSAL = name_word("rehearsal")
AGENTS = 2
EPISODES = 2
"""The structure of the first is given to an agent, that of the second is searched for."""
REHEARSED = 100
"""Episodes of a search."""
GENERATIONS = 2
"""The first begins with random pools, the second with children."""


def rehearse(problem: Problem, settings: Settings) -> None:
    """Call everything that a run's generations compile. A reward that is not finite is left for the run to find."""
    if settings.method != "paper":
        _rehearse_search(problem, settings)
        return
    small = smallest(settings)
    state = initial_state(problem, small, REHEARSAL)
    with suppress(RewardNotFinite):
        for _ in range(min(GENERATIONS, settings.coevolution.generations)):
            state, _ = next_generation(state, problem, small, REHEARSAL)


def _rehearse_search(problem: Problem, settings: Settings) -> None:
    """Run the first rounds of a search with a few episodes."""
    course = Course(problem, settings, REHEARSAL, 0)
    with suppress(RewardNotFinite):
        state = course.method.begin(course.arena, course.stream, REHEARSED)
        while state.spent < REHEARSED:
            state = course.method.advance(state, course.arena, course.stream, REHEARSED)


def smallest(settings: Settings) -> Settings:
    """Return the settings for the smallest pools, agents and lifetimes in which everything happens."""
    population = min(AGENTS, settings.coevolution.population)
    elites = min(settings.coevolution.elites, population - 1)
    return settings.reduced(AGENTS, EPISODES, population=population, elites=elites)
