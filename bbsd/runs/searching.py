"""A run of any method but the paper's loop: rounds until a budget is spent, then a race.

A run may be given further budgets. Each has its own search and race, so the same sequence of budgets gives the same
bytes, however often the run was stopped.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.errors import UsageError
from bbsd.evaluation.sums import deviation, mean, row_means
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.runs.storage.state import RunState, Searching
from bbsd.solver.arena import Arena
from bbsd.solver.early import ENDINGS, NOT_ENDED, RETURN, TIME, UNIMPROVED, Measured, measured
from bbsd.solver.methods.q_learning.q_learning import TooManyJointCells
from bbsd.solver.methods.registry import METHODS
from bbsd.solver.search import ROUNDS, final_race, search_budget
from bbsd.solver.space import Designs, Space

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.solver.methods.method import Method
    from bbsd.solver.paper.settings import Settings

    Line = dict[str, Any]
    """A record of `metrics.jsonl`."""

MEASURED, CHOICE, FRESH = (name_word(name) for name in ("measured", "choice of the best", "fresh episodes"))

SEARCH, ANSWER = "search", "answer"
"""The stages of a run in its records: rounds, and the answer after a race."""

MEASURED_SHARE = 0.02
"""Of a budget, what the records' measurements take; it is taken from the race's part."""
RECORDS = 50
"""Records of a budget, at most."""
LEAST_MEASURED = 40
"""Episodes of a record's measurements; with a small budget there are fewer records instead."""
EARLY_RACE = 4_000
"""Episodes of the race of a search that ends early, at least: what was not spent is more than that."""
CHALLENGERS = 3
"""Champions that a record compares with the best so far."""


class UnsuitableMethod(UsageError):
    """A method that cannot search in the space of this spec."""

    advice = "choose another one, such as --set design.method=auto"


@dataclass(frozen=True)
class Course:
    """What a run is a run of."""

    problem: Problem
    settings: Settings
    key: int
    """The key of all its random streams."""
    run: int
    """Its number, from 0."""

    @cached_property
    def arena(self) -> Arena:
        """Where designs run their episodes."""
        generation, starts = self.settings.coevolution.generations, self.settings.starts
        drawn = None if starts is None else starts.drawn(Space(self.problem), self.key)
        return Arena(self.problem, generation, drawn)

    @property
    def method(self) -> Method:
        """The method that searches."""
        return METHODS[self.settings.method]

    @property
    def stream(self) -> int:
        """The key of the method's rounds."""
        return fold(self.key, ROUNDS)

    def start(self, budget: int) -> RunState:
        """Return the state of the run before its first round."""
        try:
            search = self.method.begin(self.arena, self.stream, search_budget(budget))
        except TooManyJointCells as error:
            raise UnsuitableMethod(
                f"the method {self.settings.method} cannot design this spec: {error}"
            ) from None
        champions = search.champions
        none = Designs(champions.tables[:0], champions.structures[:0])
        return RunState(self.run, Searching(search=search, best=none))

    def steps(
        self, reached: RunState, budgets: Sequence[int], deadline: float | None = None
    ) -> Iterator[tuple[RunState, Line | None]]:
        """Continue the run from the state it has reached until all budgets are spent.

        Yields the run's state after every round, with a line of metrics where the best so far was measured; and after
        every race, with its answer. Rounds end early where `design.stop` says so, and at the deadline, on the monotonic
        clock, where there is one.
        """
        state, answer = reached.state, reached.answer
        if not isinstance(state, Searching):
            raise TypeError("this state is of another method")
        while state.finished < len(budgets):
            budget = budgets[state.finished]
            limit = state.begun + search_budget(budget)
            plan = _Plan(budget)
            if state.search.spent == state.begun:
                state = replace(state, ended=NOT_ENDED, improved=state.begun)
            while state.search.spent < limit and not state.ended:
                search = self.method.advance(state.search, self.arena, self.stream, limit)
                state, line = replace(state, search=search), None
                if deadline is not None and time.monotonic() > deadline and search.spent < limit:
                    state = replace(state, ended=TIME)
                if search.spent - state.recorded >= plan.interval or search.spent >= limit or state.ended:
                    state, line = self._recorded(state, plan.allowance)
                    state = replace(state, ended=state.ended or self._ending(state, limit))
                yield RunState(self.run, state, answer), line
            left = _cut(state, budget) if state.ended else budget
            left -= (state.search.spent - state.begun) + state.measured + plan.allowance
            if state.ended in (RETURN, UNIMPROVED):
                whole = budget - (state.search.spent - state.begun) - state.measured - plan.allowance
                left = max(left, min(EARLY_RACE, whole))
            state, answer, line = self._raced(state, answer, left, plan.allowance)
            yield RunState(self.run, state, answer), line

    def _ending(self, state: Searching, limit: int) -> int:
        """Return why a search that has reached this record ends before its limit, by its number in `ENDINGS`.

        A budget beyond the first is wanted although the return may be enough.
        """
        stop, spent = self.settings.stop, state.search.spent
        if spent >= limit:
            return NOT_ENDED
        best = Measured(state.best_mean, state.best_squares, state.best_count)
        if stop.return_ is not None and not state.finished and best.low >= stop.return_:
            return RETURN
        if stop.unimproved is not None and spent - state.improved >= stop.unimproved:
            return UNIMPROVED
        return NOT_ENDED

    def _recorded(self, state: Searching, allowance: int) -> tuple[Searching, Line | None]:
        """Let the best so far and the fittest champions run common episodes, measure the better one, and record it."""
        stream = fold(fold(self.key, MEASURED), word_of(state.spent))
        champions = state.search.champions
        fittest = Designs(champions.tables[:CHALLENGERS], champions.structures[:CHALLENGERS])
        designs = state.best.joined(fittest)
        designs = designs[designs.distinct()]
        state = replace(state, recorded=state.search.spent)
        if not len(designs) or allowance < 1:
            return state, None
        each = allowance // 2 // len(designs) if len(designs) > 1 else 0
        best = 0
        if each:
            earned = self.arena.returns(designs, fold(stream, CHOICE), each)
            best = _better(earned, has_best=len(state.best) > 0)
        taken = each * len(designs)
        state = replace(state, measured=state.measured + taken)
        return self._measured(state, designs[best : best + 1], stream, max(1, allowance - taken))

    def _raced(
        self, state: Searching, answer: Architecture | None, episodes: int, allowance: int
    ) -> tuple[Searching, Architecture, Line]:
        """Let the former answer, the best so far, known designs and the champions race, and measure the winner."""
        first = state.best if answer is None else self.arena.space.designs([answer]).joined(state.best)
        if self.settings.starts is not None:
            first = first.joined(self.settings.starts.complete())
        finish = final_race(state.search, self.arena, self.key, episodes, first)
        stream = fold(fold(self.key, MEASURED), word_of(state.spent))
        state = replace(state, other=state.other + finish.spent)
        state, line = self._measured(state, finish.design, stream, max(1, allowance), ANSWER)
        spent = state.search.spent
        state = replace(
            state,
            finished=state.finished + 1,
            begun=spent,
            recorded=spent,
            other=state.other + state.measured,
            measured=0,
        )
        return state, self.arena.space.architectures(finish.design)[0], line

    def _measured(
        self, state: Searching, design: Designs, stream: int, count: int, stage: str = SEARCH
    ) -> tuple[Searching, Line]:
        """Measure a design on fresh episodes, and return the record of the best so far.

        In the search a design whose mean is below that of the best so far does not take its place.
        """
        now = measured(self.arena.returns(design, fold(stream, FRESH), count)[0])
        before = Measured(state.best_mean, state.best_squares, state.best_count)
        state, improved = replace(state, measured=state.measured + count), state.improved
        if _same(design, state.best):
            now = before.joined(now)
        elif stage == SEARCH and len(state.best) and now.mean < before.mean:
            design, now = state.best, before
        else:
            improved = state.search.spent
        state = replace(
            state,
            best=design,
            best_mean=now.mean,
            best_squares=now.squares,
            best_count=now.episodes,
            improved=improved,
        )
        names = self.problem.names
        return state, {
            "run": self.run + 1,
            "method": self.settings.method,
            "stage": stage,
            "episodes": state.spent,
            "mean": now.mean,
            "measured": now.episodes,
            "structure": [names[behavior] for behavior in reversed(design.structures[0])],
            **({"ended_by": ENDINGS[state.ended]} if stage == ANSWER and state.ended else {}),
        }


class _Plan:
    """How often the best so far is measured in a budget, and with how many episodes."""

    def __init__(self, budget: int) -> None:
        share = int(budget * MEASURED_SHARE)
        records = max(1, min(RECORDS, share // LEAST_MEASURED - 1))
        self.interval = -(-search_budget(budget) // records)
        self.allowance = share // (records + 1)


def _cut(state: Searching, budget: int) -> int:
    """Return the budget of which the rounds so far are the search's part."""
    spent = state.search.spent - state.begun
    return min(budget, spent * budget // max(1, search_budget(budget)))


def _better(earned: NDArray[np.float64], *, has_best: bool) -> int:
    """Return the index of the best by common episodes; the first stays best unless another is clearly better."""
    leader = int(np.argmax(row_means(earned)))
    if not has_best or leader == 0:
        return leader
    ahead = earned[leader] - earned[0]
    error = deviation(ahead) / np.sqrt(len(ahead)) if len(ahead) > 1 else np.inf
    return leader if mean(ahead) > error else 0


def _same(one: Designs, other: Designs) -> bool:
    return np.array_equal(one.tables, other.tables) and np.array_equal(one.structures, other.structures)
