"""Compiled problems for the tests of compiler, evaluation and solver, and agents that live in them."""

import numpy as np

from bbsd.compiler import compile_meaning
from bbsd.evaluation import Agents, detailed_outcomes
from bbsd.solver.random_agents import random_agents
from tests.unit.architecture.designs import meaning_of

RICH = """
bbsd: 1
name: rich
constants:
  goal: 3 if generation < 30 else 2
  chart: list(list(1, 2, 3), list(4, 5, 6))
environment:
  robots: 3
  steps: 12
  world:
    wind: normal(0, 1)
    left: 1
    right: 2
  state:
    x: uniform(-1, 1)
    armed: chance(0.5)
    n: integers(0, 5)
  definitions:
    spread: max(x[r] for r in team) - min(x[r] for r in team)
  dynamics:
    wind: 0.5 * wind + normal(0, 0.1)
    left: right
    right: left
    x: x + 0.1 * wind
    n: (n + chart[robot][n]) % 6
  sensors:
    noisy: x + normal(0, 0.01)
    sides: list(x - left, x - right)
    place:
      front: x == max(x[r] for r in team)
      back: otherwise
  ends: any(abs(x[r]) > goal for r in team)
behaviors:
  rise:
    inputs:
      where: cut(noisy, -1, 0, 1)
      side: sides[0] < 0
    actions:
      little:
        x: x + 0.1
      much:
        x: x + uniform(0.5, 1)
        armed: true
      jump:
        x: x + 2
        n: 0
    expects: noisy > before(noisy)
  fall:
    excited: armed
    inputs:
      count: values(n, 0, 5)
      where: cut(x, -2, -1, 0, 1, 2)
      place: place
    actions:
      down:
        x: x - 0.3
      disarm:
        armed: not armed
    expects: not armed or x < before(x)
  rest:
    actions:
      stay:
        n: n + 1
reward:
  near: 1 - abs(x - goal)
  level: -spread
design:
  layers: 2
  coevolution: {generations: 4, population: 6, agents: 12}
  learning: {episodes: 3, last: 2}
  culture: {size: 3}
  answer: {candidates: 6, episodes: 100, judged: 100}
"""
"""Three robots, fewer layers than behaviors, a table larger than a word, draws everywhere, an end."""


def problem_of(text, *, seed=0, lanes=None, compiled=False, jobs=1):
    return compile_meaning(meaning_of(text, seed), lanes=lanes, compiled=compiled, jobs=jobs)


def lived(problem, n_agents, seed=0, generation=1):
    """An episode of random agents in detail, each in a stream of its own."""
    agents = random_agents(problem, seed, n_agents)
    keys = np.random.default_rng(seed).integers(0, 2**64, n_agents, dtype=np.uint64)
    team = problem.assemble(agents.pools, agents.members, generation)
    return team.detailed_episode(keys, agents.structures)


def episode_of(problem, tables, structure, *, key=1, generation=1):
    """One agent's episode in detail, its tables and its structure (lowest layer first) given as lists."""
    pools = tuple(np.array([table], np.uint8) for table in tables)
    members = np.zeros((1, len(pools)), np.int64)
    agents = Agents(pools, members, np.array([structure], np.int64))
    return next(detailed_outcomes(problem, agents, np.array([key], np.uint64), generation))
