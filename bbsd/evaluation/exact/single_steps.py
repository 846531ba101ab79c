"""All states that a design can come to where its environment steps by a table, and what each step leads to."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import product
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from bbsd.compiler import compile_meaning
from bbsd.compiler.tabulated import START
from bbsd.compiler.team import Team
from bbsd.evaluation.exact.enumeration import MAX_STARTS, NotEnumerable, values_of_draw
from bbsd.evaluation.exact.one_step import STATES, STEP, one_step_of
from bbsd.expression.graph import evaluate, needed

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.compiler import DetailedOutcome, Problem
    from bbsd.environments.tables import TransitionTable
    from bbsd.evaluation.exact.one_step import OneStep
    from bbsd.expression.graph import Node

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]

WORTH_COMPILING = 40_000
"""Steps in plain Python that take as long as compiling, a few seconds."""
MOST_STATES = 200_000
"""States that are explored at most."""


@dataclass(frozen=True, slots=True, eq=False)
class Steps:
    """All steps from all states that can be reached: a row for each state, in it for each choice, for each chance."""

    starts: Floats
    """The probability that an episode begins in a state, (n_states,)."""
    n_choices: int
    targets: Integers
    """The state after a step, -1 where the episode is over, at the latest after the last step; (n_rows,)."""
    probabilities: Floats
    """Of the chance, given state and choice; (n_rows,)."""
    terms: Floats
    """(n_rows, n_terms), in the spec's order."""
    control: Floats
    """(n_rows, n_behaviors + 1), 1 for the behavior in control, or for nobody, the last one."""
    met: Floats
    """(n_rows, n_expectations), 1 where the behavior in control had its expectation met."""

    @property
    def origins(self) -> Integers:
        """The state before each step, (n_rows,)."""
        return np.repeat(np.arange(len(self.starts)), len(self.targets) // len(self.starts))


def steps_of(
    problem: Problem, table: TransitionTable, generation: int, architecture: Architecture | None = None
) -> Steps:
    """Return all steps of a design; without one, those of every choice in every state.

    Raises NotEnumerable where there are too many states, or chance has endlessly many possibilities.
    """
    return _Explorer(problem, table, generation, architecture).steps()


@dataclass
class _Explorer:
    """Goes from state to state until no new one is found."""

    problem: Problem
    table: TransitionTable
    generation: int
    architecture: Architecture | None
    _numbers: dict[bytes, int] = field(default_factory=dict)
    """The states that were found, by their values."""
    _found: list[Floats] = field(default_factory=list)
    _taken: int = 0

    @cached_property
    def _one_step(self) -> OneStep:
        return one_step_of(self.problem.meaning, self.table, decided=self.architecture is not None)

    def steps(self) -> Steps:
        """Return all steps."""
        starts, weights = self._starts()
        first = self._numbered(starts)
        outcomes: list[DetailedOutcome] = []
        targets: list[Integers] = []
        done = 0
        for _ in range(self.problem.meaning.spec.environment.steps):
            newest = len(self._found)
            for first_state in range(done, newest, STATES):
                outcome = self._step(np.array(self._found[first_state : min(first_state + STATES, newest)]))
                targets.append(self._targets(outcome.terms))
                outcomes.append(outcome)
            done = newest
            if done == len(self._found):
                break
        reached = np.concatenate(targets)
        reached[reached >= done] = -1  # only after the last step: nothing follows there
        terms = np.concatenate([outcome.terms for outcome in outcomes])
        n_terms = len(self.problem.meaning.episode.reward)
        return Steps(
            np.bincount(first, weights, done).astype(np.float64),
            self._one_step.n_choices,
            reached,
            terms[:, n_terms],
            terms[:, :n_terms],
            np.concatenate([outcome.control for outcome in outcomes]),
            np.concatenate([outcome.expectations_met for outcome in outcomes]),
        )

    def _starts(self) -> tuple[Floats, Floats]:
        """Return states that an episode may begin in (n, n_slots), and their probabilities (n,)."""
        start, slots = self.problem.meaning.episode.start, self._one_step.slots
        nodes = [start[slot] for slot in slots if slot != STEP]
        draws = [node for node in needed(nodes) if node.operation == "draw"]
        values = [self._values_at_start(draw) for draw in draws]
        if prod(map(len, values)) > MAX_STARTS:
            raise NotEnumerable(f"there are {prod(map(len, values))} starts; at most {MAX_STARTS} are tried")
        constants = self.problem.meaning.constants.vector(self.generation)
        states, weights = [], []
        for drawn in product(*values):
            known = {draw.number: value for draw, (value, _) in zip(draws, drawn, strict=True)}

            def leaf(node: Node, operands: list[Any], known: dict[int, float] = known) -> Any:  # noqa: ANN401
                return known[node.number] if node.operation == "draw" else node.read(constants, operands)

            found = [float(value) for value in evaluate(nodes, leaf)]
            states.append([*found, 0.0] if STEP in slots else found)
            weights.append(prod(weight for _, weight in drawn))
        return np.array(states), np.array(weights)

    def _values_at_start(self, draw: Node) -> list[tuple[float, float]]:
        """Return the values that a draw may have, and their probabilities."""
        if draw.draw.word == START:
            states, cumulative = self.table.first_states
            least = [0.0, *cumulative[:-1].tolist()]
            return [*zip(least, self.table.starts[states].tolist(), strict=True)]
        first, probabilities = values_of_draw(draw, self.problem.meaning.constants)
        return [(first + place, weight) for place, weight in enumerate(probabilities) if weight > 0.0]

    def _step(self, states: Floats) -> DetailedOutcome:
        """Take all steps from some states."""
        one_step, n = self._one_step, len(states)
        lanes = n * one_step.n_choices * one_step.n_chances
        self._taken += lanes
        problem = self._compiled if self._taken > WORTH_COMPILING else self._plain
        architecture = self.architecture
        if architecture is None:
            pools = tuple(np.zeros((1, shape.n_cells), np.uint8) for shape in problem.tables)
            structure = np.arange(problem.n_behaviors)
        else:
            pools, structure = tuple(table[None] for table in architecture.tables), architecture.structure
        constants = np.array(one_step.meaning.constants.vector(self.generation), np.float64)
        constants[one_step.first :].reshape(-1, STATES)[:, :n] = states.T
        members = np.zeros((lanes, problem.n_behaviors), np.int64)
        team = Team(problem.kernels, pools, members, constants)
        outcome = team.detailed_episode(np.arange(lanes, dtype=np.uint64), np.tile(structure, (lanes, 1)))
        if not np.isfinite(outcome.terms).all():
            raise NotEnumerable("a value is infinite or not a number")
        return outcome

    @cached_property
    def _plain(self) -> Problem:
        return compile_meaning(self._one_step.meaning, compiled=False)

    @cached_property
    def _compiled(self) -> Problem:
        return compile_meaning(self._one_step.meaning)

    def _targets(self, terms: Floats) -> Integers:
        """Return the number of the state after each step, -1 where the episode is over or the step never happens."""
        n_terms = len(self.problem.meaning.episode.reward)
        probabilities, over = terms[:, n_terms], terms[:, n_terms + 1]
        targets = np.full(len(terms), -1)
        goes_on = (probabilities > 0.0) & (over == 0.0)
        targets[goes_on] = self._numbered(terms[goes_on][:, n_terms + 2 :])
        return targets

    def _numbered(self, states: Floats) -> Integers:
        """Return the numbers of states (n, n_slots); new ones get the next."""
        numbers = []
        for state in np.ascontiguousarray(states) + 0.0:  # so that both zeros are one
            key = state.tobytes()
            if key not in self._numbers:
                if len(self._found) == MOST_STATES:
                    raise NotEnumerable(
                        f"there are more than {MOST_STATES} states, with all that is remembered"
                    )
                self._numbers[key] = len(self._found)
                self._found.append(state)
            numbers.append(self._numbers[key])
        return np.array(numbers, np.int64)
