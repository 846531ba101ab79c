"""Robots that do the same: pairs of a team compared step by step in traces."""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

from bbsd.evaluation import trace
from bbsd.explanation.worth.results import RobotsAlike

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from bbsd.architecture import Architecture
    from bbsd.compiler import Problem
    from bbsd.evaluation import Scene, Trace

TRACED = 10
"""Episodes that are traced."""
MOST_ROBOTS = 12
"""Robots of a team that is looked at; traces of larger ones take too long."""
ALIKE_PLACE, ALIKE_ACTION = 0.95, 0.99
"""Shares of steps from which on two robots are called alike: in the same place or state, or with the same action."""


def robots_alike(
    problem: Problem, architecture: Architecture, keys: NDArray[np.uint64], generation: int
) -> tuple[RobotsAlike, ...]:
    """Return all pairs of robots with how often they did the same; none where there are too many robots to look at."""
    robots = problem.meaning.spec.environment.robots
    if not 1 < robots <= MOST_ROBOTS:
        return ()
    traces = [trace(problem, architecture, int(key), generation) for key in keys[:TRACED]]
    steps = sum(len(each.steps) for each in traces)
    state, has_view = list(problem.meaning.spec.environment.of_each_robot), traces[0].scene is not None
    return tuple(
        RobotsAlike(
            first,
            second,
            sum(_same_actions(each, first, second) for each in traces) / steps,
            sum(_same_states(each, state, first, second) for each in traces) / steps,
            sum(_same_places(each.scene, first, second) for each in traces if each.scene) / steps
            if has_view
            else None,
            len(traces),
        )
        for first, second in combinations(range(robots), 2)
    )


def are_alike(pair: RobotsAlike) -> bool:
    """Return whether two robots did the same, or were in the same state or place, nearly always."""
    together = max(pair.same_state, pair.same_place or 0.0)
    return together >= ALIKE_PLACE or pair.same_action >= ALIKE_ACTION


def _same_actions(traced: Trace, first: int, second: int) -> int:
    pairs = zip(
        traced.controlling[first],
        traced.actions[first],
        traced.controlling[second],
        traced.actions[second],
        strict=True,
    )
    return sum(who == other and action == theirs for who, action, other, theirs in pairs)


def _same_places(drawn: Scene, first: int, second: int) -> int:
    """Return the number of steps after which two robots stood in the same place."""
    same = np.equal(drawn.places[first, 1:, :2], drawn.places[second, 1:, :2])
    return int(same.all(axis=1).sum())


def _same_states(traced: Trace, state: Sequence[str], first: int, second: int) -> int:
    """Return the number of steps after which all state of two robots was equal, none where robots have no state."""
    own = [slot for slot in traced.values if slot.robot == first and slot.name in state]
    if not own:
        return 0
    columns = [np.array([traced.values[slot], traced.values[slot._replace(robot=second)]]) for slot in own]
    return int(np.logical_and.reduce([mine == theirs for mine, theirs in columns]).sum())
