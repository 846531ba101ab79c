"""What agents learn in a lifetime of their behaviors in each layer (V.A): two estimates of what (12) stands for.

An estimate says how an episode must be run for it, is updated by what came out, and gives the values Ṽ_ij whose sum (9)
structures compete by. Agents learn side by side, each for itself.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Protocol, TypeVar

import numpy as np

from bbsd.kernel.jit import jit

if TYPE_CHECKING:
    from typing import Literal

    from numpy.typing import NDArray

    from bbsd.compiler import DetailedOutcome, Outcome, Team
    from bbsd.language.design import Learning

Seen = TypeVar("Seen")
"""The outcome of an episode, in the detail that an estimate needs."""


class Estimate(Protocol[Seen]):
    """What agents have learned of each behavior in each layer."""

    @property
    def values(self) -> NDArray[np.float64]:
        """The values Ṽ_ij of (12), (n_agents, n_layers, n_behaviors)."""

    def run_episode(self, team: Team, keys: NDArray[np.uint64], structures: NDArray[np.int64]) -> Seen:
        """Run an episode of every agent in the detail that `update` needs."""

    def update(self, structures: NDArray[np.int64], outcome: Seen, rate: float) -> None:
        """Learn from the episode of every agent under its structure (n_agents, n_layers), with rate α."""


@dataclass(frozen=True, slots=True, eq=False)
class JointEstimate:
    """Ṽ_ij as one number, updated by (13)."""

    values: NDArray[np.float64]
    outside: Literal["keep", "decay"] = "keep"
    """Whether pairs outside of the present structure keep their value, or decay."""

    def run_episode(self, team: Team, keys: NDArray[np.uint64], structures: NDArray[np.int64]) -> Outcome:
        """Run an episode of every agent."""
        return team.episode(keys, structures)

    def update(self, structures: NDArray[np.int64], outcome: Outcome, rate: float) -> None:
        """Apply (13) once, with rate α, to what each agent's behaviors earned."""
        update = update_values if self.outside == "keep" else update_all_values
        update(self.values, structures, outcome.credit, rate)


@dataclass(slots=True, eq=False)
class CountedEstimate:
    """Ṽ_ij by its parts: V_ij updated by (11), and the probabilities of (9) counted over the lifetime.

    `step_values` is V of (7), what a step earned on average while B_j controlled from layer i, and `controlled` counts
    those steps, both (n_agents, n_layers, n_behaviors); `steps` (n_agents,) counts all. Steps are those of robots.
    """

    step_values: NDArray[np.float64]
    controlled: NDArray[np.float64]
    steps: NDArray[np.float64]

    @property
    def values(self) -> NDArray[np.float64]:
        """The summands of (9): P{B_j | L_i} P(L_i is controlling) is the share of steps that the pair controlled."""
        share = self.controlled / np.maximum(self.steps, 1.0)[:, None, None]
        return share * self.step_values

    def run_episode(
        self, team: Team, keys: NDArray[np.uint64], structures: NDArray[np.int64]
    ) -> DetailedOutcome:
        """Run an episode of every agent and count who controls."""
        return team.detailed_episode(keys, structures)

    def update(self, structures: NDArray[np.int64], outcome: DetailedOutcome, rate: float) -> None:
        """Apply (11) once, with rate α, to the pairs that controlled in the episode, and count their steps."""
        agents = np.arange(len(structures))
        self.steps += outcome.control.sum(axis=1)
        for layer, behaviors in enumerate(structures.T):
            controlled, earned = outcome.control[agents, behaviors], outcome.credit[agents, behaviors]
            old = self.step_values[agents, layer, behaviors]
            step = np.divide(earned, controlled, out=old.copy(), where=controlled > 0)
            self.step_values[agents, layer, behaviors] = np.where(
                controlled > 0, (1.0 - rate) * old + rate * step, old
            )
            self.controlled[agents, layer, behaviors] += controlled


def no_experience(learning: Learning, shape: tuple[int, ...]) -> Estimate[Any]:
    """Return what agents have learned before their first episode: zeros (n_agents, n_layers, n_behaviors)."""
    if learning.estimate == "counters":
        return CountedEstimate(np.zeros(shape), np.zeros(shape), np.zeros(shape[0]))
    return JointEstimate(np.zeros(shape), learning.outside)


@jit
def update_values(
    values: NDArray[np.float64], structures: NDArray[np.int64], credit: NDArray[np.float64], rate: float
) -> None:
    """Apply (13) once, in place: pairs of the present structure move toward the credit of the episode.

    A behavior that did not control has credit 0, so its pair decays; pairs outside keep their value.

    Args:
        values: Ṽ, (n_agents, n_layers, n_behaviors), changed.
        structures: (n_agents, n_layers).
        credit: (n_agents, n_behaviors or more), reinforcement summed while each behavior controlled.
        rate: α of the episode.
    """
    n_agents, n_layers = structures.shape
    for agent in range(n_agents):
        for layer in range(n_layers):
            behavior = structures[agent, layer]
            old = values[agent, layer, behavior]
            values[agent, layer, behavior] = (1.0 - rate) * old + rate * credit[agent, behavior]


def update_all_values(
    values: NDArray[np.float64], structures: NDArray[np.int64], credit: NDArray[np.float64], rate: float
) -> None:
    """Apply (13) once, in place, literally: all pairs move toward what they earned, those outside toward 0.

    The arguments are those of `update_values`.
    """
    agents, layers = np.ogrid[: structures.shape[0], : structures.shape[1]]
    values *= 1.0 - rate
    values[agents, layers, structures] += rate * credit[agents, structures]
