"""JAX on the CPU: one agent's episode as a scan over steps, mapped over agents (vmap in `lax.map`), compiled."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import jax
import numpy as np
from jax import lax
from jax import numpy as jnp

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

    from benchmarks.workloads.lifting import Workload

Array = Any


def tilt_of(height: Array) -> Array:
    """Return the tilt in degrees of heights (n_robots,)."""
    sideways = (height[2] - height[1]) / (np.sqrt(3) * RADIUS)
    forward = (height[0] - (height[1] + height[2]) / 2) / (1.5 * RADIUS)
    return jnp.degrees(jnp.arctan(jnp.sqrt(sideways * sideways + forward * forward)))


def decide(words: Array, priorities: Array, height: Array, speed: Array, tilt: Array) -> Array:
    """Return the behavior that controls each robot, BEHAVIORS for none.

    A table is the bits of a word, since shifts are faster than a gather.
    """
    place = jnp.where(height == height.min(), 0, jnp.where(height == height.max(), 1, 2))
    situation = place * 2 + (tilt > SMALL_TILT)
    pace = jnp.clip(speed, 0, 5).astype(jnp.int64)
    cells = jnp.stack(
        [jnp.zeros_like(situation), pace, (height >= GOAL).astype(jnp.int64), situation, situation]
    )
    active = (words[:, None] >> cells) & 1
    highest = jnp.where(active > 0, priorities[:, None], 0).max(axis=0)
    return jnp.where(highest > 0, highest & 7, BEHAVIORS)


def act(who: Array, speed: Array) -> Array:
    more, less = speed + SPEED_STEP, jnp.maximum(speed - SPEED_STEP, 0.0)
    options = [more, jnp.minimum(speed, TOP_SPEED), jnp.zeros_like(speed), jnp.minimum(more, TOP_SPEED), less]
    return jnp.select([who == behavior for behavior in range(BEHAVIORS)], options, speed)


def advance(words: Array, priorities: Array, state: Array, root: Array) -> tuple[Array, None]:
    height, speed, tilt, total, credit = state
    who = decide(words, priorities, height, speed, tilt)
    speed = act(who, speed)
    height = height + speed * DT
    before, tilt = tilt, tilt_of(height)
    earned = jnp.where(tilt - before < -0.5, 1.0, -0.1)
    earned = earned + jnp.where(tilt < SMALL_TILT, 1 / root, -0.1 * root)
    earned = earned + jnp.where(jnp.abs(height - GOAL) < 0.5, 1.0, -0.1)
    earned = earned + jnp.where(height > GOAL + 0.2, -1.0, 0.0)
    earned = earned + jnp.where(jnp.abs(speed) > TOP_SPEED, -0.1, 0.0)
    won = jnp.where(who == jnp.arange(BEHAVIORS + 1)[:, None], earned, 0.0).sum(axis=1)
    return (height, speed, tilt, total + earned.sum(), credit + won), None


def episode(agent: tuple[Array, Array, Array]) -> tuple[Array, Array]:
    height, words, priorities = agent
    state = (height, jnp.zeros(ROBOTS), tilt_of(height), jnp.zeros(()), jnp.zeros(BEHAVIORS + 1))
    roots = jnp.sqrt(jnp.arange(1.0, STEPS + 1))
    state, _ = lax.scan(partial(advance, words, priorities), state, roots)
    return state[3] / ROBOTS, state[4] / ROBOTS


def all_episodes(agents: tuple[Array, Array, Array]) -> tuple[Array, Array]:
    """Run the episodes in batches that fit into the cache; all at once takes more than twice as long."""
    return lax.map(episode, agents, batch_size=200)


def prepare(workload: Workload) -> Callable[[], Earnings]:
    """Prepare lifting, mapped over all agents and compiled, with XLA's arctangent."""
    jax.config.update("jax_platforms", "cpu")
    jax.config.update("jax_enable_x64", True)
    shifts = np.arange(workload.tables.shape[2])
    words = (workload.tables.astype(np.int64) << shifts).sum(axis=2)
    layers = np.arange(1, BEHAVIORS + 1) * 8
    priorities = np.empty((len(workload), BEHAVIORS), np.int64)
    np.put_along_axis(priorities, workload.structures, layers + workload.structures, axis=1)
    agents = tuple(jnp.asarray(array) for array in (workload.heights, words, priorities))
    compiled = jax.jit(all_episodes).lower(agents).compile()

    def run() -> Earnings:
        returns, credit = compiled(agents)
        return Earnings(np.asarray(returns), np.asarray(credit))

    return run
