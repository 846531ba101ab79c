"""Worlds as parallel environments of PettingZoo."""

import warnings

import numpy as np
import pytest

import bbsd
from tests.unit.architecture.designs import SPECS
from tests.unit.problems import RICH

LIFTING = SPECS / "object_lifting_hand.yaml"
SHORT = ["environment.steps=40"]


@pytest.fixture(params=["rich", "lifting"])
def spec(request, tmp_path):
    if request.param == "lifting":
        return LIFTING
    path = tmp_path / "rich.yaml"
    path.write_text(RICH, encoding="utf-8")
    return path


def parallel(spec, **settings):
    return bbsd.env(spec, api="pettingzoo", compiled=False, set=SHORT, **settings)


@pytest.mark.parametrize("observe", ["sensors", "cells"])
def test_pettingzoo_finds_nothing_wrong(spec, observe):
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", category=DeprecationWarning)  # of the tests' own imports
        from pettingzoo.test import parallel_api_test
    parallel_api_test(parallel(spec, observe=observe), num_cycles=60)


def lived(world, n_episodes, seed):
    """All that all agents observe and earn in whole episodes of random choices."""
    chosen, seen = np.random.default_rng(seed), []
    for episode in range(n_episodes):
        observed, _ = world.reset(seed=seed if episode == 0 else None)
        while world.agents:
            actions = {agent: chosen.integers(world.action_space(agent).n) for agent in world.agents}
            outcome = world.step(actions)
            seen += [*observed.values(), *(np.array([*part.values()], np.float64) for part in outcome[1:4])]
            observed = outcome[0]
    return np.concatenate([each.ravel() for each in seen])


def test_whole_episodes_follow_from_the_seed(spec):
    world = parallel(spec)
    first = lived(world, 3, 7)
    assert lived(parallel(spec), 3, 7).tobytes() == first.tobytes()
    assert lived(world, 3, 7).tobytes() == first.tobytes()
    assert lived(world, 3, 8).tobytes() != first.tobytes()


@pytest.mark.slow
def test_agents_earn_what_their_design_is_evaluated_at():
    world = parallel(LIFTING, seed=1)
    agents = dict(zip(world.possible_agents, bbsd.Agent.team(LIFTING, seed=1, set=SHORT), strict=True))
    exchange, returns, sums = world.exchange, [], []
    for episode in range(3):
        observed, _ = world.reset(seed=episode)
        for agent in agents.values():
            agent.reset()
        total = 0.0
        while world.agents:
            actions = {}
            for name, agent in agents.items():
                named = exchange.named(observed[name])
                actions[name] = exchange.choices[agent.act({key: named[key] for key in agent.inputs}).number]
            observed, rewards, _, _, infos = world.step(actions)
            first, second, third = rewards.values()
            total += first + second + third
        returns.append(infos["robot_0"]["return"])
        sums.append(total / 3)
    evaluation = bbsd.evaluate(LIFTING, episodes=3, seed=1, set=SHORT, keep_each=True)
    assert returns == sums == evaluation.each.returns.tolist()


def test_agents_are_robots_that_end_together(spec):
    world = parallel(spec)
    world.reset(seed=0)
    assert world.agents == ["robot_0", "robot_1", "robot_2"]
    steps = 0
    while world.agents:
        *_, terminations, truncations, infos = world.step(dict.fromkeys(world.agents, 0))
        steps += 1
    assert len({*terminations.values()}) == len({*truncations.values()}) == 1
    assert terminations["robot_0"] != truncations["robot_0"]
    assert all("return" in info for info in infos.values())
    assert world.step({}) == ({}, {}, {}, {}, {})
