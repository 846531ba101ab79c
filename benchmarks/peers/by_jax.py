"""JAX on the CPU: one agent's episode as a scan over steps, mapped over agents, compiled."""

from __future__ import annotations

from functools import partial, reduce
from typing import TYPE_CHECKING, Any

import jax
import numpy as np
from jax import lax
from jax import numpy as jnp

from benchmarks.lifting import BEHAVIORS, ROBOTS, STEPS, Lived

if TYPE_CHECKING:
    from collections.abc import Callable

    from benchmarks.lifting import Workload

SPEED_STEP, TOP_SPEED, GOAL, SMALL_TILT, DT, RADIUS = 1.0, 5.0, 3.0, 5.0, 0.005, 1.0
Array = Any


def tilt_of(height: list[Array]) -> Array:
    sideways = (height[2] - height[1]) / (np.sqrt(3) * RADIUS)
    forward = (height[0] - (height[1] + height[2]) / 2) / (1.5 * RADIUS)
    return jnp.degrees(jnp.arctan(jnp.sqrt(sideways * sideways + forward * forward)))


def decide(words: Array, priorities: Array, height: list[Array], robot: int, speed: Array, tilted: Array) -> Array:
    """Which behavior controls a robot, BEHAVIORS where none; a table is the bits of a word, which beats a gather."""
    lowest, highest = reduce(jnp.minimum, height), reduce(jnp.maximum, height)
    place = jnp.where(height[robot] == lowest, 0, jnp.where(height[robot] == highest, 1, 2))
    seen = place * 2 + tilted
    cells = [0, jnp.clip(speed, 0, 5).astype(jnp.int64), (height[robot] >= GOAL).astype(jnp.int64), seen, seen]
    bids = [jnp.where((words[k] >> cell) & 1 > 0, priorities[k], 0) for k, cell in enumerate(cells)]
    best = reduce(jnp.maximum, bids)
    return jnp.where(best > 0, best & 7, BEHAVIORS)


def act(who: Array, speed: Array) -> Array:
    more = speed + SPEED_STEP
    options = [more, jnp.minimum(speed, TOP_SPEED), jnp.zeros_like(speed), jnp.minimum(more, TOP_SPEED)]
    options.append(jnp.maximum(speed - SPEED_STEP, 0.0))
    return jnp.select([who == behavior for behavior in range(BEHAVIORS)], options, speed)


def reward(height: Array, speed: Array, shared: Array) -> Array:
    earned = shared + jnp.where(jnp.abs(height - GOAL) < 0.5, 1.0, -0.1)
    earned = earned + jnp.where(height > GOAL + 0.2, -1.0, 0.0)
    return earned + jnp.where(jnp.abs(speed) > TOP_SPEED, -0.1, 0.0)


def advance(words: Array, priorities: Array, state: Array, root: Array) -> tuple[Array, None]:
    height, speed, tilt, total, credit = state
    tilted = (tilt > SMALL_TILT).astype(jnp.int64)
    who = [decide(words, priorities, height, robot, speed[robot], tilted) for robot in range(ROBOTS)]
    speed = [act(*pair) for pair in zip(who, speed, strict=True)]
    height = [h + s * DT for h, s in zip(height, speed, strict=True)]
    before, tilt = tilt, tilt_of(height)
    shared = jnp.where(tilt - before < -0.5, 1.0, -0.1) + jnp.where(tilt < SMALL_TILT, 1 / root, -0.1 * root)
    earned = [reward(h, s, shared) for h, s in zip(height, speed, strict=True)]
    for robot in range(ROBOTS):
        credit = [each + jnp.where(who[robot] == k, earned[robot], 0.0) for k, each in enumerate(credit)]
    return (height, speed, tilt, total + sum(earned), credit), None


def episode(height: Array, words: Array, priorities: Array) -> tuple[Array, Array]:
    heights, none = [height[robot] for robot in range(ROBOTS)], jnp.zeros(())
    state = (heights, [none] * ROBOTS, tilt_of(heights), none, [none] * (BEHAVIORS + 1))
    roots = jnp.sqrt(jnp.arange(1.0, STEPS + 1))
    state, _ = lax.scan(partial(advance, words, priorities), state, roots)
    return state[3] / ROBOTS, jnp.stack(state[4]) / ROBOTS


def prepare(workload: Workload) -> Callable[[], Lived]:
    """All agents mapped and compiled, with XLA's arctangent."""
    jax.config.update("jax_platforms", "cpu")
    jax.config.update("jax_enable_x64", True)
    shifts = np.arange(workload.tables.shape[2])
    words = (workload.tables.astype(np.int64) << shifts).sum(axis=2)
    layers = np.arange(1, BEHAVIORS + 1) * 8
    priorities = np.empty((len(workload), BEHAVIORS), np.int64)
    np.put_along_axis(priorities, workload.structures, layers + workload.structures, axis=1)
    arguments = [jnp.asarray(array) for array in (workload.heights, words, priorities)]
    compiled = jax.jit(jax.vmap(episode)).lower(*arguments).compile()

    def live() -> Lived:
        returns, credit = compiled(*arguments)
        return Lived(np.asarray(returns), np.asarray(credit))

    return live
