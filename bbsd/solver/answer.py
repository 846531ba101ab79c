"""The answer of a run: the winner of a race between candidates that all behave differently."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from bbsd.architecture import Architecture, behavior_keys, joint_space
from bbsd.kernel.streams import fold, name_word
from bbsd.solver.race import race
from bbsd.solver.space import Space

if TYPE_CHECKING:
    from collections.abc import Iterable

    from bbsd.compiler import Problem
    from bbsd.solver.paper.generation import State
    from bbsd.solver.paper.settings import Settings

RACE = name_word("race")


def answer(state: State, problem: Problem, settings: Settings, key: int) -> Architecture:
    """Return the best of a run's candidates, by a race on episodes that no generation had."""
    entrants = candidates(state, problem, settings)
    finish = race(problem, entrants, fold(key, RACE), settings.answer.episodes)
    return entrants[finish.winner]


def candidates(state: State, problem: Problem, settings: Settings) -> list[Architecture]:
    """Return the best individuals under every meme, then the champions, and the known designs of the beginning.

    Of those that behave alike there is only the first.
    """
    best = tuple(
        pool[int(np.argmax(state.fitness[index, : len(pool)]))] for index, pool in enumerate(state.pools)
    )
    fittest_first = state.culture.memes[np.argsort(-state.culture.fitness, kind="stable")]
    composed = [Architecture(best, meme) for meme in fittest_first]
    entrants = distinct([*composed, *state.champions.architectures(problem)], problem)[
        : settings.answer.candidates
    ]
    if settings.starts is None:
        return entrants
    return distinct([*entrants, *Space(problem).architectures(settings.starts.complete())], problem)


def distinct(architectures: Iterable[Architecture], problem: Problem) -> list[Architecture]:
    """Return the first of all designs that behave alike: the same controls in every cell of the joint input space."""
    designs = list(architectures)
    keys = behavior_keys(joint_space(problem.meaning), designs)
    first: dict[bytes, Architecture] = {}
    for key, design in zip(keys, designs, strict=True):
        first.setdefault(key, design)
    return list(first.values())
