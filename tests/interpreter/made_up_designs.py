"""Architectures made up at random for a compiled problem."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from tests.interpreter.cells import OPEN_CELL

if TYPE_CHECKING:
    import numpy.typing as npt

    from bbsd.compiler import Problem

OPEN_LAYER = -1


@dataclass(frozen=True)
class Agents:
    """Pools, which individuals of them each agent is made of, its structure, and the key of its episode."""

    pools: list[npt.NDArray[np.uint8]]
    members: npt.NDArray[np.int64]
    structures: npt.NDArray[np.int64]
    keys: npt.NDArray[np.uint64]


def random_agents(problem: Problem, n_agents: int, seed: int) -> Agents:
    """Agents of random tables that keep the given cells, and random structures that keep the given layers."""
    rng = np.random.default_rng(seed)
    pools = [random_pool(rng, table.given, table.n_actions) for table in problem.tables]
    members = np.column_stack([rng.integers(len(pool), size=n_agents) for pool in pools])
    structures = np.array([random_structure(rng, problem) for _ in range(n_agents)])
    return Agents(pools, members, structures, rng.integers(2**64, size=n_agents, dtype=np.uint64))


def random_pool(
    rng: np.random.Generator, given: npt.NDArray[np.uint8], n_actions: int
) -> npt.NDArray[np.uint8]:
    drawn = rng.integers(n_actions + 1, size=(3, len(given)), dtype=np.uint8)
    return np.where(given == OPEN_CELL, drawn, given)


def random_structure(rng: np.random.Generator, problem: Problem) -> npt.NDArray[np.int64]:
    structure = problem.layers.copy()
    open_layers = structure == OPEN_LAYER
    structure[open_layers] = rng.permutation(problem.candidates)[: open_layers.sum()]
    return structure
