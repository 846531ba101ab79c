"""NumPy in lock-step: every operation acts on all agents at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from benchmarks.workloads.lifting import (
    BEHAVIORS,
    DT,
    GOAL,
    RADIUS,
    ROBOTS,
    SMALL_TILT,
    SPEED_STEP,
    STEPS,
    TOP_SPEED,
    Earnings,
)

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy.typing as npt

    from benchmarks.workloads.arrays import Floats
    from benchmarks.workloads.lifting import Workload

NOBODY = BEHAVIORS


def tilt_of(height: Floats) -> Floats:
    """Return the tilt in degrees, (n_agents,), of heights (n_robots, n_agents)."""
    sideways = (height[2] - height[1]) / (np.sqrt(3) * RADIUS)
    forward = (height[0] - (height[1] + height[2]) / 2) / (1.5 * RADIUS)
    angle: Floats = np.degrees(np.arctan(np.sqrt(sideways * sideways + forward * forward)))
    return angle


def cells_of(height: Floats, speed: Floats, tilt: Floats) -> npt.NDArray[np.int64]:
    """Return the cell of each behavior, (n_behaviors, n_robots, n_agents)."""
    place = np.where(height == height.min(axis=0), 0, np.where(height == height.max(axis=0), 1, 2))
    situation = place * 2 + (tilt > SMALL_TILT)
    pace = np.clip(speed, 0, 5).astype(np.int64)
    return np.stack([np.zeros_like(situation), pace, (height >= GOAL).astype(np.int64), situation, situation])


def rewards_of(height: Floats, speed: Floats, tilt: Floats, before: Floats, step: int) -> Floats:
    """Return the reward of each robot, (n_robots, n_agents)."""
    leveling = np.where(tilt - before < -0.5, 1.0, -0.1)
    level = np.where(tilt < SMALL_TILT, 1 / np.sqrt(step), -0.1 * np.sqrt(step))
    earned: Floats = leveling + level + np.where(np.abs(height - GOAL) < 0.5, 1.0, -0.1)
    earned += np.where(height > GOAL + 0.2, -1.0, 0.0)
    earned += np.where(np.abs(speed) > TOP_SPEED, -0.1, 0.0)
    return earned


def lift(workload: Workload) -> Earnings:
    """Run one episode of every agent."""
    agents = np.arange(len(workload))
    tables, layers = workload.tables.transpose(1, 2, 0).copy(), workload.structures.T
    height, speed = workload.heights.T.copy(), np.zeros((ROBOTS, len(workload)))
    total, credit = np.zeros(len(workload)), np.zeros((BEHAVIORS + 1, len(workload)))
    tilt = tilt_of(height)
    for step in range(1, STEPS + 1):
        cells = cells_of(height, speed, tilt)
        active = tables[np.arange(BEHAVIORS)[:, None, None], cells, agents]
        who = np.full((ROBOTS, len(workload)), NOBODY)
        for behavior in layers:  # lowest first: higher ones overwrite it
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
    return Earnings(total / ROBOTS, credit.T / ROBOTS)


def prepare(workload: Workload) -> Callable[[], Earnings]:
    """Prepare lifting, all agents at once, with NumPy's arctangent."""
    return lambda: lift(workload)
