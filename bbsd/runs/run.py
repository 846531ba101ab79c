"""A run of the paper's loop: generation after generation, then its answer."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.language.meaning import seed_key
from bbsd.runs.storage import metrics
from bbsd.runs.storage.state import RunState
from bbsd.solver.answer import answer
from bbsd.solver.paper.generation import State, initial_state, next_generation

if TYPE_CHECKING:
    from collections.abc import Iterator

    from bbsd.compiler import Problem
    from bbsd.solver.paper.settings import Settings

RUNS = name_word("runs")


def run_key(seed: int, run: int) -> int:
    """Return the key of all random streams of a run, which counts from 0."""
    return fold(fold(seed_key(seed), RUNS), word_of(run))


def start(problem: Problem, settings: Settings, seed: int, run: int) -> RunState:
    """Return the state of a run before its first generation."""
    return RunState(run, initial_state(problem, settings, run_key(seed, run)))


def generations(
    reached: RunState, problem: Problem, settings: Settings, seed: int
) -> Iterator[tuple[RunState, dict[str, Any] | None]]:
    """Continue a run from the state it has reached to its end.

    Yields the run's state and the metrics after every generation; after the race for the run's answer, the state with
    the answer, and None.
    """
    run, state, key = reached.run, reached.state, run_key(seed, reached.run)
    if not isinstance(state, State):
        raise TypeError("this state is of another method")
    while state.generation < settings.coevolution.generations:
        state, census = next_generation(state, problem, settings, key)
        yield RunState(run, state, census=census), metrics.line(run, state, census, problem)
    if reached.answer is None:
        yield RunState(run, state, answer(state, problem, settings, key)), None
