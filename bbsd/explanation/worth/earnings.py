"""What each behavior earned: the reinforcement of the steps that it controlled, by reward term.

A rollout gives what each behavior earned of all terms together, its credit. In a copy of the meaning every reward term
has a weight, a constant that the kernel reads: with one weight 1 and the others 0, credit is that of one term. So one
kernel does for all terms, and it is no larger than that of an evaluation.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.compiler.team import Team
from bbsd.evaluation.episodes import batches_of
from bbsd.evaluation.sums import column_sums
from bbsd.expression.graph import Level
from bbsd.expression.kinds import Kind

if TYPE_CHECKING:
    from bbsd.compiler import DetailedOutcome, Problem
    from bbsd.evaluation import Agents
    from bbsd.language.meaning import Meaning

Floats = npt.NDArray[np.float64]
Keys = npt.NDArray[np.uint64]


@dataclass(frozen=True, slots=True, eq=False)
class Earnings:
    """What one design earned in some episodes, and while which behavior controlled.

    `by_term` (n_behaviors + 1, n_terms) is of the mean over robots, per episode; the last row is nobody's. `control`
    (n_behaviors + 1,) are robot-steps per episode, `met` (n_expectations,) those after which an expectation held.
    """

    by_term: Floats
    control: Floats
    met: Floats
    steps: float
    """Mean length of an episode."""


def earnings(problem: Problem, agent: Agents, keys: Keys, generation: int) -> Earnings:
    """Run episodes of one design, in which all rewards are finite, and return what each behavior earned by reward term.

    Args:
        problem: the spec.
        agent: the design, as the only agent.
        keys: name the random streams of the episodes, (n_episodes,).
        generation: in whose constants they run.
    """
    meaning = _weighted(problem.meaning)
    weighted = problem.with_meaning(meaning)
    n_terms = len(problem.meaning.episode.reward)
    constants = np.array(meaning.constants.vector(generation))
    sums = []
    for term in range(n_terms):
        constants[len(constants) - n_terms :] = np.arange(n_terms) == term
        sums.append(_sums(weighted, agent, keys, constants))
    credit, control, met, steps = (np.array(parts) / len(keys) for parts in zip(*sums, strict=True))
    return Earnings(credit.T, control[0], met[0], float(steps[0, 0]))


def _sums(problem: Problem, agent: Agents, keys: Keys, constants: Floats) -> tuple[Floats, ...]:
    """Return the sums over all episodes of credit, control, expectations met and steps taken."""
    parts = []
    for _, batch, streams in batches_of(agent, keys):
        team = Team(problem.kernels, batch.pools, batch.members, constants)
        parts.append(
            [column_sums(each) for each in _summed(team.detailed_episode(streams, batch.structures))]
        )
    return tuple(column_sums(np.stack(each)) for each in zip(*parts, strict=True))


def _summed(outcome: DetailedOutcome) -> tuple[Floats, ...]:
    return outcome.credit, outcome.control, outcome.expectations_met, outcome.steps_taken[:, np.newaxis]


def _weighted(meaning: Meaning) -> Meaning:
    """Return the meaning with a weight for each reward term, the last constants."""
    graph, reward, constants = meaning.graph.fork(), meaning.episode.reward, meaning.constants
    graph.bounded = False
    first, one = len(constants.scalars), graph.number(1.0)
    weights = [graph.leaf("constant", first + k, Kind.NUMBER, Level.CALL) for k in range(len(reward))]
    terms = {
        term: tuple(graph.apply("*", weight, node) for node in nodes)
        for (term, nodes), weight in zip(reward.items(), weights, strict=True)
    }
    name = "weights"
    while name in constants.values:
        name += "_"
    ones = (one,) * len(weights)
    return replace(
        meaning,
        graph=graph,
        constants=replace(
            constants,
            values={**constants.values, name: ones},
            scalars=(*constants.scalars, *ones),
            leaves={**constants.leaves, name: tuple(weights)},
            wholes=(*constants.wholes, *(True for _ in weights)),
        ),
        episode=replace(meaning.episode, reward=terms),
    )
