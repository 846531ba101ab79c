"""A world as a parallel environment of PettingZoo: each robot is an agent, and all choose at the same time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from gymnasium.utils.seeding import np_random
from pettingzoo import ParallelEnv

from bbsd.adapters.episodes import drawn_key, key_of
from bbsd.adapters.gymnasium import ONLY, spaces_of
from bbsd.compiler.world import World

if TYPE_CHECKING:
    import gymnasium

    from bbsd.adapters.exchange import Exchange


class WorldParallelEnv(ParallelEnv[str, Any, Any]):  # type: ignore[misc]  # it has no types
    """A world whose robots are agents `robot_0`, `robot_1`, ...; each observes what it may know itself.

    A robot's reward is what it earned; the return of `bbsd evaluate` is the mean over robots, and
    `infos[agent]["return"]` when the episode is over. Seeds and ends are as in `WorldEnv`, and all agents end together.
    """

    metadata: dict[str, Any] = {"name": "bbsd", "render_modes": [], "is_parallelizable": True}  # noqa: RUF012

    def __init__(self, exchange: Exchange, seed: int, generation: int, *, compiled: bool = True) -> None:
        self.metadata = {**type(self).metadata, "name": exchange.meaning.spec.name}
        self.exchange, self._seed = exchange, seed
        self._world = World(exchange.meaning, exchange.nodes, 1, generation, compiled=compiled)
        self.possible_agents = [f"robot_{robot}" for robot in range(exchange.n_robots)]
        self.agents: list[str] = []
        self.render_mode = None
        self._generator, _ = np_random()
        spaces = {agent: spaces_of(exchange, 1) for agent in self.possible_agents}
        self.observation_spaces = {agent: observed for agent, (observed, _) in spaces.items()}
        self.action_spaces = {agent: chosen for agent, (_, chosen) in spaces.items()}

    def observation_space(self, agent: str) -> gymnasium.Space[Any]:
        """Return what an agent observes."""
        return self.observation_spaces[agent]

    def action_space(self, agent: str) -> gymnasium.Space[Any]:
        """Return what an agent can choose."""
        return self.action_spaces[agent]

    def reset(
        self, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, Any], dict[str, dict[str, Any]]]:
        """Begin an episode, and return what each agent observes; options have no effect."""
        del options
        if seed is not None:
            self._generator, _ = np_random(seed)
        key = drawn_key(self._generator) if seed is None else key_of(self._seed, seed)
        self._world.begin(ONLY, np.array([key], np.uint64))
        self.agents = [*self.possible_agents]
        return self._observed(), {agent: {} for agent in self.agents}

    def step(
        self, actions: dict[str, Any]
    ) -> tuple[dict[str, Any], dict[str, float], dict[str, bool], dict[str, bool], dict[str, dict[str, Any]]]:
        """Take a step, and return what each agent observes and earned, and whether the episode is over."""
        if not self.agents:
            return {}, {}, {}, {}, {}
        world, agents = self._world, self.agents
        choices = [[actions[agent]] for agent in agents]
        world.step(ONLY, self.exchange.numbers[np.array(choices)])
        terminated, over = bool(world.living[0] == 0.0), bool(world.over[0])
        info = {"return": float(world.returns[0])} if over else {}
        observed = self._observed()
        if over:
            self.agents = []
        return (
            observed,
            dict(zip(agents, world.earned[:, 0].tolist(), strict=True)),
            dict.fromkeys(agents, terminated),
            dict.fromkeys(agents, over and not terminated),
            {agent: {**info} for agent in agents},
        )

    def _observed(self) -> dict[str, Any]:
        values = self.exchange.of_robots(self._world.observed[:, 0])
        return dict(zip(self.possible_agents, values, strict=True))
