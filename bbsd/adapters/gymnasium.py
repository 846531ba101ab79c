"""A world as an environment of Gymnasium, one or many in lanes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import gymnasium
import numpy as np
from gymnasium.spaces import Box, Discrete, MultiDiscrete
from gymnasium.utils.seeding import np_random
from gymnasium.vector import AutoresetMode, VectorEnv
from gymnasium.vector.utils import batch_space

from bbsd.adapters.episodes import drawn_key, key_of
from bbsd.compiler.world import World

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.random import Generator

    from bbsd.adapters.exchange import Exchange

ONLY = np.zeros(1, np.int64)
"""The only lane."""


def spaces_of(exchange: Exchange, n_robots: int) -> tuple[gymnasium.Space[Any], gymnasium.Space[Any]]:
    """Return what so many robots observe together, and what they choose: one a number, several an array."""
    n, n_choices = n_robots * len(exchange.names), len(exchange.numbers)
    observed = (
        MultiDiscrete(np.tile(exchange.sizes, n_robots))
        if exchange.observe == "cells"
        else Box(-np.inf, np.inf, (n,), np.float64)
    )
    return observed, Discrete(n_choices) if n_robots == 1 else MultiDiscrete([n_choices] * n_robots)


class WorldEnv(gymnasium.Env[Any, Any]):
    """A world in which another program chooses what all robots do.

    `exchange` says what is observed and chosen. Several robots are observed one after the other, and chosen for in one
    array. The reward is the mean over robots; when an episode is over, `info["return"]` is what `bbsd evaluate`
    reports of it. `reset(seed=n)` begins episode n of `bbsd evaluate`; without a seed it is one drawn by `np_random`.
    An episode is terminated where the spec's `ends` holds, and truncated after its `steps`.
    """

    metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012 - as Gymnasium has it

    def __init__(self, exchange: Exchange, seed: int, generation: int, *, compiled: bool = True) -> None:
        self.exchange, self._seed = exchange, seed
        self._world = World(exchange.meaning, exchange.nodes, 1, generation, compiled=compiled)
        self.observation_space, self.action_space = spaces_of(exchange, exchange.n_robots)

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode, and return what is observed; options have no effect."""
        super().reset(seed=seed, options=options)
        key = drawn_key(self.np_random) if seed is None else key_of(self._seed, seed)
        self._world.begin(ONLY, np.array([key], np.uint64))
        return self._observed(), {}

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:  # noqa: ANN401 - a number or an array
        """Take a step, and return what is observed, what it earned, and whether the episode is over."""
        world = self._world
        world.step(ONLY, self.exchange.numbers[np.reshape(action, (-1, 1))])
        terminated = bool(world.living[0] == 0.0)
        over = bool(world.over[0])
        reward = float(self.exchange.of_team(world.earned[:, 0]))
        info = {"return": float(world.returns[0])} if over else {}
        return self._observed(), reward, terminated, over and not terminated, info

    def _observed(self) -> Any:  # noqa: ANN401 - an array
        return self.exchange.of_robots(self._world.observed[:, 0]).ravel()


class WorldVectorEnv(VectorEnv[Any, Any, Any]):
    """Many lanes of a world, stepped together; a lane that is over begins another episode in its next step.

    Each lane is as a `WorldEnv`; lane i is seeded with the seed plus i, and has a random generator of its own.
    """

    def __init__(
        self, exchange: Exchange, n_lanes: int, seed: int, generation: int, *, compiled: bool = True
    ) -> None:
        self.metadata = {"render_modes": [], "autoreset_mode": AutoresetMode.NEXT_STEP}
        self.exchange, self.num_envs, self._seed = exchange, n_lanes, seed
        self._world = World(exchange.meaning, exchange.nodes, n_lanes, generation, compiled=compiled)
        self.single_observation_space, self.single_action_space = spaces_of(exchange, exchange.n_robots)
        self.observation_space = batch_space(self.single_observation_space, n_lanes)
        self.action_space = batch_space(self.single_action_space, n_lanes)
        self._generators: list[Generator] = [np_random()[0] for _ in range(n_lanes)]
        self._over = np.zeros(n_lanes, np.bool_)

    def reset(
        self,
        *,
        seed: int | Sequence[int | None] | None = None,
        options: dict[str, Any] | None = None,
    ) -> tuple[Any, dict[str, Any]]:
        """Begin an episode in each lane, and return what is observed, (n_lanes, n); options have no effect."""
        del options
        if isinstance(seed, int):
            seed = range(seed, seed + self.num_envs)
        for lane, each in enumerate(seed or [None] * self.num_envs):
            self._begin(lane, each)
        self._over[:] = False
        return self._observed(), {}

    def step(self, actions: Any) -> tuple[Any, Any, Any, Any, dict[str, Any]]:  # noqa: ANN401 - an array
        """Take a step in each lane, and return what is observed and earned; lanes that were over begin anew."""
        world, begins = self._world, self._over
        going = np.flatnonzero(~begins)
        if going.size:
            chosen = self.exchange.numbers[np.asarray(actions).reshape(self.num_envs, -1)]
            world.step(going, chosen[going].T)
        for lane in np.flatnonzero(begins).tolist():
            self._begin(lane, None)
        terminated = (world.living == 0.0) & ~begins
        self._over = world.over & ~begins
        rewards = np.where(begins, 0.0, self.exchange.of_team(world.earned))
        infos = {"return": world.returns.copy(), "_return": self._over.copy()} if self._over.any() else {}
        return self._observed(), rewards, terminated, self._over & ~terminated, infos

    def _begin(self, lane: int, seed: int | None) -> None:
        if seed is None:
            key = drawn_key(self._generators[lane])
        else:
            self._generators[lane], key = np_random(seed)[0], key_of(self._seed, seed)
        self._world.begin(np.array([lane]), np.array([key], np.uint64))

    def _observed(self) -> Any:  # noqa: ANN401 - an array
        observed = self.exchange.of_robots(self._world.observed)
        return np.ascontiguousarray(observed.reshape(-1, self.num_envs).T)
