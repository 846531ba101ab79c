"""Lifting episodes of random agents, as the arrays that every peer takes, and bbsd's kernel for the same work."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple, cast

import numpy as np

import bbsd
from bbsd.compiler import compile_meaning
from bbsd.expression.node_data import Slot
from bbsd.kernel.keys import keys
from bbsd.kernel.streams import fold, uniform, word_of
from bbsd.solver.random_agents import random_agents
from benchmarks.workloads.arrays import padded_tables
from benchmarks.workloads.specs import KEY, SPECS

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.compiler import Problem
    from benchmarks.workloads.arrays import Floats, Integers, Symbols, Words

SPEC = SPECS / "object_lifting.yaml"
STEPS, ROBOTS, BEHAVIORS, CELLS = 300, 3, 5, 6
SPEED_STEP, TOP_SPEED, GOAL, SMALL_TILT, DT, RADIUS = 1.0, 5.0, 3.0, 5.0, 0.005, 1.0


class Earnings(NamedTuple):
    """What the agents earned in an episode: returns (n_agents,), credit (n_agents, n_behaviors + 1), nobody's last."""

    returns: Floats
    credit: Floats


@dataclass(frozen=True, slots=True, eq=False)
class Workload:
    """Agents with one episode each.

    heights (n_agents, n_robots) at the start, tables (n_agents, n_behaviors, n_cells), of which smaller ones fill the
    first cells, structures (n_agents, n_layers) with the lowest layer first.
    """

    heights: Floats
    tables: Symbols
    structures: Integers

    def __len__(self) -> int:
        return len(self.heights)

    @property
    def robot_steps(self) -> int:
        """The number of steps of all robots of all agents."""
        return len(self) * STEPS * ROBOTS

    def first(self, count: int) -> Workload:
        """Return the workload of the first agents alone, for slow peers."""
        return Workload(self.heights[:count], self.tables[:count], self.structures[:count])


def lifting(n_agents: int, episodes: int) -> tuple[Workload, Callable[[], Earnings]]:
    """Return the workload of random agents with several episodes each, and the call with which bbsd computes it."""
    problem = compile_meaning(bbsd.load(SPEC).meaning)
    agents = random_agents(problem, KEY, n_agents)
    agents = agents[np.tile(np.arange(n_agents), episodes)]
    streams = keys(KEY, 0, len(agents))
    team = problem.assemble(agents.pools, agents.members, 1)

    def run() -> Earnings:
        outcome = team.episode(streams, agents.structures)
        return Earnings(outcome.returns, outcome.credit)

    heights = starting_heights(problem, streams)
    return Workload(heights, padded_tables(agents, CELLS), agents.structures), run


def starting_heights(problem: Problem, streams: Words) -> Floats:
    """Return the heights that the kernel draws at the start of an episode, (n_agents, n_robots)."""
    elementwise = cast("Callable[..., Floats]", uniform)
    start = problem.meaning.episode.start
    words = [start[Slot("height", robot)].draw.kernel_word for robot in range(ROBOTS)]
    heights = [elementwise(streams, fold(word, word_of(0)), 2.0, 3.0) for word in words]
    return np.ascontiguousarray(np.transpose(heights))
