"""Where searches try designs: many designs in the same episodes of a named stream."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from bbsd.compiler.joint_control import JointControl
from bbsd.evaluation import returns_of
from bbsd.evaluation.sums import row_means
from bbsd.kernel.keys import keys
from bbsd.solver.space import Space
from bbsd.stopping import raise_if_stopped

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

    from bbsd.compiler import Problem
    from bbsd.evaluation import Agents
    from bbsd.solver.space import Designs


@dataclass(frozen=True)
class Arena:
    """A problem and the generation in whose constants its episodes run."""

    problem: Problem
    generation: int

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

    def means(self, designs: Designs, key: int, count: int) -> NDArray[np.float64]:
        """Return the mean return of each design in the same episodes of a stream, (n_designs,)."""
        return row_means(self.returns(designs, key, count))
