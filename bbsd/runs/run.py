"""A run of the paper's loop: generation after generation, then its answer."""

from __future__ import annotations

import time
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from bbsd.evaluation import agents_of, returns_of
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.language.meaning import seed_key
from bbsd.runs.storage import metrics
from bbsd.runs.storage.state import RunState
from bbsd.solver.answer import answer
from bbsd.solver.early import NOT_ENDED, RETURN, TIME, UNIMPROVED, measured
from bbsd.solver.paper.generation import State, initial_state, next_generation

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.compiler import Problem
    from bbsd.solver.paper.settings import Settings

RUNS, MEASURED = name_word("runs"), name_word("measured")
FRESH_EPISODES = 200
"""Episodes in which the fittest agent is measured where its fitness would be enough to stop."""


def run_key(seed: int, run: int) -> int:
    """Return the key of all random streams of a run, which counts from 0."""
    return fold(fold(seed_key(seed), RUNS), word_of(run))


def start(problem: Problem, settings: Settings, seed: int, run: int) -> RunState:
    """Return the state of a run before its first generation."""
    return RunState(run, initial_state(problem, settings, run_key(seed, run)))


def generations(
    reached: RunState, problem: Problem, settings: Settings, seed: int, deadline: float | None = None
) -> Iterator[tuple[RunState, dict[str, Any] | None]]:
    """Continue a run from the state it has reached to its end.

    Yields the run's state and the metrics after every generation; after the race for the run's answer, the state with
    the answer, and None. Generations end early where `design.stop` says so, and at the deadline, on the monotonic
    clock, where there is one.
    """
    run, state, key = reached.run, reached.state, run_key(seed, reached.run)
    if not isinstance(state, State):
        raise TypeError("this state is of another method")
    while state.generation < settings.coevolution.generations and not state.ended:
        state, census = next_generation(state, problem, settings, key)
        if state.generation < settings.coevolution.generations:
            state = replace(state, ended=_ending(state, problem, settings, key, deadline))
        yield RunState(run, state, census=census), metrics.line(run, state, census, problem)
    if reached.answer is None:
        yield RunState(run, state, answer(state, problem, settings, key)), None


def _ending(state: State, problem: Problem, settings: Settings, key: int, deadline: float | None) -> int:
    """Return why a run ends after a generation that is not its last, by its number in `ENDINGS`.

    The fittest agent so far, whose fitness is from the few episodes of its lifetime, is measured in new ones.
    """
    if deadline is not None and time.monotonic() > deadline:
        return TIME
    stop, champions = settings.stop, state.champions
    if stop.return_ is not None and champions.fitness[0] >= stop.return_:
        fresh = keys(fold(fold(key, MEASURED), word_of(state.generation)), 0, FRESH_EPISODES)
        fittest = agents_of(champions.architectures(problem)[:1])
        if measured(returns_of(problem, fittest, fresh, state.generation)[0]).low >= stop.return_:
            return RETURN
    episodes = settings.coevolution.agents * settings.learning.episodes
    waited = (state.generation - state.improved) * episodes
    return UNIMPROVED if stop.unimproved is not None and waited >= stop.unimproved else NOT_ENDED
