"""Agents that live side by side in the lanes of a kernel."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.compiler.tables import Pool, packed_tables, unpacked_tables
from bbsd.compiler.writing.arbitration import ACTION_BITS
from bbsd.kernel.memory import zeros

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.compiler.problem import Problem

    Rollout = Callable[..., bool | None]
    """Lives lanes; whether a comparison was uncertain, so that nothing counts."""

NEVER = -(1 << 40)
"""The priority of a behavior that is not in the structure."""

WORTH_A_THREAD = 100_000
"""Robot-steps that a thread must have to do: about half a millisecond."""

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Keys = npt.NDArray[np.uint64]


@dataclass(frozen=True, slots=True)
class Outcome:
    """An episode of every agent: returns (n_agents,).

    And credit (n_agents, n_behaviors + 1), the last column nobody's.
    """

    returns: Floats
    credit: Floats


@dataclass(frozen=True, slots=True)
class DetailedOutcome:
    """An episode of every agent in detail.

    returns (n,), credit (n, n_behaviors + 1), terms (n, n_terms) in the spec's order, control (n, n_behaviors + 1)
    robot-steps by behavior and nobody, steps_taken (n,), not_finite (n, n_places) steps in which a value was not
    finite, expectations_met (n, n_expectations) robot-steps in which a behavior with an expectation controlled and it
    held after them.
    """

    returns: Floats
    credit: Floats
    terms: Floats
    control: Floats
    steps_taken: Floats
    not_finite: Floats
    expectations_met: Floats


class Team:
    """Agents ready to live: their tables as the kernel reads them.

    Lanes refer to individuals, they do not copy them.
    """

    def __init__(
        self, problem: Problem, pools: tuple[Pool, ...], members: Integers, constants: Floats
    ) -> None:
        self.problem = problem
        self.size = len(members)
        padded = -(-self.size // problem.lanes) * problem.lanes
        self._individuals = np.zeros((problem.n_behaviors, padded), np.int64)
        self._individuals[:, : self.size] = members.T
        self._packed_tables = packed_tables(problem.tables, pools)
        self._cells, self._table_offsets = unpacked_tables(problem.tables, pools)
        self._constants = constants
        self._keys = np.zeros(padded, np.uint64)
        self._priorities = np.full((problem.n_behaviors, padded), NEVER, np.int64)
        actions = [0, *np.cumsum([table.n_actions for table in problem.tables])[:-1]]
        self._first_actions = np.array(actions, np.int64)
        self._uncertain = False  # it comes from what a spec says, so it is seldom one episode alone

    def episode(self, keys: Keys, structures: Integers) -> Outcome:
        """Live one episode: keys (n_agents,) name its streams, structures (n_agents, n_layers) order the behaviors."""
        if not self._uncertain:
            returns, credit = self._outputs(1)[0], self._outputs(self.problem.n_behaviors + 1)
            inputs = self._inputs(keys, structures)
            self._uncertain = self._live(self.problem.rollout, *inputs, returns, credit)
        if self._uncertain:
            detailed = self.detailed_episode(keys, structures)
            return Outcome(detailed.returns, detailed.credit)
        return Outcome(returns[: self.size], credit[:, : self.size].T)

    def detailed_episode(self, keys: Keys, structures: Integers) -> DetailedOutcome:
        """The same episode with everything that an evaluation reports."""
        arrays = self._detailed_outputs()
        self._live(self.problem.rollout_detailed, *self._inputs(keys, structures), *arrays)
        return DetailedOutcome(*(array.T[: self.size] for array in arrays))

    def traced_episode(
        self, rollout: Rollout, memory: int, key: int, structure: Integers, record: Floats
    ) -> int:
        """The first agent's episode by a rollout for one lane that notes every step into record; the steps taken.

        It works with so many numbers of memory.
        """
        keys, arrays = np.array([key], np.uint64), self._detailed_outputs()
        *_, steps_taken, _not_finite, _expectations_met = arrays
        inputs = self._inputs(np.resize(keys, self.size), np.resize(structure, (self.size, len(structure))))
        with np.errstate(all="ignore"):
            rollout(0, 1, zeros(memory), *inputs, *arrays, record)
        return int(steps_taken[0])

    def _detailed_outputs(self) -> list[Floats]:
        """Zeros for what a detailed rollout writes, in the order of its arguments."""
        episode, who = self.problem.meaning.episode, self.problem.n_behaviors + 1
        lanes, rows = (self._keys.size,), (who, len(episode.reward), who)
        shapes = [lanes, *((n, *lanes) for n in rows), lanes]
        shapes += [(len(self.problem.places), *lanes), (len(episode.expects), *lanes)]
        return [np.zeros(shape) for shape in shapes]

    def _live(self, rollout: Rollout, *arrays: object) -> bool:
        """Run all lanes, in several threads where that is worth it: a kernel does not hold the interpreter's lock.

        Return whether a comparison was uncertain, so that nothing that was written counts.
        """
        spans, memory = self._spans(), self.problem.memory
        if len(spans) == 1:
            return bool(rollout(*spans[0], zeros(memory), *arrays))
        uncertain = self.problem.threads.map(lambda span: rollout(*span, zeros(memory), *arrays), spans)
        return any(list(uncertain))

    def _spans(self) -> list[tuple[int, int]]:
        """Which lanes each thread runs, whole batches of them."""
        environment, lanes = self.problem.meaning.spec.environment, self.problem.lanes
        batches = self._keys.size // lanes
        worth = self._keys.size * environment.steps * environment.robots // WORTH_A_THREAD
        parts = max(1, min(self.problem.jobs, batches, worth))
        ends = [batches * part // parts * lanes for part in range(parts + 1)]
        return list(pairwise(ends))

    def _outputs(self, rows: int) -> Floats:
        return np.zeros((rows, self._keys.size))

    def _inputs(self, keys: Keys, structures: Integers) -> tuple[object, ...]:
        self._keys[: self.size] = keys
        self._set_priorities(structures)
        return (
            self._keys,
            self._individuals,
            self._packed_tables,
            self._cells,
            self._table_offsets,
            self._priorities,
            self._constants,
        )

    def _set_priorities(self, structures: Integers) -> None:
        """Higher layers bid higher; what is added makes of a choice the action's number over all behaviors."""
        self._priorities[:] = NEVER
        layers = np.arange(1, structures.shape[1] + 1)[:, np.newaxis] << ACTION_BITS
        behaviors = structures.T
        self._priorities[behaviors, np.arange(self.size)] = layers + self._first_actions[behaviors]
