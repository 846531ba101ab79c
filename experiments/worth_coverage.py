"""How often the 95 % intervals of `bbsd worth` hold the truth, where it is known.

Run by `python -m experiments.worth_coverage`. On the abstract problem an episode is one step from one of 25 states, so
the exact worth of a behavior or a rule is a mean over all states. The worth of one design is measured with many seeds.
Changes that are the same in all states are left out: their intervals say nothing.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

import bbsd
from bbsd.architecture import Architecture
from bbsd.compiler import compile_meaning
from bbsd.evaluation import enumerate_starts, evaluation_key, paired_episodes
from bbsd.evaluation.sums import expectation
from bbsd.explanation.worth import Appraisal
from bbsd.explanation.worth.variants import Variants
from experiments.designs import spec_path

if TYPE_CHECKING:
    from bbsd.compiler import Problem
    from bbsd.evaluation import Interval
    from experiments.designs import Floats

SEEDS, EPISODES = range(200), 1000
DESIGN, ACTS = 3, 0.25
"""The seed of the design, random tables in a random order, and the probability of an action in a cell."""


@dataclass(frozen=True, slots=True)
class Coverage:
    """The number of intervals that hold the truth, and of all."""

    held: int
    of: int

    @property
    def share(self) -> float:
        """The share of intervals that hold the truth."""
        return self.held / self.of


def coverages(
    seeds: range = SEEDS, episodes: int = EPISODES, *, compiled: bool = True
) -> dict[str, Coverage]:
    """Return how often intervals hold the truth: of dropped behaviors, of dropped rules, of random tables."""
    problem = compile_meaning(bbsd.load(spec_path("abstract")).meaning, compiled=compiled)
    design = _random_design(problem)
    truths = _truths(Appraisal(problem, design, 0, episodes, 1))
    hits: dict[str, list[bool]] = {}
    for seed in seeds:
        measured = Appraisal(problem, design, evaluation_key(seed), episodes, 1)
        for (kind, behavior, rule), truth in truths.items():
            found = _measured(measured, kind, behavior, rule)
            if found is not None:
                hits.setdefault(kind, []).append(found.low <= truth <= found.high)
    return {kind: Coverage(sum(each), len(each)) for kind, each in hits.items()}


def _random_design(problem: Problem) -> Architecture:
    rng = np.random.default_rng(DESIGN)
    tables = tuple((rng.random(table.n_cells) < ACTS).astype(np.uint8) for table in problem.tables)
    return Architecture(tables, rng.permutation(problem.n_behaviors))


def _measured(appraisal: Appraisal, kind: str, behavior: int, rule: int) -> Interval | None:
    match kind:
        case "dropped behaviors":
            return appraisal.dropped(behavior)
        case "dropped rules":
            return appraisal.dropped_rule(behavior, rule)
    return appraisal.replaced(behavior)


def _truths(appraisal: Appraisal) -> dict[tuple[str, int, int], float]:
    """Return the exact worth of all parts of a design that matter in some states and not alike in all."""
    variants = Variants(appraisal.architecture)
    numbers = {}
    for behavior in appraisal.layers:
        always = np.ones_like(appraisal.architecture.tables[behavior])
        without = variants.without(behavior, "")
        numbers["dropped behaviors", behavior, 0] = [without]
        # In each state a random table is as likely to say its one action as No Action.
        numbers["random tables", behavior, 0] = [without, variants.with_table(behavior, always, "")]
        for index, rule in enumerate(appraisal.rules[behavior]):
            numbers["dropped rules", behavior, index] = [variants.with_table(behavior, rule.without, "")]
    problem, weights = enumerate_starts(appraisal.problem)
    starts = np.arange(len(weights), dtype=np.uint64)
    returns = paired_episodes(problem, variants.agents, starts, 1).returns
    changes = {part: _mean(returns, each) for part, each in numbers.items()}
    return {part: expectation(weights, change) for part, change in changes.items() if np.ptp(change)}


def _mean(returns: Floats, variants: list[int]) -> Floats:
    """Return the change of the return in each state, the mean of some variants."""
    change: Floats = returns[variants].mean(axis=0) - returns[0]
    return change


if __name__ == "__main__":
    for name, coverage in coverages().items():
        print(f"{name:<18} {coverage.share:.3f}  ({coverage.held} of {coverage.of})")
