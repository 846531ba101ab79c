"""Cells that no candidate's episodes visited: what a design says for them is arbitrary."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.kernel.streams import fold, name_word
from bbsd.language.meaning import seed_key
from bbsd.runs.outcome.interim import candidates
from bbsd.solver.arena import Arena

if TYPE_CHECKING:
    from bbsd.runs.command import Command

VISITS = name_word("visits")
CANDIDATES, EPISODES = 20, 50
"""The candidates whose episodes are looked at, and the episodes of each."""


class Unvisited(NamedTuple):
    """How many of a behavior's open cells were not visited."""

    behavior: str
    cells: int
    of: int
    episodes: int
    """Of all candidates together."""


def unvisited(command: Command) -> tuple[Unvisited, ...]:
    """Return the behaviors that have open cells which no candidate was asked for; none for the paper's loop."""
    if command.settings.method == "paper":
        return ()
    arena = Arena(command.problem, command.settings.coevolution.generations)
    space = arena.space
    saved = [reached for run in range(command.n_runs) if (reached := command.reached(run))]
    groups = [designs for reached in saved for designs in candidates(reached, arena)]
    designs = groups[0].joined(*groups[1:])
    designs = designs[designs.distinct()[:CANDIDATES]]
    key, visited = fold(seed_key(command.seed), VISITS), np.zeros(len(space.given), np.bool_)
    for index in range(len(designs)):
        _, asked = arena.asked(designs[index : index + 1], key, EPISODES)
        visited |= asked.any(axis=0)
    is_open = np.zeros(len(space.given), np.bool_)
    is_open[space.open_cells] = True
    missed = np.bincount(space.behavior_of[is_open & ~visited], minlength=command.problem.n_behaviors)
    open_cells = np.bincount(space.behavior_of[is_open], minlength=command.problem.n_behaviors)
    return tuple(
        Unvisited(name, int(missed[index]), int(open_cells[index]), len(designs) * EPISODES)
        for index, name in enumerate(command.problem.names)
        if missed[index]
    )
