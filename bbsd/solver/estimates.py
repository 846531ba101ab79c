"""The zero-order representation by its parts (11) and (9), instead of the joint estimate (13).

V_ij is what a step earned on average while B_j controlled from layer i; the probabilities of (9) are counted over the
lifetime, so that P{B_j | L_i} P(L_i is controlling) is the share of all steps in which the pair controlled.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(slots=True, eq=False)
class Counters:
    """V (n_agents, n_layers, n_behaviors) of (7), controlled steps of each pair, and all robot-steps (n_agents,)."""

    values: NDArray[np.float64]
    counts: NDArray[np.float64]
    steps: NDArray[np.float64]

    def update(
        self,
        structures: NDArray[np.int64],
        credit: NDArray[np.float64],
        control: NDArray[np.float64],
        rate: float,
    ) -> None:
        """(11), once an episode, for the pairs that controlled in it.

        credit and control, in robot-steps: (n_agents, n_behaviors + 1).
        """
        agents = np.arange(len(structures))
        self.steps += control.sum(axis=1)
        for layer, behaviors in enumerate(structures.T):
            controlled, earned = control[agents, behaviors], credit[agents, behaviors]
            old = self.values[agents, layer, behaviors]
            step = np.divide(earned, controlled, out=old.copy(), where=controlled > 0)
            self.values[agents, layer, behaviors] = np.where(
                controlled > 0, (1.0 - rate) * old + rate * step, old
            )
            self.counts[agents, layer, behaviors] += controlled

    def joint(self) -> NDArray[np.float64]:
        """The summands of (9), which take the place of Ṽ (12)."""
        share = self.counts / np.maximum(self.steps, 1.0)[:, None, None]
        return share * self.values


def no_counters(n_agents: int, n_layers: int, n_behaviors: int) -> Counters:
    """Nothing known and nothing counted."""
    shape = (n_agents, n_layers, n_behaviors)
    return Counters(np.zeros(shape), np.zeros(shape), np.zeros(n_agents))
