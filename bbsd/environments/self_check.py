"""Whether an environment gives the same episodes again, by trying it before a design relies on it.

Four short episodes are run once more in the same environments, in lanes in another order, and in a fresh process.
"""

from __future__ import annotations

import time
from concurrent.futures import BrokenExecutor
from hashlib import sha256
from math import isfinite
from typing import TYPE_CHECKING

import numpy as np

from bbsd.environments.opening import opened_again
from bbsd.environments.spaces.kinds import Box, Discrete, MultiDiscrete, Several
from bbsd.kernel.keys import keys, units
from bbsd.kernel.streams import fold, name_word

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Sequence
    from concurrent.futures import Future

    import numpy.typing as npt

    from bbsd.environments.lanes.common import Lanes
    from bbsd.environments.opening import Opened
    from bbsd.environments.spaces.kinds import Space
    from bbsd.environments.spaces.matching import Setting
    from bbsd.text import Data

    Submit = Callable[..., Future[list[str]]]
    """Calls a function in a fresh process."""
    Values = list[list[float]]
    """For each value that is sent, those that are tried."""

KEY = name_word("self-check of an environment")
N_EPISODES = 4
MOST_STEPS = 50
ENOUGH = 1.0
"""Seconds after which the first run of the episodes goes no further; the others go as far as it did."""
TRIED = 16
"""Values that are tried of each action for which the spec names none."""


def self_check(opened: Opened, settings: Iterable[Setting], submit: Submit | None = None) -> str:
    """Return why an environment's episodes cannot be repeated, in words; '' where all were the same.

    Args:
        opened: the environment.
        settings: the literal values that the spec gives to state, which are sent where there are some for each action.
        submit: calls a function in a fresh process; without it none is tried.
    """
    values, order = values_to_send(opened, settings), list(range(N_EPISODES))
    lanes = opened.stepper()
    began = time.monotonic()
    first, n_steps = episodes_of(lanes, opened, values, order, MOST_STEPS, began + ENOUGH)
    fresh = submit and submit(in_fresh_process, opened.recipe.plain(), opened.plain(), values, n_steps)
    again, _ = episodes_of(lanes, opened, values, order, n_steps)
    if again != first:
        return "the same seed gave another episode the second time"
    backwards, _ = episodes_of(opened.stepper(), opened, values, order[::-1], n_steps)
    if backwards != first:
        return "the same seed gave another episode after others"
    try:
        if fresh is not None and fresh.result() != first:
            return "the same seed gave another episode in a fresh process"
    except BrokenExecutor:
        return "a fresh process ended while it ran an episode"
    return ""


def in_fresh_process(
    recipe: dict[str, Data], expected: dict[str, str], values: Values, n_steps: int
) -> list[str]:
    """Return the digests of the episodes, in a process that has not imported the environment before."""
    opened = opened_again(recipe, expected)
    return episodes_of(opened.stepper(), opened, values, list(range(N_EPISODES)), n_steps)[0]


def episodes_of(
    stepper: Lanes,
    opened: Opened,
    values: Values,
    order: Sequence[int],
    most_steps: int,
    deadline: float | None = None,
) -> tuple[list[str], int]:
    """Run the episodes, episode `order[lane]` in each lane, and return their digests and how many steps they had.

    Lanes are stepped in this order; what is sent follows from the episode alone.
    """
    robots = opened.recipe.robots
    rows = (stepper.dealings.n_fields + 1) * robots + 1
    outside = np.zeros((rows, N_EPISODES))
    streams = keys(KEY, 0, N_EPISODES)[np.array(order)]
    digests = [sha256() for _ in order]
    lanes = np.arange(N_EPISODES)
    stepper.reset(lanes, streams, outside)
    steps = 0
    while True:
        for lane in lanes.tolist():
            digests[order[lane]].update(np.ascontiguousarray(outside[:, lane]).tobytes())
        lanes = lanes[outside[-1, lanes] == 0.0]
        if steps >= most_steps or not lanes.size or (deadline is not None and time.monotonic() > deadline):
            return [digest.hexdigest() for digest in digests], steps
        steps += 1
        stepper.step(lanes, _sent(streams, steps, values, robots), outside)


def values_to_send(opened: Opened, settings: Iterable[Setting]) -> Values:
    """Return the values that are tried for each action: those that the spec names, else some of the space."""
    named: dict[str, dict[float, None]] = {}
    for setting in settings:
        named.setdefault(setting.name, {})[setting.value] = None
    actions = opened.recipe.outside.actions
    if all(action in named for action in actions) or opened.taken is None:
        return [list(named.get(action, {0.0: None})) for action in actions]
    return [_some_values(opened.taken, index) for index in range(len(actions))]


def _some_values(space: Space, index: int) -> list[float]:
    match space:
        case Discrete(n, start):
            return [float(start + value) for value in range(min(n, TRIED))]
        case MultiDiscrete(ns, starts):
            return _some_values(Discrete(ns[index], starts[index]), 0)
        case Box(_, lows, highs):
            low, high = lows[index], highs[index]
            low = low if isfinite(low) else min(high, -1.0)
            high = high if isfinite(high) else max(low, 1.0)
            return [low, high]
        case Several(parts):
            return _some_values(parts[index], 0)
    return [0.0]


def _sent(streams: npt.NDArray[np.uint64], step: int, values: Values, robots: int) -> npt.NDArray[np.float64]:
    rows = []
    for index, choices in enumerate(values):
        for robot in range(robots):
            word = name_word(f"{index} {robot} {step}")
            drawn = units(np.array([fold(int(stream), word) for stream in streams], np.uint64))
            rows.append([choices[int(unit * len(choices))] for unit in drawn])
    return np.array(rows).reshape(len(values) * robots, len(streams))
