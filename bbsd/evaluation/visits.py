"""Counts of the cells that a design's behaviors were asked for."""

from __future__ import annotations

from itertools import accumulate, pairwise
from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture.visits import Visits
from bbsd.compiler import compile_meaning
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import fold, name_word
from bbsd.language.meaning import seed_key

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.compiler.steps import Steps
    from bbsd.environments.stepping import Stepper
    from bbsd.environments.tables import TransitionTable
    from bbsd.language.meaning import Meaning

VISITS = name_word("visits of a design")
EPISODES = 100
"""Episodes in which visits are counted, where a kernel is there for them."""
EPISODES_WITHOUT_KERNEL = 20
MOST_STEPS_WITHOUT_KERNEL = 20_000
"""Steps of single robots, some seconds at most in plain Python; compiling a kernel takes longer."""


def visits_of(
    meaning: Meaning,
    architecture: Architecture,
    seed: int,
    episodes: int,
    stepper: Callable[[], Stepper] | None = None,
    table: TransitionTable | None = None,
) -> Visits:
    """Count the visits of a design, in plain Python where that takes less time than to compile its kernel."""
    compiled = not _is_soon_done(meaning, episodes)
    problem = compile_meaning(meaning, compiled=compiled, stepper=stepper, table=table)
    return count_visits(
        problem, architecture, visits_key(seed), episodes, meaning.spec.design.coevolution.generations
    )


def visits_after_design(
    problem: Problem, architecture: Architecture, seed: int, *, has_kernel: bool
) -> Visits:
    """Count the visits of what was just designed; `has_kernel` says that the search has used the kernel for it."""
    meaning = problem.meaning
    if not has_kernel and _is_soon_done(meaning, EPISODES_WITHOUT_KERNEL):
        return visits_of(meaning, architecture, seed, EPISODES_WITHOUT_KERNEL, problem.stepper)
    generation = meaning.spec.design.coevolution.generations
    return count_visits(problem, architecture, visits_key(seed), EPISODES, generation)


def visits_key(seed: int) -> int:
    """Return the name of the stream of the episodes in which visits are counted."""
    return fold(seed_key(seed), VISITS)


def _is_soon_done(meaning: Meaning, episodes: int) -> bool:
    environment = meaning.spec.environment
    return episodes * environment.steps * environment.robots <= MOST_STEPS_WITHOUT_KERNEL


def count_visits(
    problem: Problem, architecture: Architecture, key: int, episodes: int, generation: int
) -> Visits:
    """Run the first episodes of a stream and count in how many steps which cell was asked, and controlled.

    Args:
        problem: the spec, compiled.
        architecture: its design.
        key: names the stream.
        episodes: how many.
        generation: in whose constants they run.
    """
    pools = [table[np.newaxis] for table in architecture.tables]
    members = np.zeros((episodes, len(pools)), np.int64)
    structures = np.tile(architecture.structure, (episodes, 1))
    sizes = [shape.n_cells * (shape.n_actions + 1) for shape in problem.tables]
    pairs, robot_steps = np.zeros(sum(sizes), np.int64), 0

    def learn(steps: Steps, steps_taken: NDArray[np.float64]) -> None:
        nonlocal robot_steps
        robots = steps.asked.shape[1]
        robot_steps += int(steps_taken.sum()) * robots
        for lane, taken in enumerate(steps_taken.astype(np.int64).tolist()):
            codes = steps.asked[:taken, :, :, lane].ravel()
            pairs[:] += np.bincount(codes[codes >= 0] >> 1, minlength=len(pairs))

    team = problem.assemble(pools, members, generation)
    open_cells = np.zeros(sum(shape.n_cells for shape in problem.tables), np.uint8)
    team.practice(keys(key, 0, episodes), structures, np.zeros(episodes), open_cells, learn)
    ends = [*accumulate(sizes, initial=0)]
    counts = [
        pairs[first:last].reshape(shape.n_cells, -1)
        for shape, (first, last) in zip(problem.tables, pairwise(ends), strict=True)
    ]
    return Visits(
        episodes,
        robot_steps,
        tuple(each.sum(1) for each in counts),
        tuple(each[:, 1:].sum(1) for each in counts),
    )
