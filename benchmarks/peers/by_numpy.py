"""NumPy in lock-step: every operation is done for all agents at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from benchmarks.lifting import BEHAVIORS, ROBOTS, STEPS, Lived

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from benchmarks.lifting import Floats, Workload

SPEED_STEP, TOP_SPEED, GOAL, SMALL_TILT, DT, RADIUS = 1.0, 5.0, 3.0, 5.0, 0.005, 1.0
NOBODY = BEHAVIORS


def tilt_of(height: Floats) -> Floats:
    """height (n_robots, n_agents) -> (n_agents,)."""
    sideways = (height[2] - height[1]) / (np.sqrt(3) * RADIUS)
    forward = (height[0] - (height[1] + height[2]) / 2) / (1.5 * RADIUS)
    angle: Floats = np.degrees(np.arctan(np.sqrt(sideways * sideways + forward * forward)))
    return angle


def cells_of(height: Floats, speed: Floats, tilt: Floats) -> npt.NDArray[np.int64]:
    """The cell of each behavior, (n_behaviors, n_robots, n_agents)."""
    place = np.where(height == height.min(axis=0), 0, np.where(height == height.max(axis=0), 1, 2))
    seen = place * 2 + (tilt > SMALL_TILT)
    pace = np.clip(speed, 0, 5).astype(np.int64)
    return np.stack([np.zeros_like(seen), pace, (height >= GOAL).astype(np.int64), seen, seen])


def rewards_of(height: Floats, speed: Floats, tilt: Floats, before: Floats, step: int) -> Floats:
    """What each robot earned, (n_robots, n_agents)."""
    leveling = np.where(tilt - before < -0.5, 1.0, -0.1)
    level = np.where(tilt < SMALL_TILT, 1 / np.sqrt(step), -0.1 * np.sqrt(step))
    earned: Floats = leveling + level + np.where(np.abs(height - GOAL) < 0.5, 1.0, -0.1)
    earned += np.where(height > GOAL + 0.2, -1.0, 0.0)
    earned += np.where(np.abs(speed) > TOP_SPEED, -0.1, 0.0)
    return earned


def lift(workload: Workload) -> Lived:
    """One episode of every agent."""
    agents = np.arange(len(workload))
    tables, layers = workload.tables.transpose(1, 2, 0).copy(), workload.structures.T
    height, speed = workload.heights.T.copy(), np.zeros((ROBOTS, len(workload)))
    total, credit = np.zeros(len(workload)), np.zeros((BEHAVIORS + 1, len(workload)))
    tilt = tilt_of(height)
    for step in range(1, STEPS + 1):
        cells = cells_of(height, speed, tilt)
        active = tables[np.arange(BEHAVIORS)[:, None, None], cells, agents]
        who = np.full((ROBOTS, len(workload)), NOBODY)
        for behavior in layers:  # lowest first: higher ones write over it
            who = np.where(active[behavior, :, agents].T > 0, behavior, who)
        more, less = speed + SPEED_STEP, np.maximum(speed - SPEED_STEP, 0.0)
        capped = np.minimum(speed, TOP_SPEED), np.minimum(more, TOP_SPEED)
        speed = np.choose(who, [more, capped[0], np.zeros_like(speed), capped[1], less, speed])
        height = height + speed * DT
        before, tilt = tilt, tilt_of(height)
        earned = rewards_of(height, speed, tilt, before, step)
        total += earned.sum(axis=0)
        for behavior in range(BEHAVIORS + 1):
            credit[behavior] += np.where(who == behavior, earned, 0.0).sum(axis=0)
    return Lived(total / ROBOTS, credit.T / ROBOTS)


def prepare(workload: Workload) -> Callable[[], Lived]:
    """All agents at once, with NumPy's arctangent."""
    return lambda: lift(workload)
