"""Where searches try designs: many designs in the same episodes of a named stream."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from bbsd.compiler.joint_control import JointControl
from bbsd.evaluation import require_finite, returns_of
from bbsd.evaluation.sums import row_means
from bbsd.kernel.jit import jit
from bbsd.kernel.keys import keys
from bbsd.solver.space import Space
from bbsd.stopping import raise_if_stopped

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.compiler.steps import Steps
    from bbsd.compiler.team import Learn
    from bbsd.evaluation import Agents
    from bbsd.solver.space import Designs


@dataclass(frozen=True)
class Arena:
    """A problem and the generation in whose constants its episodes run."""

    problem: Problem
    generation: int
    starts: Designs | None = None
    """Known designs with which searches begin."""

    @cached_property
    def afresh(self) -> Arena:
        """The same for a search that begins with nothing known, so that it may come to something else."""
        if self.starts is None:
            return self
        other = replace(self, starts=None)
        vars(other).update({name: value for name, value in vars(self).items() if name != "starts"})
        return other

    @cached_property
    def space(self) -> Space:
        """What the problem leaves open."""
        return Space(self.problem)

    @cached_property
    def joint_control(self) -> JointControl:
        """The same robots, controlled by one table over the joint partition."""
        return JointControl(self.problem)

    def returns(self, designs: Designs, key: int, count: int, first: int = 0) -> NDArray[np.float64]:
        """Run all designs in the same episodes, numbers `first`, `first + 1`, ... of a stream.

        Spends len(designs) * count episodes. Raises KeyboardInterrupt where a stop was requested.

        Returns:
            (n_designs, count).
        """
        return self.agents_returns(self.space.agents(designs), key, count, first)

    def agents_returns(self, agents: Agents, key: int, count: int, first: int = 0) -> NDArray[np.float64]:
        """Run agents of pools like the designs of `returns`, (n_agents, count)."""
        raise_if_stopped()
        return returns_of(self.problem, agents, keys(key, first, count), self.generation)

    def practice(
        self, designs: Designs, key: int, rates: NDArray[np.float64], learn: Learn
    ) -> NDArray[np.float64]:
        """Run each design in an episode of its own in which its robots stray from it, and learn from the steps.

        Spends len(designs) episodes. Raises KeyboardInterrupt where a stop was requested.

        Args:
            designs: strayed from in open cells only.
            key: names the stream of the episodes.
            rates: the probability that a robot strays in a step, (n_designs,).
            learn: is given the steps of each batch of designs, in their order.

        Returns:
            (n_designs,).
        """
        raise_if_stopped()
        agents, streams = self.space.agents(designs), keys(key, 0, len(designs))
        team = self.problem.assemble(agents.pools, agents.members, self.generation)
        returns = team.practice(streams, agents.structures, rates, self.space.is_open, learn)
        require_finite(self.problem, agents, streams, returns, self.generation)
        return returns

    def means(self, designs: Designs, key: int, count: int) -> NDArray[np.float64]:
        """Return the mean return of each design in the same episodes of a stream, (n_designs,)."""
        return row_means(self.returns(designs, key, count))

    def paired_returns(
        self, designs: Designs, rows: NDArray[np.int64], key: int, episodes: NDArray[np.int64]
    ) -> NDArray[np.float64]:
        """Run some designs in some episodes of a stream, both by their numbers, and return the returns, (n_rows,)."""
        raise_if_stopped()
        if not len(rows):
            return np.empty(0)
        first = int(episodes.min())
        streams = keys(key, first, int(episodes.max()) - first + 1)[episodes - first]
        agents = self.space.agents(designs)[rows]
        return returns_of(self.problem, agents, streams[:, np.newaxis], self.generation)[:, 0]

    def asked(
        self, design: Designs, key: int, count: int, first: int = 0
    ) -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
        """Run one design in episodes of a stream, and record in which it asks which cell.

        A cell is asked where its behavior is excited and no higher one acts: another choice in it changes an episode
        only if it is asked.

        Returns:
            returns (count,), and cells asked (count, n_cells).
        """
        raise_if_stopped()
        agents = self.space.agents(design)
        members, structures = (np.repeat(rows, count, axis=0) for rows in (agents.members, agents.structures))
        team = self.problem.assemble(agents.pools, members, self.generation)
        asked = np.zeros((count, len(self.space.given)), np.bool_)

        def learn(steps: Steps, steps_taken: NDArray[np.float64]) -> None:
            mark_asked(steps.asked, steps_taken, self._cell_of_pair, asked[steps.first :])

        streams, at_no_time = keys(key, first, count), np.zeros(count)
        open_cells = np.zeros(len(self.space.given), np.uint8)
        returns = team.practice(streams, structures, at_no_time, open_cells, learn)
        if not np.isfinite(returns).all():
            return self.returns(design, key, count, first)[0], asked  # which raises what is wrong
        return returns, asked

    @cached_property
    def _cell_of_pair(self) -> NDArray[np.int64]:
        """The cell of each pair of a cell and a choice."""
        return np.repeat(np.arange(len(self.space.choices)), self.space.choices)


@jit
def mark_asked(
    asked: NDArray[np.signedinteger],
    steps_taken: NDArray[np.float64],
    cell_of_pair: NDArray[np.int64],
    marks: NDArray[np.bool_],
) -> None:
    """Mark, in `marks` (n_lanes, n_cells), the cells that the recorded steps of lanes asked."""
    for lane in range(len(steps_taken)):
        for step in range(int(steps_taken[lane])):
            for robot in range(asked.shape[1]):
                for behavior in range(asked.shape[2]):
                    code = asked[step, robot, behavior, lane]
                    if code >= 0:
                        marks[lane, cell_of_pair[code >> 1]] = True
