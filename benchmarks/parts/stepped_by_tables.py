"""Environments with a table of transitions: stepped by it, stepped in Python by bbsd, and in a plain loop."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from bbsd.api.given.environments import opened_environment, problem_of
from bbsd.api.specs import load
from bbsd.evaluation import detailed_outcomes, evaluation_keys, returns_of
from bbsd.solver.random_agents import random_agents
from benchmarks.report import Goal, Section, table
from benchmarks.timing import alternating_times
from benchmarks.workloads.specs import SPECS

if TYPE_CHECKING:
    from collections.abc import Callable

    from bbsd.compiler import Problem
    from bbsd.environments.opening import Opened
    from bbsd.evaluation import Agents
    from benchmarks.timing import Floats

AGENTS = 200
BY_TABLE, STEPPED, LOOP = "by its table", "stepped in Python", "a plain loop"
EPISODES = {BY_TABLE: 200, STEPPED: 1, LOOP: 1}
"""Episodes of each agent."""
LEAST_FASTER = {"taxi": 100.0, "lake": 30.0, "cliff_walking": 100.0}
"""How many times as fast as a plain loop the table should be; on the lake most lanes wait for those that still walk."""


@dataclass(frozen=True)
class Run:
    """A way to run episodes of random agents, and how many steps it takes."""

    call: Callable[[], object]
    steps: float


def section(*, quick: bool) -> Section:
    """Measure the steps in a second of each environment."""
    rows, goals = [], []
    for name, least in LEAST_FASTER.items():
        runs = runs_of(name)
        times = alternating_times({way: run.call for way, run in runs.items()}, 3 if quick else 9)
        speeds = {way: runs[way].steps / times[way] for way in runs}
        faster = float(np.median(speeds[BY_TABLE] / speeds[LOOP]))
        rows.append([f"`{name}`", *(_speed(speeds[way]) for way in runs), f"{faster:,.0f}"])
        goals.append(Goal(f"{name} by its table beside a plain loop", faster, least, at_least=True))
    return Section(
        "Environments with a table of transitions",
        [
            (
                f"Steps in a second of processor time, {AGENTS} random agents of each spec in `specs/gymnasium`. "
                "*A plain loop* calls `reset` and `step` of the raw environment with random actions, decided by nobody."
            ),
            table(["", BY_TABLE, STEPPED, LOOP, "table / loop"], rows),
        ],
        goals,
    )


def _speed(speeds: Floats) -> str:
    return f"{float(np.median(speeds)):,.0f}"


def runs_of(name: str) -> dict[str, Run]:
    """Return the ways to run a spec's environment."""
    loaded = load(str(SPECS / "gymnasium" / f"{name}.yaml"))
    opened = opened_environment(loaded, allow_import=("gymnasium",))
    if opened is None or opened.table is None:
        raise RuntimeError(f"{name} is not stepped by a table")
    by_table = problem_of(loaded, opened)
    in_python = opened_environment(loaded, allow_import=("gymnasium",), by_table=False)
    agents = random_agents(by_table, 1, AGENTS)
    steps = int(loaded.spec.environment.steps)
    return {
        BY_TABLE: _episodes(by_table, agents, EPISODES[BY_TABLE]),
        STEPPED: _episodes(problem_of(loaded, in_python), agents, EPISODES[STEPPED]),
        LOOP: Run(lambda: plain_loop(opened, 20_000, steps), 20_000),
    }


def _episodes(problem: Problem, agents: Agents, n_episodes: int) -> Run:
    keys = evaluation_keys(1, n_episodes)
    taken = sum(float(outcome.steps_taken.sum()) for outcome in detailed_outcomes(problem, agents, keys, 1))
    return Run(lambda: returns_of(problem, agents, keys, 1), taken)


def plain_loop(opened: Opened, steps: int, most_steps: int) -> float:
    """Step the raw environment with random actions, and return what was earned."""
    environment = opened.make()
    actions = np.random.default_rng(1).integers(0, environment.action_space.n, steps).tolist()
    earned, in_episode = 0.0, 0
    environment.reset(seed=0)
    for action in actions:
        _, reward, terminated, truncated, _ = environment.step(action)
        earned += reward
        in_episode += 1
        if terminated or truncated or in_episode == most_steps:
            environment.reset(seed=in_episode)
            in_episode = 0
    return earned
