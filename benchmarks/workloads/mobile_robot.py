"""Episodes of the mobile robot with random agents, as arrays for peers, and bbsd's kernel for the same work."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

import bbsd
from bbsd.compiler import compile_meaning
from bbsd.expression.node_data import Slot
from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents
from benchmarks.workloads.arrays import padded_tables
from benchmarks.workloads.specs import KEY, SPECS

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.compiler import Problem
    from bbsd.expression.graph import Node
    from benchmarks.workloads.arrays import Floats, Integers, Symbols, Words

SPEC = SPECS / "mobile_robot.yaml"
CELLS, SONARS, EYES = 8, 8, 4


class Workload(NamedTuple):
    """Agents with one episode each.

    keys (n_agents,) name their random streams, words (4 + 1 + 8 + 4,) the draws in them; tables (n_agents, n_behaviors,
    n_cells), of which smaller ones fill the first cells, structures (n_agents, n_layers) with the lowest layer first.
    """

    keys: Words
    words: Words
    tables: Symbols
    structures: Integers


def mobile_robot(n_agents: int) -> tuple[Workload, Callable[[], Floats]]:
    """Return the workload of random agents, and the call with which bbsd computes their returns."""
    problem = compile_meaning(bbsd.load(SPEC).meaning)
    agents, streams = random_agents(problem, KEY, n_agents), keys(KEY, 0, n_agents)
    team = problem.assemble(agents.pools, agents.members, 1)
    workload = Workload(streams, draw_words(problem), padded_tables(agents, CELLS), agents.structures)
    return workload, lambda: team.episode(streams, agents.structures).returns


def draw_words(problem: Problem) -> Words:
    """Return the names of the draws of the starting values, then of those in each step."""
    episode = problem.meaning.episode
    started = [episode.start[Slot(name, 0)] for name in ("x", "y", "heading", "whim")]
    sonars = [Slot("sonar", 0, (index,)) for index in range(SONARS)]
    eyes = [Slot("light", 0, (index,)) for index in range(EYES)]
    drawn = [only_draw(episode.after[slot]) for slot in [Slot("whim", 0), *sonars, *eyes]]
    return np.array([node.draw.kernel_word for node in (*started, *drawn)], np.uint64)


def only_draw(node: Node) -> Node:
    """Return the one draw in an expression; raise ValueError if there is none, or more."""
    if node.operation == "draw":
        return node
    [draw] = {id(draw): draw for draw in map(_draw_or_none, node.operands) if draw is not None}.values()
    return draw


def _draw_or_none(node: Node) -> Node | None:
    try:
        return only_draw(node)
    except ValueError:
        return None
