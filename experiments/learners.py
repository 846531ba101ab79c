"""Learners of stable-baselines3 in worlds of bbsd, beside designs: each has as many steps of the environment.

    python -m experiments.learners --tasks tasks/cartpole object_lifting --budget 5000 --seeds 3

A design has a budget of episodes; the steps that it takes, in search, race and measurements, are counted, and PPO and
DQN learn with so many (PPO takes whole rollouts, so a few more). They observe what behaviors may know (`sensors`) or
only the cells that behaviors tell apart (`cells`), and choose among the actions of the spec (`bbsd.env`); of a team,
one learner observes and chooses for all robots, which designs may not. What came out is measured on the same fresh
episodes. Settings of learners are their library's own.

stable-baselines3 is no part of bbsd's environment, since it needs torch; without it the script says so and exits
with 2.
"""

from __future__ import annotations

import argparse
import sys
import time
from dataclasses import dataclass
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np

import bbsd
from bbsd.compiler import compile_meaning
from bbsd.evaluation import agents_of, returns_of
from bbsd.evaluation.streams import evaluation_keys
from bbsd.runs.run import run_key
from bbsd.runs.searching import Course
from bbsd.solver.paper.settings import settings_of
from experiments.designs import spec_path

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from pathlib import Path

    from numpy.typing import NDArray

EPISODES = 1_000
"""Fresh episodes on which everything is measured."""
OTHER_EPISODES = 1_000_000
"""Learners begin their lessons with the episode of this number, far from those that they are measured on."""
MISSING = 2
"""The exit code where stable-baselines3 is missing."""


class Counter:
    """Steps nothing, since the world is the spec's own, and counts the steps."""

    def __init__(self) -> None:
        self.steps = 0

    def reset(self, lanes: NDArray[np.int64], keys: NDArray[np.uint64], outside: NDArray[np.float64]) -> None:
        """Begin episodes."""

    def step(self, lanes: NDArray[np.int64], sent: NDArray[np.float64], outside: NDArray[np.float64]) -> None:
        """Count a step of each lane."""
        del sent, outside
        self.steps += len(lanes)


@dataclass(frozen=True)
class Learned:
    """What came out: the mean return on fresh episodes, the steps that it took, and the seconds."""

    returns: NDArray[np.float64]
    steps: int
    seconds: float

    @property
    def mean(self) -> float:
        """The mean return."""
        return float(self.returns.mean())


def designed(path: Path, budget: int, seed: int) -> Learned:
    """Return what a design earns."""
    meaning, counter = bbsd.load(path).meaning, Counter()
    problem, settings = compile_meaning(meaning, stepper=lambda: counter), settings_of(meaning)
    began = time.perf_counter()
    course = Course(problem, settings, run_key(seed, 0), 0)
    *_, (reached, _) = course.steps(course.start(budget), [budget])
    seconds, steps = time.perf_counter() - began, counter.steps
    if reached.answer is None:
        raise RuntimeError("a run whose budget is spent has no answer")
    fresh, generation = evaluation_keys(0, EPISODES), meaning.spec.design.coevolution.generations
    returns = returns_of(compile_meaning(meaning), agents_of([reached.answer]), fresh, generation)
    return Learned(returns[0], steps, seconds)


def taught(path: Path, learner: str, observe: str, steps: int, seed: int) -> Learned:
    """Return what a learner earns that took so many steps."""
    import torch
    from stable_baselines3 import DQN, PPO
    from stable_baselines3.common.env_util import make_vec_env

    torch.set_num_threads(1)
    environments = make_vec_env(
        lambda: bbsd.env(path, observe=observe),  # type: ignore[arg-type]
        seed=OTHER_EPISODES + 1_000 * seed,
    )
    began = time.perf_counter()
    model = (PPO if learner == "PPO" else DQN)("MlpPolicy", environments, seed=seed, device="cpu")
    model.learn(steps)
    seconds = time.perf_counter() - began
    returns = measured(path, observe, lambda seen: model.predict(seen, deterministic=True)[0])
    return Learned(returns, model.num_timesteps, seconds)


def measured(path: Path, observe: str, choose: Callable[[Any], Any]) -> NDArray[np.float64]:
    """Return what choices earn in the fresh episodes, (n_episodes,), all lived side by side."""
    world = bbsd.env(path, api="vector", lanes=EPISODES, observe=observe)  # type: ignore[arg-type]
    observed, _ = world.reset(seed=0)
    returns = np.full(EPISODES, np.nan)
    while np.isnan(returns).any():
        observed, _, terminated, truncated, infos = world.step(choose(observed))
        first = (terminated | truncated) & np.isnan(returns)
        if first.any():
            returns[first] = infos["return"][first]
    return returns


def learners_for(path: Path) -> list[tuple[str, str]]:
    """Return the learners that can learn in a world, and what each observes: DQN chooses for one robot only."""
    alone = bbsd.load(path).spec.environment.robots == 1
    return [
        (name, observe)
        for name in ("PPO", "DQN")
        for observe in ("sensors", "cells")
        if alone or name == "PPO"
    ]


def compare(task: str, budget: int, seeds: Sequence[int]) -> None:
    """Print a line for the design and for each learner: mean return over seeds, steps, seconds of one run."""
    path = spec_path(task)
    designs = [designed(path, budget, seed) for seed in seeds]
    show(task, "bbsd design", designs)
    for learner, observe in learners_for(path):
        lessons = [
            taught(path, learner, observe, each.steps, seed)
            for seed, each in zip(seeds, designs, strict=True)
        ]
        show(task, f"{learner}, {observe}", lessons)


def show(task: str, who: str, results: Sequence[Learned]) -> None:
    """Print a line."""
    means = [each.mean for each in results]
    steps, seconds = (np.mean([getattr(each, key) for each in results]) for key in ("steps", "seconds"))
    worst, best = min(means), max(means)
    earned = f"{np.mean(means):9.2f} ({worst:9.2f} to {best:9.2f})"
    print(f"{task:<18} {who:<14} {earned} {steps:10,.0f} steps {seconds:7.1f} s", flush=True)


def main() -> int:
    """Compare, and return the exit code."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("--tasks", nargs="+", default=["tasks/cartpole", "tasks/lake", "object_lifting"])
    parser.add_argument("--budget", type=int, default=5_000, help="episodes of a design")
    parser.add_argument("--seeds", type=int, default=3)
    arguments = parser.parse_args()
    if find_spec("stable_baselines3") is None:
        print(
            "stable-baselines3 is missing: pip install stable-baselines3, in an environment of its own",
            file=sys.stderr,
        )
        return MISSING
    for task in arguments.tasks:
        compare(task, arguments.budget, range(arguments.seeds))
    return 0


if __name__ == "__main__":
    sys.exit(main())
