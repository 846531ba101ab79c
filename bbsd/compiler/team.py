"""Agents side by side in the lanes of a kernel."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.compiler.details import checked_slots
from bbsd.compiler.tables import Pool, packed_tables, unpacked_tables
from bbsd.compiler.writing.arbitration import ACTION_BITS

if TYPE_CHECKING:
    from bbsd.compiler.kernels import Kernels, Rollout
    from bbsd.compiler.steps import Steps

NEVER = -(1 << 40)
"""The priority of a behavior that is not in the structure."""

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Keys = npt.NDArray[np.uint64]
Learn = Callable[["Steps", Floats], None]
"""Learns from the steps of a batch of lanes, and how many of them each lane took."""


@dataclass(frozen=True, slots=True)
class Outcome:
    """An episode of every agent.

    returns (n_agents,), and credit (n_agents, n_behaviors + 1), the last column nobody's.
    """

    returns: Floats
    credit: Floats


@dataclass(frozen=True, slots=True)
class DetailedOutcome:
    """An episode of every agent in detail.

    returns (n,), credit (n, n_behaviors + 1), terms (n, n_terms) in the spec's order, control (n, n_behaviors + 1)
    robot-steps by behavior and nobody, steps_taken (n,), not_finite (n, n_places + 1) steps in which a value was
    not finite, in the last column what decides a cell or an index, expectations_met (n, n_expectations) robot-steps
    in which a behavior with an expectation controlled and it held after them.
    """

    returns: Floats
    credit: Floats
    terms: Floats
    control: Floats
    steps_taken: Floats
    not_finite: Floats
    expectations_met: Floats


class Team:
    """Agents ready for episodes: their tables as the kernel reads them.

    Lanes refer to individuals, they do not copy them.
    """

    def __init__(
        self, kernels: Kernels, pools: tuple[Pool, ...], members: Integers, constants: Floats
    ) -> None:
        self.kernels = kernels
        self.size = len(members)
        self._n_behaviors = len(kernels.tables)
        padded = -(-self.size // kernels.lanes) * kernels.lanes
        self._individuals = np.zeros((self._n_behaviors, padded), np.int64)
        self._individuals[:, : self.size] = members.T
        self._packed_tables = packed_tables(kernels.tables, pools)
        self._cells, self._table_offsets = unpacked_tables(kernels.tables, pools)
        self._constants = constants
        self._keys = np.zeros(padded, np.uint64)
        self._priorities = np.full((self._n_behaviors, padded), NEVER, np.int64)
        actions = [0, *np.cumsum([table.n_actions for table in kernels.tables])[:-1]]
        self._first_actions = np.array(actions, np.int64)
        self._uncertain = False  # it comes from what a spec says, so it is seldom one episode alone

    def episode(self, keys: Keys, structures: Integers) -> Outcome:
        """Run one episode of each agent.

        Args:
            keys: name each episode's random streams, (n_agents,).
            structures: order the behaviors, lowest layer first, (n_agents, n_layers).
        """
        if not self._uncertain:
            returns, credit = self._outputs(1)[0], self._outputs(self._n_behaviors + 1)
            inputs = self._inputs(keys, structures)
            self._uncertain = self._run(self.kernels.rollout, *inputs, returns, credit)
        if self._uncertain:
            detailed = self.detailed_episode(keys, structures)
            return Outcome(detailed.returns, detailed.credit)
        return Outcome(returns[: self.size], credit[:, : self.size].T)

    def detailed_episode(self, keys: Keys, structures: Integers) -> DetailedOutcome:
        """Run the same episode and return everything that an evaluation reports."""
        arrays = self._detailed_outputs()
        self._run(self.kernels.rollout_detailed, *self._inputs(keys, structures), *arrays)
        return DetailedOutcome(*(array.T[: self.size] for array in arrays))

    def practice(
        self, keys: Keys, structures: Integers, rates: Floats, open_cells: Pool, learn: Learn
    ) -> Floats:
        """Run one episode of each agent that strays from its tables, and return the returns (n_agents,).

        Args:
            keys: name each episode's random streams, (n_agents,).
            structures: lowest layer first, (n_agents, n_layers).
            rates: how often a robot of each agent strays in a step, (n_agents,).
            open_cells: 1 where a cell may be strayed from, of all behaviors one after the other.
            learn: is given the steps of each batch of lanes, in the order of the agents.
        """
        returns, steps_taken, own_rates = np.zeros((3, self._keys.size))
        own_rates[: self.size] = rates
        before = (*self._inputs(keys, structures), returns, open_cells, own_rates)
        for steps in self.kernels.run_practice(self.size, before, (steps_taken,)):
            last = min(steps.first + self.kernels.lanes, self.size)
            learn(steps, steps_taken[steps.first : last])
        return returns[: self.size]

    def traced_episode(self, key: int, structure: Integers, record: Floats) -> int:
        """Run the first agent's episode, record every step, and return the number of steps taken.

        Args:
            key: names the episode's random streams.
            structure: lowest layer first, (n_layers,).
            record: (n_steps, n_columns) as in `compiler.details.traced_columns`, filled.
        """
        keys, arrays = np.array([key], np.uint64), self._detailed_outputs()
        *_, steps_taken, _not_finite, _expectations_met = arrays
        inputs = self._inputs(np.resize(keys, self.size), np.resize(structure, (self.size, len(structure))))
        self.kernels.run_traced(*inputs, *arrays, record)
        return int(steps_taken[0])

    def _detailed_outputs(self) -> list[Floats]:
        """Return zeros for what a detailed rollout writes, in the order of its arguments."""
        episode, who = self.kernels.meaning.episode, self._n_behaviors + 1
        lanes, rows = (self._keys.size,), (who, len(episode.reward), who)
        shapes = [lanes, *((n, *lanes) for n in rows), lanes]
        shapes += [(1 + len(checked_slots(episode)), *lanes), (len(episode.expects), *lanes)]
        return [np.zeros(shape) for shape in shapes]

    def _run(self, rollout: Rollout, *arrays: object) -> bool:
        return self.kernels.run(rollout, self.size, *arrays)

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
        """Set what behaviors bid: the layer, and what turns a choice into the action's number over all behaviors."""
        self._priorities[:] = NEVER
        layers = np.arange(1, structures.shape[1] + 1)[:, np.newaxis] << ACTION_BITS
        behaviors = structures.T
        self._priorities[behaviors, np.arange(self.size)] = layers + self._first_actions[behaviors]
