"""Random agents of a spec's design space, with which every design is compared."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation import Agents
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import fold, name_word, word_of
from bbsd.solver.paper.genetics import random_pool
from bbsd.solver.structures import random_structures

if TYPE_CHECKING:
    from bbsd.compiler import Problem

TABLES, STRUCTURES = name_word("random tables"), name_word("random structures")


def random_agents(problem: Problem, key: int, n_agents: int) -> Agents:
    """Return agents whose open cells and open layers are uniformly random; what the spec gives is kept."""
    pools = tuple(
        random_pool(fold(fold(key, TABLES), word_of(index)), n_agents, table.given, table.n_actions)
        for index, table in enumerate(problem.tables)
    )
    who = np.repeat(np.arange(n_agents)[:, None], problem.n_behaviors, axis=1)
    structures = random_structures(
        keys(fold(key, STRUCTURES), 0, n_agents), problem.layers, problem.candidates
    )
    return Agents(pools, who, structures)
