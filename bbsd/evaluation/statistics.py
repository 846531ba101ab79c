"""The statistics of an evaluation: the return with its interval, reward terms, and who was in control."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from math import fsum, sqrt
from statistics import NormalDist
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
import numpy.typing as npt

from bbsd.evaluation.frames import frame
from bbsd.evaluation.spread import EachEpisode, Spread, spread_of, weighted_spread
from bbsd.evaluation.sums import column_sums, deviation, expectation, mean, row_means

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from bbsd.compiler import DetailedOutcome, Problem

Floats = npt.NDArray[np.float64]

QUANTILE_95 = NormalDist().inv_cdf(0.975)


DECIDING = "what decides a cell or an index"
"""What is counted as not finite besides state, sensors and the world: what expressions compute between them."""


@dataclass(frozen=True, slots=True)
class Interval:
    """The mean and standard deviation of a sample, and the normal 95 % interval of the mean."""

    mean: float
    sd: float
    low: float
    high: float
    count: int


def interval(values: Floats) -> Interval:
    """Return the mean of independent values (n,) with its interval, which is NaN for a single value.

    All is NaN where a value is infinite or not a number.
    """
    if not np.isfinite(values).all():
        unknown = float("nan")
        return Interval(unknown, unknown, unknown, unknown, len(values))
    center = mean(values)
    if len(values) < 2:
        return Interval(center, float("nan"), float("nan"), float("nan"), len(values))
    sd = deviation(values)
    half = QUANTILE_95 * sd / sqrt(len(values))
    return Interval(center, sd, center - half, center + half, len(values))


@dataclass(frozen=True, slots=True)
class Optimum:
    """What can be earned at best."""

    best: float
    """By whoever sees the state and knows the steps that are left: nothing earns more."""
    fixed: float
    """By the best policy found that always does the same in a state."""
    n_states: int


@dataclass(frozen=True, slots=True)
class Evaluation:
    """The statistics of episodes of one design, or of many random agents."""

    returns: Interval
    """The return of an episode, its mean with the 95 % interval."""
    episodes: int
    """Episodes in all."""
    agents: int
    """Agents that ran them, 1 for a design."""
    reward_terms: dict[str, float]
    """Mean per episode."""
    control_share: dict[str, float]
    """Share of all robot-steps, by behavior and `nobody`."""
    steps: float
    """Mean length of an episode."""
    not_finite: dict[str, int]
    """Steps in which a value was infinite or not a number, by the value's name; without zeros."""
    expectation_share: dict[str, float] = field(default_factory=dict)
    """By behavior that expects something: the share of its controlled robot-steps after which the expectation was met.

    NaN where it never controlled.
    """
    exact: bool = False
    """Whether the return is the mean over all starts, each run or worked out once, and no sample."""
    spread: Spread | None = None
    """The returns of single episodes; None of a single one."""
    optimum: Optimum | None = None
    """What could be earned at best, where the environment's table of transitions says it."""
    each: EachEpisode | None = field(default=None, compare=False, repr=False)
    """What each episode brought, where that was to be kept."""

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

    def to_frame(self) -> Any:  # noqa: ANN401 - pandas is optional
        """Return a pandas DataFrame of what was measured: the return, reward terms, shares of control, expectations.

        Raises NoPandas where pandas is not installed.
        """
        spread = {"mean": self.mean, "sd": self.sd, "low": self.ci95[0], "high": self.ci95[1]}
        parts = {
            "return": spread,
            "reward term": self.reward_terms,
            "in control": self.control_share,
            "expectation": self.expectation_share,
        }
        rows = [(what, name, value) for what, values in parts.items() for name, value in values.items()]
        columns = zip(*rows, strict=True)
        return frame(dict(zip(("what", "name", "value"), map(list, columns), strict=True)))

    def __repr__(self) -> str:
        spread = "exact" if self.exact else f"{self.ci95[0]:.6g} to {self.ci95[1]:.6g}"
        agents = f" by {self.agents:,} agents" if self.agents > 1 else ""
        return f"<Evaluation: mean return {self.mean:.6g} ({spread}) in {self.episodes:,} episodes{agents}>"


def evaluation(
    problem: Problem, outcomes: Iterable[DetailedOutcome], agents: int, *, keep_each: bool = False
) -> Evaluation:
    """Summarize the outcomes of agents' episodes, agent after agent, equally many for each.

    With several agents the interval is that of the mean over agents, since episodes of one agent belong together. What
    each episode brought is kept where `keep_each`, else only its return.
    """
    parts: list[DetailedOutcome] = []
    kept: list[_Kept] = []
    for outcome in outcomes:
        parts.append(_sums(outcome))
        if keep_each:
            kept.append((outcome.returns, outcome.terms, outcome.steps_taken))
    returns = np.concatenate([part.returns for part in parts])
    terms, control, not_finite, met = (
        column_sums(np.stack([getattr(part, name) for part in parts]))
        for name in ("terms", "control", "not_finite", "expectations_met")
    )
    steps_taken = fsum(float(part.steps_taken[0]) for part in parts)
    over_episodes = interval(returns)
    if agents > 1:
        by_agent = interval(row_means(returns.reshape(agents, -1)))
        over_episodes = replace(over_episodes, low=by_agent.low, high=by_agent.high)
    named = _means_by_name(problem, terms, control, steps_taken, not_finite, met, float(len(returns)))
    return Evaluation(
        over_episodes,
        len(returns),
        agents,
        *named,
        spread=spread_of(returns, numbered=agents == 1) if len(returns) > 1 else None,
        each=_each(problem, kept, agents) if keep_each else None,
    )


_Kept: TypeAlias = "tuple[Floats, Floats, Floats]"
"""Returns (n,), terms (n, n_terms) and steps (n,) of a batch."""


def _each(
    problem: Problem, kept: Sequence[_Kept], agents: int = 1, probabilities: Floats | None = None
) -> EachEpisode:
    returns, terms, steps = (np.concatenate(batches) for batches in zip(*kept, strict=True))
    by_term = dict(zip(problem.meaning.episode.reward, terms.T, strict=True))
    return EachEpisode(returns, by_term, steps, agents, probabilities)


def _sums(outcome: DetailedOutcome) -> DetailedOutcome:
    """Sum everything but the returns over the episodes, so that memory does not grow with them."""
    return replace(
        outcome,
        credit=column_sums(outcome.credit),
        terms=column_sums(outcome.terms),
        control=column_sums(outcome.control),
        steps_taken=column_sums(outcome.steps_taken[:, None]),
        not_finite=column_sums(outcome.not_finite),
        expectations_met=column_sums(outcome.expectations_met),
    )


def weighted_evaluation(
    problem: Problem, outcomes: Iterable[DetailedOutcome], weights: Floats, *, keep_each: bool = False
) -> Evaluation:
    """Return the exact expectation over all possible episodes by their probabilities (n,), which sum to 1."""
    parts = list(outcomes)
    returns, terms, control, steps_taken, not_finite, met = (
        np.concatenate([getattr(part, name) for part in parts])
        for name in ("returns", "terms", "control", "steps_taken", "not_finite", "expectations_met")
    )
    center = expectation(weights, returns)
    sd = sqrt(expectation(weights, (returns - center) ** 2))
    by_term, by_control, by_met = (
        np.array([expectation(weights, column) for column in columns.T]) for columns in (terms, control, met)
    )
    steps, counts = expectation(weights, steps_taken), column_sums(not_finite)
    named = _means_by_name(problem, by_term, by_control, steps, counts, by_met, 1.0)
    return Evaluation(
        Interval(center, sd, center, center, len(weights)),
        len(weights),
        1,
        *named,
        exact=True,
        spread=weighted_spread(returns, weights) if len(weights) > 1 else None,
        each=_each(problem, [(returns, terms, steps_taken)], probabilities=weights) if keep_each else None,
    )


def from_the_top(measured: Evaluation, structure: Sequence[str]) -> Evaluation:
    """Return an evaluation whose behaviors are in the order of a structure, highest layer first; nobody is last."""

    def ordered(shares: dict[str, float]) -> dict[str, float]:
        names = [*structure, *(name for name in shares if name not in structure)]
        return {name: shares[name] for name in names if name in shares}

    return replace(
        measured,
        control_share=ordered(measured.control_share),
        expectation_share=ordered(measured.expectation_share),
    )


def _means_by_name(
    problem: Problem,
    terms: Floats,
    control: Floats,
    steps_taken: float,
    not_finite: Floats,
    met: Floats,
    episodes: float,
) -> tuple[dict[str, float], dict[str, float], float, dict[str, int], dict[str, float]]:
    """Return sums as means and shares by name, in the order of the fields of Evaluation."""
    robots = problem.meaning.spec.environment.robots
    who = (*problem.names, "nobody")
    by_term = {
        name: float(value) / episodes
        for name, value in zip(problem.meaning.episode.reward, terms, strict=True)
    }
    share = {name: float(value) / (steps_taken * robots) for name, value in zip(who, control, strict=True)}
    places = [*(slot.label(robots) for slot in problem.checked_slots), DECIDING]
    counts = {name: int(value) for name, value in zip(places, not_finite, strict=True) if value}
    in_control = dict(zip(who, control, strict=True))
    expected = {
        name: float(value) / float(in_control[name]) if in_control[name] else float("nan")
        for name, value in zip(problem.meaning.episode.expects, met, strict=True)
    }
    return by_term, share, steps_taken / episodes, counts, expected
