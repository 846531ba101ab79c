"""What a run's generations take, from a few small ones that are really lived."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter, process_time
from typing import TYPE_CHECKING

from bbsd.evaluation import detailed_outcomes
from bbsd.kernel.keys import keys
from bbsd.runs import checkpoint, metrics
from bbsd.runs.rehearsal import rehearse
from bbsd.solver.generation import initial_state, next_generation
from bbsd.solver.random_agents import random_agents

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.compiler import Problem
    from bbsd.solver.generation import State
    from bbsd.solver.settings import Settings

SHORT, LONG = 1, 3
"""Episodes of sampled lifetimes; the first is lived with the structure an agent is born with."""
FEW = 2
"""Agents that take next to no time."""
SEVERAL = 20
"""Agents whose tables are drawn to see how long it takes."""
LONG_ENOUGH, TOO_LONG = 0.2, 2.0
"""Seconds of lives after which a sample is believed, and of a sample after which no larger one is tried."""
LEAST = 1e-6
"""Seconds; what is less cannot be measured."""


@dataclass(frozen=True, slots=True)
class Sample:
    """Seconds of the processor: until everything is compiled, and then of a generation, by what it consists of."""

    compiling: float
    breeding: float
    """Of pools and figures, however many agents there are."""
    agent: float
    """Of an agent, however long it lives."""
    episode: float
    """Of an agent's episode."""
    newborn: float
    """Of a random agent's tables."""
    hastened: float
    """How much faster episodes are in several threads."""

    def generation(self, n_agents: int) -> float:
        """A generation but for its episodes."""
        return self.breeding + n_agents * self.agent


def sample(problem: Problem, settings: Settings, key: int) -> Sample:
    """Live and breed as a run does, with more and more agents until it takes long enough to be measured."""
    first, second = (_seconds(_all_kernels, problem, settings, key) for _ in range(2))
    state, _ = next_generation(
        initial_state(problem, settings, key), problem, settings.reduced(FEW, SHORT), key
    )

    def seconds(n_agents: int, lifetime: int) -> float:
        return _seconds(_generation, state, problem, settings.reduced(n_agents, lifetime), key)

    breeding = seconds(FEW, SHORT)
    n_agents, lifetime = (
        min(problem.lanes, settings.coevolution.agents),
        min(LONG, settings.learning.episodes),
    )
    while True:
        brief, began = seconds(n_agents, SHORT), perf_counter()
        whole, clock = seconds(n_agents, lifetime), perf_counter() - began
        if whole - brief > LONG_ENOUGH or whole > TOO_LONG:
            break
        if n_agents < settings.coevolution.agents:
            n_agents = min(4 * n_agents, settings.coevolution.agents)
        elif lifetime < settings.learning.episodes:
            lifetime = min(4 * lifetime, settings.learning.episodes)
        else:
            break
    lives = whole - brief if lifetime > SHORT else whole - breeding
    episode = max(lives, LEAST) / (n_agents * max(lifetime - SHORT, 1))
    agent = max((brief - breeding) / n_agents - episode, 0.0)
    hastened = min(max(1.0, whole / clock), problem.jobs)
    newborn = _seconds(random_agents, problem, key, SEVERAL) / SEVERAL
    return Sample(max(0.0, first - second), breeding, agent, episode, newborn, hastened)


def _seconds(what: Callable[..., object], *arguments: object) -> float:
    began = process_time()
    what(*arguments)
    return process_time() - began


def _all_kernels(problem: Problem, settings: Settings, key: int) -> None:
    """Call once whatever is compiled when it is called."""
    rehearse(problem, settings)
    agents = random_agents(problem, key, 1)
    for _ in detailed_outcomes(problem, agents, keys(key, 0, 1), settings.coevolution.generations):
        pass


def _generation(state: State, problem: Problem, settings: Settings, key: int) -> None:
    following, census = next_generation(state, problem, settings, key)
    metrics.line(0, following, census, problem)
    checkpoint.packed(checkpoint.RunState(0, following))
