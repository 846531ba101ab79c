"""What an evaluation reports: the return with its interval, by term, and who was in control."""

from __future__ import annotations

from dataclasses import dataclass
from statistics import NormalDist
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.compiler.naming import slot_text

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.compiler import DetailedOutcome, Problem

Floats = npt.NDArray[np.float64]

QUANTILE_95 = NormalDist().inv_cdf(0.975)


@dataclass(frozen=True, slots=True)
class Interval:
    """A mean, the standard deviation of what it is the mean of, and the normal 95 % interval of the mean."""

    mean: float
    sd: float
    low: float
    high: float
    count: int


def interval(values: Floats) -> Interval:
    """The mean of independent values (n,) with its interval; with one value the interval is unknown (NaN)."""
    mean = float(np.mean(values))
    if len(values) < 2:
        return Interval(mean, float("nan"), float("nan"), float("nan"), len(values))
    sd = float(np.std(values, ddof=1))
    half = QUANTILE_95 * sd / float(np.sqrt(len(values)))
    return Interval(mean, sd, mean - half, mean + half, len(values))


@dataclass(frozen=True, slots=True)
class Evaluation:
    """The episodes of one design, or of many random ones."""

    returns: Interval
    episodes: int
    agents: int
    reward_terms: dict[str, float]
    """Mean per episode."""
    control_share: dict[str, float]
    """Of all robot-steps, by behavior and `nobody`."""
    steps: float
    """Mean length of an episode."""
    not_finite: dict[str, int]
    """Steps in which a value was infinite or not a number, by its name; only those that were."""
    exact: bool = False

    @property
    def mean(self) -> float:
        """The mean return of an episode."""
        return self.returns.mean

    @property
    def sd(self) -> float:
        """The standard deviation of the return."""
        return self.returns.sd

    @property
    def ci95(self) -> tuple[float, float]:
        """The 95 % interval of the mean return."""
        return self.returns.low, self.returns.high


def evaluation(problem: Problem, outcomes: Iterable[DetailedOutcome], agents: int) -> Evaluation:
    """Sum up the outcomes of some agents' episodes, agent after agent, each with equally many.

    With several agents the interval is that of the mean over agents, since episodes of one agent belong together.
    """
    returns, terms, control, taken, odd = [], 0.0, 0.0, 0.0, 0.0
    for outcome in outcomes:
        returns.append(outcome.returns)
        terms = terms + outcome.terms.sum(axis=0)
        control = control + outcome.control.sum(axis=0)
        taken += float(outcome.taken.sum())
        odd = odd + outcome.odd.sum(axis=0)
    every = np.concatenate(returns)
    spread = interval(every)
    if agents > 1:
        by_agent = interval(every.reshape(agents, -1).mean(axis=1))
        spread = Interval(spread.mean, spread.sd, by_agent.low, by_agent.high, len(every))
    return Evaluation(
        spread, len(every), agents, *_named(problem, terms, control, taken, odd, float(len(every)))
    )


def weighted_evaluation(problem: Problem, outcomes: Iterable[DetailedOutcome], weights: Floats) -> Evaluation:
    """The exact expectation over all episodes there can be, each with its probability; weights (n,) sum to 1."""
    parts = list(outcomes)
    returns, terms, control, taken, odd = (
        np.concatenate([getattr(part, name) for part in parts])
        for name in ("returns", "terms", "control", "taken", "odd")
    )
    mean = float(weights @ returns)
    sd = float(np.sqrt(weights @ (returns - mean) ** 2))
    exact = Interval(mean, sd, mean, mean, len(weights))
    sums = (weights @ terms, weights @ control, float(weights @ taken), odd.sum(axis=0))
    return Evaluation(exact, len(weights), 1, *_named(problem, *sums, 1.0), exact=True)


def _named(
    problem: Problem,
    terms: Floats | float,
    control: Floats | float,
    taken: float,
    odd: Floats | float,
    episodes: float,
) -> tuple[dict[str, float], dict[str, float], float, dict[str, int]]:
    """Sums as named means and shares."""
    robots = problem.meaning.spec.environment.robots
    who = (*problem.names, "nobody")
    by_term = {
        name: float(value) / episodes
        for name, value in zip(problem.meaning.episode.reward, np.atleast_1d(terms), strict=True)
    }
    share = {
        name: float(value) / (taken * robots) for name, value in zip(who, np.atleast_1d(control), strict=True)
    }
    counts = {
        slot_text(slot, robots): int(value)
        for slot, value in zip(problem.places, np.atleast_1d(odd), strict=False)
        if value
    }
    return by_term, share, taken / episodes, counts
