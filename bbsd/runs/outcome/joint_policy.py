"""What Q-learning learned before it was written as behaviors: a reference, as no design may express it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation import Agents, Interval, interval, returns_of
from bbsd.runs.storage.state import Searching
from bbsd.solver.arena import Arena
from bbsd.solver.judgement import judging_keys
from bbsd.solver.methods.q_learning.q_learning import QState

if TYPE_CHECKING:
    from bbsd.runs.command import Command


def joint_policy_returns(command: Command) -> Interval | None:
    """Return what the best joint policy of all runs earns in the episodes on which answers are judged.

    None for methods that learn none, and where no policy was measured.
    """
    states = [reached.state for run in range(command.n_runs) if (reached := command.reached(run))]
    searches = [state.search for state in states if isinstance(state, Searching)]
    learned = [
        search for search in searches if isinstance(search, QState) and not math.isnan(search.joint_mean)
    ]
    if not learned:
        return None
    best = max(learned, key=lambda search: search.joint_mean)
    arena = Arena(command.problem, command.settings.coevolution.generations)
    only = np.zeros((1, 1), np.int64)
    agents = Agents((best.joint_table[np.newaxis],), only, only)
    episodes = judging_keys(command.settings, command.seed)
    return interval(returns_of(arena.joint_control.joint_problem, agents, episodes, arena.generation)[0])
