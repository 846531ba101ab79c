"""The time that a run's generations take, measured on a few small ones."""

from __future__ import annotations

from dataclasses import dataclass, replace
from time import perf_counter, process_time
from typing import TYPE_CHECKING

from bbsd.evaluation import detailed_outcomes
from bbsd.kernel.keys import keys
from bbsd.runs.pricing.counting import Counter
from bbsd.runs.rehearsal import rehearse
from bbsd.runs.searching import Course
from bbsd.runs.storage import metrics
from bbsd.runs.storage.state import RunState, run_arrays
from bbsd.solver.paper.generation import initial_state, next_generation
from bbsd.solver.random_agents import random_agents
from bbsd.solver.search import search_budget

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.compiler import Problem
    from bbsd.solver.paper.generation import State
    from bbsd.solver.paper.settings import Settings

SHORT, LONG = 1, 3
"""Episodes of sampled lifetimes. No structure is searched for before the first."""
FEW = 2
"""Agents whose episodes take next to no time."""
SEVERAL = 20
"""Random agents whose tables are drawn, to measure how long that takes."""
LONG_ENOUGH, TOO_LONG = 0.2, 2.0
"""Seconds of episodes that make a sample reliable, and seconds of a sample after which no larger one is tried."""
LEAST = 1e-6
"""Seconds; less cannot be measured."""


@dataclass(frozen=True, slots=True)
class Sample:
    """Processor seconds: until everything is compiled, and then of a generation, by what it consists of."""

    compiling: float
    breeding: float
    """Of a generation's pools and metrics, however many agents there are."""
    agent: float
    """Of an agent, however long its lifetime is."""
    episode: float
    """Of an agent's episode."""
    random_agent: float
    """Of drawing a random agent's tables."""
    speedup: float
    """How many times faster episodes are in several threads."""
    longest: float = 1.0
    """How many times longer an episode takes that lasts as long as one can; 1 where that makes no difference."""
    length: float | None = None
    """The mean length in steps of the episodes that were sampled, where time goes by steps."""

    def generation(self, n_agents: int) -> float:
        """Return the seconds of a generation without its episodes."""
        return self.breeding + n_agents * self.agent


def sample(problem: Problem, settings: Settings, key: int, most_steps: int) -> Sample:
    """Run generations as a run does, with more and more agents until they take long enough to be measured.

    `most_steps` is how long an episode can last.
    """
    jobs, counter = problem.jobs, Counter()
    problem = _measurable(problem, counter)
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
        short, began = seconds(n_agents, SHORT), perf_counter()
        counter.clear()
        long, clock = seconds(n_agents, lifetime), perf_counter() - began
        if long - short > LONG_ENOUGH or long > TOO_LONG:
            break
        if n_agents < settings.coevolution.agents:
            n_agents = min(4 * n_agents, settings.coevolution.agents)
        elif lifetime < settings.learning.episodes:
            lifetime = min(4 * lifetime, settings.learning.episodes)
        else:
            break
    episodes = long - short if lifetime > SHORT else long - breeding
    episode = max(episodes, LEAST) / (n_agents * max(lifetime - SHORT, 1))
    agent = max((short - breeding) / n_agents - episode, 0.0)
    speedup = jobs if problem.is_stepped else min(max(1.0, long / clock), jobs)
    random_agent = _seconds(random_agents, problem, key, SEVERAL) / SEVERAL
    longest, length = _length(counter, long, most_steps)
    return Sample(max(0.0, first - second), breeding, agent, episode, random_agent, speedup, longest, length)


def sample_search(problem: Problem, settings: Settings, key: int, budget: int, most_steps: int) -> Sample:
    """Run the first rounds of a search until they take long enough to be measured.

    `most_steps` is how long an episode can last.
    """
    jobs, counter = problem.jobs, Counter()
    problem = _measurable(problem, counter)
    course = Course(problem, replace(settings, budget=budget), key, 0)
    first, second = (_seconds(_rehearse_judgement, problem, settings, key) for _ in range(2))
    search = course.method.begin(course.arena, course.stream, search_budget(budget))
    counter.clear()
    began, clock = process_time(), perf_counter()
    while search.spent < search_budget(budget) and process_time() - began < LONG_ENOUGH:
        search = course.method.advance(search, course.arena, course.stream, search_budget(budget))
    taken, passed = process_time() - began, perf_counter() - clock
    longest, length = _length(counter, taken, most_steps)
    random_agent = _seconds(random_agents, problem, key, SEVERAL) / SEVERAL
    return Sample(
        compiling=max(0.0, first - second),
        breeding=0.0,
        agent=0.0,
        episode=max(taken, LEAST) / max(search.spent, 1),
        random_agent=random_agent,
        speedup=jobs if problem.is_stepped else min(max(1.0, taken / passed), jobs),
        longest=longest,
        length=length,
    )


def _length(counter: Counter, seconds: float, most_steps: int) -> tuple[float, float | None]:
    """Return how many times longer the longest episodes take than those that took so many seconds, and their length."""
    if not counter.episodes:
        return 1.0, None
    return counter.stretched(seconds, most_steps) / max(seconds, LEAST), counter.length


def _measurable(problem: Problem, counter: Counter) -> Problem:
    """Return the problem with all its work in this process: processor seconds of others are not known here.

    Where an environment is stepped, steps are counted. Two processes stepped CartPole 1.94 times as fast as one.
    """
    if not problem.is_stepped or problem.stepper is None:
        return problem
    return replace(problem, jobs=1, stepper=counter.counted(problem.stepper))


def _rehearse_judgement(problem: Problem, settings: Settings, key: int) -> None:
    """Call once everything that a search and the judgement of its answer compile."""
    rehearse(problem, settings)
    agents = random_agents(problem, key, 1)
    for _ in detailed_outcomes(problem, agents, keys(key, 0, 1), settings.coevolution.generations):
        pass


def _seconds(function: Callable[..., object], *arguments: object) -> float:
    """Return the processor time of a call."""
    began = process_time()
    function(*arguments)
    return process_time() - began


def _all_kernels(problem: Problem, settings: Settings, key: int) -> None:
    """Call once everything that is compiled when it is called."""
    rehearse(problem, settings)
    agents = random_agents(problem, key, 1)
    for _ in detailed_outcomes(problem, agents, keys(key, 0, 1), settings.coevolution.generations):
        pass


def _generation(state: State, problem: Problem, settings: Settings, key: int) -> None:
    following, census = next_generation(state, problem, settings, key)
    metrics.line(0, following, census, problem)
    run_arrays(RunState(0, following))
