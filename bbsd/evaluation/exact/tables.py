"""What a design earns exactly where its environment steps by a table, and what could be earned at best.

The distribution over states is carried from step to step; nothing is sampled. A state is the environment's, and what
the spec keeps besides: a command that stays where nobody controls, or memory.
"""

from __future__ import annotations

from math import fsum
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation.exact.decision_process import Chain, DecisionProcess
from bbsd.evaluation.exact.single_steps import steps_of
from bbsd.evaluation.statistics import Evaluation, Interval

if TYPE_CHECKING:
    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.environments.tables import TransitionTable
    from bbsd.evaluation.statistics import Optimum


def exact_evaluation(
    problem: Problem, table: TransitionTable, architecture: Architecture, generation: int
) -> Evaluation:
    """Return what a design earns on average over all its episodes, beside the optimum; single returns are not known.

    Raises NotEnumerable, with words, where chance has endlessly many possibilities, or there are too many states.
    """
    taken = steps_of(problem, table, generation, architecture)
    chain = Chain(taken.starts, taken.origins, taken.targets, taken.probabilities)
    steps = problem.meaning.spec.environment.steps
    mean, sd = chain.moments(taken.terms.sum(axis=1), steps)
    visits = chain.visits(steps)
    length = fsum(visits.tolist())
    names = (*problem.names, "nobody")

    def expected(columns: np.ndarray) -> list[float]:
        return [chain.expected(column, visits) for column in columns.T]

    control = expected(taken.control)
    met = dict(zip(problem.meaning.episode.expects, expected(taken.met), strict=True))
    in_control = dict(zip(names, control, strict=True))
    return Evaluation(
        Interval(mean, sd, mean, mean, int((taken.starts > 0.0).sum())),
        int((taken.starts > 0.0).sum()),
        1,
        dict(zip(problem.meaning.episode.reward, expected(taken.terms), strict=True)),
        {name: share / length for name, share in in_control.items()},
        length,
        {},
        {name: share / in_control[name] if in_control[name] else float("nan") for name, share in met.items()},
        exact=True,
        optimum=optimum_by_table(problem, table, generation),
    )


def optimum_by_table(problem: Problem, table: TransitionTable, generation: int) -> Optimum:
    """Return what any controller could earn that sees the state and does what the behaviors' actions do.

    It may do any action of any behavior in any step, or none. Raises NotEnumerable as `exact_evaluation` does.
    """
    taken = steps_of(problem, table, generation)
    n_states, n_choices = len(taken.starts), taken.n_choices
    n_chances = len(taken.targets) // (n_states * n_choices)
    process = DecisionProcess(
        taken.starts,
        np.arange(n_states) * n_choices,
        np.repeat(np.arange(n_states * n_choices), n_chances),
        taken.targets,
        taken.probabilities,
        taken.terms.sum(axis=1),
    )
    return process.optimum(problem.meaning.spec.environment.steps)
