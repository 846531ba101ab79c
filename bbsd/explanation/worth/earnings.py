"""What each behavior earned: the reinforcement of the steps that it controlled, by reward term.

The terms of a rollout are made of nodes of a graph. In a copy of the spec's meaning every reward term is divided into
one for each behavior, and one for nobody, which is 0 where another one controls; so a rollout in detail adds up what is
wanted here, and its kernel needs nothing new.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import accumulate
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from bbsd.evaluation import detailed_outcomes
from bbsd.evaluation.sums import column_sums

if TYPE_CHECKING:
    from bbsd.compiler import Problem
    from bbsd.evaluation import Agents
    from bbsd.expression.graph import Graph, Node
    from bbsd.language.meaning import Meaning

Floats = npt.NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class Earnings:
    """What one design earned in some episodes, and while which behavior controlled.

    `by_term` (n_behaviors + 1, n_terms) and `returns` (n_episodes,) are of the mean over robots, the first per episode;
    the last row is nobody's. `control` (n_behaviors + 1,) are robot-steps per episode, `met` (n_expectations,) those
    after which an expectation held.
    """

    returns: Floats
    by_term: Floats
    control: Floats
    met: Floats
    steps: float
    """Mean length of an episode."""


def earnings(problem: Problem, agent: Agents, keys: npt.NDArray[np.uint64], generation: int) -> Earnings:
    """Run episodes of one design and return what each behavior earned in them, by reward term.

    Args:
        problem: the spec.
        agent: the design, as the only agent.
        keys: name the random streams of the episodes, (n_episodes,).
        generation: in whose constants they run.

    Raises:
        RewardNotFinite: a reward was infinite or not a number.
    """
    divided = replace(problem, meaning=_divided(problem.meaning))
    outcomes = list(detailed_outcomes(divided, agent, keys, generation))
    by_term, control, met, steps = (
        column_sums(np.stack([column_sums(_columns(getattr(outcome, name))) for outcome in outcomes]))
        / len(keys)
        for name in ("terms", "control", "expectations_met", "steps_taken")
    )
    returns = np.concatenate([outcome.returns for outcome in outcomes])
    n_terms = len(problem.meaning.episode.reward)
    return Earnings(returns, by_term.reshape(-1, n_terms), control, met, float(steps[0]))


def _columns(values: Floats) -> Floats:
    return values.reshape(len(values), -1)


def _divided(meaning: Meaning) -> Meaning:
    """Return the meaning with a reward term for each behavior, and one for nobody, in place of each reward term."""
    graph, episode = meaning.graph.fork(), meaning.episode
    graph.bounded = False
    counts = [len(module.actions) for module in episode.modules]
    firsts = [1, *accumulate(counts, initial=1)]
    nothing = graph.number(0.0)

    def controls(behavior: int, choice: Node) -> Node:
        if behavior == len(counts):
            return graph.apply("==", choice, graph.cell(0))
        return _within(choice, firsts[behavior + 1], firsts[behavior + 1] + counts[behavior], graph)

    reward = {
        f"{term}_{behavior}": tuple(
            graph.apply("select", controls(behavior, choice), node, nothing)
            for choice, node in zip(episode.choices, nodes, strict=True)
        )
        for behavior in range(len(counts) + 1)
        for term, nodes in enumerate(episode.reward.values())
    }
    named = {f"earned_{name}": nodes for name, nodes in reward.items()}
    return replace(meaning, graph=graph, episode=replace(episode, reward=named))


def _within(choice: Node, first: int, end: int, graph: Graph) -> Node:
    """Return whether a choice is one of some actions that follow one another."""
    if end - first == 1:
        return graph.apply("==", choice, graph.cell(first))
    return graph.apply(
        "&", graph.apply(">=", choice, graph.cell(first)), graph.apply("<", choice, graph.cell(end))
    )
