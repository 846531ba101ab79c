"""The situations that robots meet in episodes of a design: joint cells, and how often each was visited.

A recorder for each dimension of the joint space stands above all layers. It is a behavior that is always excited and
never acts, so a rollout for practice tells its cell at every step, however large the joint space is.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import prod
from typing import TYPE_CHECKING

import numpy as np

from bbsd.errors import UsageError
from bbsd.expression.kinds import Kind
from bbsd.language.meaning.behaviors import Module
from bbsd.language.meaning.structure import Structure
from bbsd.language.meaning.tables.table import NO_ACTION, Table

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.architecture import Architecture, JointSpace
    from bbsd.compiler import Problem
    from bbsd.compiler.steps import Steps
    from bbsd.language.meaning import Meaning

    Cells = NDArray[np.int64]

MOST_NUMBERS = 20_000_000
"""Numbers of the record of a batch of lanes, so that memory holds it."""


class TooLongToWatch(UsageError):
    """An episode with more steps, robots and inputs than can be recorded."""


@dataclass(frozen=True, slots=True, eq=False)
class Situations:
    """Different situations in lexical order, each once.

    `cells` (n_situations, n_dimensions) are the indices of the joint space's dimensions, `visits` (n_situations,) the
    robot-steps that began in each.
    """

    cells: Cells
    visits: NDArray[np.int64]
    episodes: int
    """The episodes that were watched."""

    @property
    def steps(self) -> int:
        """All robot-steps."""
        return int(self.visits.sum())


def situations(
    problem: Problem,
    space: JointSpace,
    architecture: Architecture,
    streams: NDArray[np.uint64],
    generation: int,
) -> Situations:
    """Run episodes of a design and return the situations in which its robots decided.

    Args:
        problem: the spec.
        space: its joint space.
        architecture: the design.
        streams: the keys of the episodes, (n_episodes,).
        generation: in whose constants they run.

    Raises:
        TooLongToWatch: even the record of a single episode would be too large.
    """
    watched = _watched(problem, space, architecture)
    n_behaviors, n_dimensions = problem.n_behaviors, len(space.sizes)
    pools = tuple(table[None] for table in architecture.tables)
    recorders = tuple(np.full((1, size), NO_ACTION, np.uint8) for size in space.sizes)
    members = np.zeros((len(streams), n_behaviors + n_dimensions), np.int64)
    team = watched.assemble((*pools, *recorders), members, generation)
    structure = np.concatenate([architecture.structure, np.arange(n_dimensions) + n_behaviors])
    first_pairs = np.cumsum([0, *(table.n_cells * (table.n_actions + 1) for table in watched.tables)])
    own_first = first_pairs[n_behaviors:-1]
    found: list[tuple[Cells, NDArray[np.int64]]] = []

    def learn(steps: Steps, steps_taken: NDArray[np.float64]) -> None:
        asked = steps.asked[:, :, n_behaviors:, : len(steps_taken)].transpose(0, 1, 3, 2)
        taken = np.arange(len(asked))[:, None, None] < steps_taken
        pairs = asked[np.broadcast_to(taken, asked.shape[:3])] >> 1
        found.append(counted((pairs - own_first) // 2, space.sizes))

    n_lanes = len(streams)
    no_rates, no_cells = np.zeros(n_lanes), np.zeros(sum(table.n_cells for table in watched.tables), np.uint8)
    team.practice(streams, np.tile(structure, (n_lanes, 1)), no_rates, no_cells, learn)
    cells, visits = (np.concatenate(parts) for parts in zip(*found, strict=True))
    return Situations(*counted(cells, space.sizes, visits), n_lanes)


def counted(
    cells: Cells, sizes: Sequence[int], visits: NDArray[np.int64] | None = None
) -> tuple[Cells, NDArray[np.int64]]:
    """Return each different row of cells (n, n_dimensions) once, in lexical order, and its visits in all.

    A row counts once, or as often as `visits` (n,) says.
    """
    if not sizes:
        return cells[:1], np.array([len(cells) if visits is None else visits.sum()], np.int64)
    if prod(sizes) < np.iinfo(np.int64).max:
        numbers, inverse = np.unique(np.ravel_multi_index(tuple(cells.T), tuple(sizes)), return_inverse=True)
        rows = np.stack(np.unravel_index(numbers, tuple(sizes)), axis=1)
    else:
        rows, inverse = np.unique(cells, axis=0, return_inverse=True)
    totals = np.zeros(len(rows), np.int64)
    np.add.at(totals, inverse.ravel(), 1 if visits is None else visits)
    return rows, totals


def _watched(problem: Problem, space: JointSpace, architecture: Architecture) -> Problem:
    """Return the problem with all cells given and a recorder for each dimension, and lanes that memory has room for."""
    meaning, environment = problem.meaning, problem.meaning.spec.environment
    given = tuple(
        replace(module, table=Table(table.tobytes()))
        for module, table in zip(meaning.episode.modules, architecture.tables, strict=True)
    )
    recorders = _recorders(meaning, space)
    structure = Structure(
        (*architecture.structure.tolist(), *range(len(given), len(given) + len(recorders))), ()
    )
    episode = replace(meaning.episode, modules=(*given, *recorders))
    numbers = environment.steps * environment.robots * (len(given) + len(recorders) + 2)
    if numbers > MOST_NUMBERS:
        raise TooLongToWatch(f"an episode has {environment.steps:,} steps, too many to record")
    lanes = min(problem.lanes, MOST_NUMBERS // numbers)
    return replace(problem, lanes=lanes).with_meaning(replace(meaning, episode=episode, structure=structure))


def _recorders(meaning: Meaning, space: JointSpace) -> tuple[Module, ...]:
    graph, first = meaning.graph, meaning.episode.modules[0]
    action, sets = next(iter(first.actions.items()))
    always = tuple(graph.truth(value=True) for _ in first.excited)
    return tuple(
        Module(
            f"recorder_{index}",
            {"cell": labels},
            tuple((graph.apply("cell_of", node) if node.kind is Kind.TRUTH else node,) for node in nodes),
            always,
            {action: sets},
            Table(bytes([NO_ACTION] * len(labels))),
        )
        for index, (labels, nodes) in enumerate(zip(space.dimensions.values(), space.nodes, strict=True))
    )
