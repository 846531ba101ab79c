"""The best design of runs that are not complete: a short race between the best of each."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from bbsd.evaluation.sums import mean
from bbsd.kernel.streams import fold, name_word
from bbsd.language.meaning import seed_key
from bbsd.runs.storage.state import Searching
from bbsd.solver.answer import distinct
from bbsd.solver.arena import Arena
from bbsd.solver.race import still_running
from bbsd.solver.space import Designs

if TYPE_CHECKING:
    from bbsd.architecture import Architecture
    from bbsd.runs.command import Command
    from bbsd.runs.storage.state import RunState

INTERIM = name_word("interim race")
CHAMPIONS = 20
"""Champions of each run that take part."""
SECONDS = 0.3
"""The time of the race; a command that was interrupted is to end soon."""
FIRST_ROUND, MOST = 20, 20_000
"""Episodes of the first round, and of the whole race for each design."""


class Interim(NamedTuple):
    """The winner, and its mean return in the race."""

    architecture: Architecture
    mean: float
    episodes: int


def best_so_far(command: Command) -> Interim | None:
    """Return the best of what runs have saved, by a race that time ends; None where nothing was saved.

    Its choice depends on the clock, but nothing that a resumed run does depends on it.
    """
    arena = Arena(command.problem, command.settings.coevolution.generations)
    saved = [command.reached(run) for run in range(command.n_runs)]
    designs = [group for reached in saved if reached for group in candidates(reached, arena)]
    if not sum(map(len, designs)):
        return None
    entrants = designs[0].joined(*designs[1:])
    running = arena.space.designs(distinct(arena.space.architectures(entrants), arena.problem))
    key = fold(seed_key(command.seed), INTERIM)
    earned = np.empty((len(running), 0))
    end = time.monotonic() + SECONDS
    while earned.shape[1] < MOST and (not earned.shape[1] or (len(running) > 1 and time.monotonic() < end)):
        done = earned.shape[1]
        earned = np.hstack([earned, arena.returns(running, key, max(done, FIRST_ROUND), first=done)])
        kept = still_running(earned)
        running, earned = running[kept], earned[kept]
    best = int(np.argmax([mean(returns) for returns in earned]))
    (winner,) = arena.space.architectures(running[best : best + 1])
    return Interim(winner, mean(earned[best]), earned.shape[1])


def candidates(reached: RunState, arena: Arena) -> list[Designs]:
    """Return the answer of a run, the best that was measured, and its champions."""
    state = reached.state
    champions = state.search.champions if isinstance(state, Searching) else state.champions
    designs = [Designs(champions.tables[:CHAMPIONS], champions.structures[:CHAMPIONS])]
    if isinstance(state, Searching):
        designs.insert(0, state.best)
    if reached.answer is not None:
        designs.insert(0, arena.space.designs([reached.answer]))
    return designs
