"""The work that every peer does: lifting episodes of random agents, as plain arrays; and bbsd doing it."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np
import numpy.typing as npt

import bbsd
from bbsd.compiler import compile_meaning
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import fold, name_word, uniform, word_of
from bbsd.solver.random_agents import random_agents

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.compiler import Problem

SPECS = Path(__file__).parents[1] / "specs"
SPEC = SPECS / "object_lifting.yaml"
STEPS, ROBOTS, BEHAVIORS, CELLS = 300, 3, 5, 6
KEY = name_word("benchmarks")
TOP_BIT = 1 << 63

Floats = npt.NDArray[np.float64]


class Lived(NamedTuple):
    """What an episode of each agent came to: returns (n_agents,), credit (n_agents, n_behaviors + 1)."""

    returns: Floats
    credit: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Workload:
    """Agents with one episode each.

    heights (n_agents, n_robots) to start with, tables (n_agents, n_behaviors, n_cells), the cells of smaller tables
    first, structures (n_agents, n_layers) lowest layer first.
    """

    heights: Floats
    tables: npt.NDArray[np.uint8]
    structures: npt.NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.heights)

    @property
    def robot_steps(self) -> int:
        """What all of it amounts to."""
        return len(self) * STEPS * ROBOTS

    def first(self, count: int) -> Workload:
        """A part of it, for slow peers."""
        return Workload(self.heights[:count], self.tables[:count], self.structures[:count])


def lifting(n_agents: int, episodes: int) -> tuple[Workload, Callable[[], Lived]]:
    """The workload, each agent in as many episodes, and bbsd's kernel ready to live it."""
    problem = compile_meaning(bbsd.load(SPEC).meaning)
    agents = random_agents(problem, KEY, n_agents)
    agents = agents[np.tile(np.arange(n_agents), episodes)]
    streams = keys(KEY, 0, len(agents))
    team = problem.assemble(agents.pools, agents.members, 1)

    def live() -> Lived:
        outcome = team.episode(streams, agents.structures)
        return Lived(outcome.returns, outcome.credit)

    tables = np.zeros((len(agents), BEHAVIORS, CELLS), np.uint8)
    for index, pool in enumerate(agents.pools):
        tables[:, index, : pool.shape[1]] = pool[agents.members[:, index]]
    return Workload(starting_heights(problem, streams), tables, agents.structures), live


def starting_heights(problem: Problem, streams: npt.NDArray[np.uint64]) -> Floats:
    """What the kernel draws for each robot at the start of an episode; (n_agents, n_robots)."""
    elementwise = cast("Callable[..., Floats]", uniform)
    start = problem.meaning.episode.start
    words = [cast("tuple[str, int]", start["height", robot, ()].data)[1] for robot in range(ROBOTS)]
    drawn = [elementwise(streams, fold(word | TOP_BIT, word_of(0)), 2.0, 3.0) for word in words]
    return np.ascontiguousarray(np.transpose(drawn))
