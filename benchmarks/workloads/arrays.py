"""Agents as plain arrays, for programs that know nothing of bbsd."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    from bbsd.evaluation import Agents

Floats = npt.NDArray[np.float64]
Integers = npt.NDArray[np.int64]
Symbols = npt.NDArray[np.uint8]
Words = npt.NDArray[np.uint64]


def padded_tables(agents: Agents, n_cells: int) -> Symbols:
    """Return the agents' tables (n_agents, n_behaviors, n_cells); smaller tables fill the first cells."""
    tables = np.zeros((len(agents), len(agents.pools), n_cells), np.uint8)
    for index, pool in enumerate(agents.pools):
        tables[:, index, : pool.shape[1]] = pool[agents.members[:, index]]
    return tables
