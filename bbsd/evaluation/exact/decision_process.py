"""Markov chains and decision processes as arrays: what is earned in so many steps, exactly, and at best."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import fsum, sqrt
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.evaluation.statistics import Optimum
from bbsd.evaluation.sums import expectation

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Floats = NDArray[np.float64]
    Integers = NDArray[np.int64]

TIE = 1e-12
"""Options whose gains differ by less are equally good."""


class Moments(NamedTuple):
    """The mean and the standard deviation of a return."""

    mean: float
    sd: float


@dataclass(frozen=True, eq=False)
class Chain:
    """A Markov chain: the next state depends on the present one alone. Episodes begin in a state drawn from `starts`.

    A transition leads from one state to another; the target -1 is the end of the episode. Probabilities of the
    transitions of a state sum to 1.
    """

    starts: Floats
    """(n_states,)."""
    origins: Integers
    """(n_transitions,), as the two that follow."""
    targets: Integers
    probabilities: Floats

    @property
    def n_states(self) -> int:
        """The number of states."""
        return len(self.starts)

    def visits(self, steps: int) -> Floats:
        """Return the expected number of steps, of `steps` at most, that begin in each state; (n_states,)."""
        there, visits = self.starts, np.zeros(self.n_states)
        for _ in range(steps):
            visits += there
            if not there.any():
                break
            arriving = np.where(self.targets >= 0, there[self.origins] * self.probabilities, 0.0)
            there = _summed(self.targets % self.n_states, arriving, self.n_states)
        return visits

    def expected(self, gains: Floats, visits: Floats) -> float:
        """Return what an episode should bring, given what each transition does, (n_transitions,), and `visits`."""
        weights = visits[self.origins] * self.probabilities
        return fsum((weights * gains).tolist())

    def moments(self, gains: Floats, steps: int) -> Moments:
        """Return mean and standard deviation of what episodes bring, given what each transition does.

        Backwards from the last step, by the law of total variance, so that a small deviation is not lost between large
        squares.
        """
        means, variances = np.zeros(self.n_states + 1), np.zeros(self.n_states + 1)
        for _ in range(steps):
            values = gains + means[self.targets]
            now = _summed(self.origins, self.probabilities * values, self.n_states)
            off = (values - now[self.origins]) ** 2 + variances[self.targets]
            variances[:-1] = _summed(self.origins, self.probabilities * off, self.n_states)
            means[:-1] = now
        mean = expectation(self.starts, means[:-1])
        variance = expectation(self.starts, variances[:-1] + (means[:-1] - mean) ** 2)
        return Moments(mean, sqrt(variance))


@dataclass(frozen=True, eq=False)
class DecisionProcess:
    """A Markov decision process: in every state one of some options is chosen, and each option has some outcomes.

    The target -1 is the end of the episode. The options of a state stand together, as the outcomes of an option do.
    """

    starts: Floats
    """The probability that an episode begins in a state, (n_states,)."""
    first_options: Integers
    """The first option of each state, (n_states,)."""
    options: Integers
    """The option that each outcome belongs to, (n_outcomes,), as the three that follow."""
    targets: Integers
    probabilities: Floats
    rewards: Floats

    @property
    def n_states(self) -> int:
        """The number of states."""
        return len(self.starts)

    @cached_property
    def n_options(self) -> int:
        """The number of options of all states."""
        return int(self.options[-1]) + 1

    def optimum(self, steps: int) -> Optimum:
        """Return what can be earned in so many steps.

        A policy that always does the same in a state is looked for among those that are best for the first of so many
        steps that are left; the best one of all need not be among them.
        """
        values = np.zeros(self.n_states + 1)
        policies: dict[bytes, Integers] = {}
        for _ in range(steps):
            gains = self._gains(values)
            policy = self._best_options(gains)
            policies[policy.tobytes()] = policy
            values[:-1] = gains[policy]
        fixed = max((self.value(policy, steps) for policy in policies.values()), default=0.0)
        return Optimum(expectation(self.starts, values[:-1]), fixed, self.n_states)

    def value(self, policy: Integers, steps: int) -> float:
        """Return what a policy (n_states,) earns that takes the same option in a state at any time."""
        values = np.zeros(self.n_states + 1)
        for _ in range(steps):
            values[:-1] = self._gains(values)[policy]
        return expectation(self.starts, values[:-1])

    def _gains(self, values: Floats) -> Floats:
        """Return what each option earns, now and later, given what the states are worth and the end, 0."""
        return _summed(
            self.options, self.probabilities * (self.rewards + values[self.targets]), self.n_options
        )

    def _best_options(self, gains: Floats) -> Integers:
        """Return the first of the best options of each state."""
        n_options = np.diff(self.first_options, append=self.n_options)
        best = np.repeat(np.maximum.reduceat(gains, self.first_options), n_options)
        order = np.arange(self.n_options, 0, -1)
        first: Integers = np.maximum.reduceat((gains >= best - TIE) * order, self.first_options)
        return self.n_options - first


def _summed(places: Integers, values: Floats, count: int) -> Floats:
    """Return the sum of the values of each place, one after the other: the same bits everywhere."""
    return np.bincount(places, values, count).astype(np.float64)
