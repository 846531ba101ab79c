"""Plain Numba, one agent at a time, as one would write it first."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numba
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

    from benchmarks.workloads.arrays import Floats
    from benchmarks.workloads.lifting import Workload

NOBODY = BEHAVIORS


@numba.njit
def tilt_of(height: Floats) -> float:
    sideways = (height[2] - height[1]) / (math.sqrt(3) * RADIUS)
    forward = (height[0] - (height[1] + height[2]) / 2) / (1.5 * RADIUS)
    return math.atan(math.sqrt(sideways * sideways + forward * forward)) * 57.29577951308232


@numba.njit
def cell_of(behavior: int, height: Floats, speed: float, robot: int, tilted: int) -> int:
    if behavior == 0:
        return 0
    if behavior == 1:
        return int(max(min(speed, 5.0), 0.0))
    if behavior == 2:
        return int(height[robot] >= GOAL)
    if height[robot] == min(height[0], height[1], height[2]):
        return tilted
    if height[robot] == max(height[0], height[1], height[2]):
        return 2 + tilted
    return 4 + tilted


@numba.njit
def speed_after(behavior: int, speed: float) -> float:
    if behavior == 0:
        return speed + SPEED_STEP
    if behavior == 1:
        return min(speed, TOP_SPEED)
    if behavior == 2:
        return 0.0
    if behavior == 3:
        return min(speed + SPEED_STEP, TOP_SPEED)
    if behavior == 4:
        return max(speed - SPEED_STEP, 0.0)
    return speed


@numba.njit
def controlling(
    tables: np.ndarray, structure: np.ndarray, height: Floats, speed: float, robot: int, tilted: int
) -> int:
    for layer in range(len(structure) - 1, -1, -1):
        behavior = structure[layer]
        if tables[behavior, cell_of(behavior, height, speed, robot, tilted)]:
            return behavior
    return NOBODY


@numba.njit
def episode(start: Floats, tables: np.ndarray, structure: np.ndarray, credit: Floats) -> float:
    height, speed = start.copy(), np.zeros(ROBOTS)
    who = np.empty(ROBOTS, np.int64)
    total, tilt = 0.0, tilt_of(height)
    for step in range(1, STEPS + 1):
        for robot in range(ROBOTS):
            who[robot] = controlling(tables, structure, height, speed[robot], robot, int(tilt > SMALL_TILT))
        for robot in range(ROBOTS):
            speed[robot] = speed_after(who[robot], speed[robot])
            height[robot] += speed[robot] * DT
        before, tilt = tilt, tilt_of(height)
        together = -0.0
        for robot in range(ROBOTS):
            earned = 1.0 if tilt - before < -0.5 else -0.1
            earned += 1 / math.sqrt(step) if tilt < SMALL_TILT else -0.1 * math.sqrt(step)
            earned += 1.0 if abs(height[robot] - GOAL) < 0.5 else -0.1
            earned += -1.0 if height[robot] > GOAL + 0.2 else 0.0
            earned += -0.1 if abs(speed[robot]) > TOP_SPEED else 0.0
            credit[who[robot]] += earned
            together += earned
        total += together
    credit /= ROBOTS
    return total / ROBOTS


@numba.njit
def lift(
    heights: Floats, tables: np.ndarray, structures: np.ndarray, returns: Floats, credit: Floats
) -> None:
    for agent in range(len(heights)):
        returns[agent] = episode(heights[agent], tables[agent], structures[agent], credit[agent])


def prepare(workload: Workload) -> Callable[[], Earnings]:
    """Prepare lifting, one agent at a time, with libm's arctangent."""

    def run() -> Earnings:
        returns, credit = np.empty(len(workload)), np.zeros((len(workload), BEHAVIORS + 1))
        lift(workload.heights, workload.tables, workload.structures, returns, credit)
        return Earnings(returns, credit)

    run()
    return run
