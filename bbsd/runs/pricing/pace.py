"""A budget from seconds: how many episodes this machine runs in them."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from bbsd.kernel.streams import fold, name_word
from bbsd.language.design import LEAST_BUDGET
from bbsd.solver.arena import Arena

if TYPE_CHECKING:
    from bbsd.compiler import Problem
    from bbsd.solver.paper.settings import Settings

PACE = name_word("pace")
DESIGNS, DESIGNS_IN_PYTHON = 200, 10
"""Designs that are run, and where the environment is stepped in Python."""
LONG_ENOUGH = 0.1
"""Seconds of episodes by which the pace is known."""


def budget_of(seconds: float, problem: Problem, settings: Settings) -> int:
    """Return the episodes that fit into so many seconds, once everything is compiled."""
    arena = Arena(problem, settings.coevolution.generations)
    n_designs = DESIGNS_IN_PYTHON if problem.is_stepped else DESIGNS
    designs = arena.space.random(PACE, n_designs)
    arena.returns(designs, PACE, 1)  # compiles
    episodes, taken = 1, 0.0
    while taken < LONG_ENOUGH:
        episodes *= 2
        began = time.perf_counter()
        arena.returns(designs, fold(PACE, episodes), episodes)
        taken = time.perf_counter() - began
    return max(LEAST_BUDGET, int(seconds * n_designs * episodes / taken))
