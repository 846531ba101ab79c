"""Worlds as environments of Gymnasium: they keep to its rules, and designs earn in them what they are evaluated at."""

import warnings

import gymnasium
import numpy as np
import pytest
from gymnasium.utils.env_checker import check_env
from gymnasium.vector import SyncVectorEnv

import bbsd
from bbsd.architecture import architecture_of
from bbsd.architecture.controller import command, controller_of
from tests.unit.architecture.designs import SPECS
from tests.unit.problems import RICH

LIFTING, CARTPOLE = SPECS / "object_lifting_hand.yaml", SPECS / "tasks" / "cartpole_hand.yaml"
SHORT = ["environment.steps=40"]
EPISODES = 4


@pytest.fixture(scope="module")
def rich(tmp_path_factory):
    path = tmp_path_factory.mktemp("specs") / "rich.yaml"
    path.write_text(RICH, encoding="utf-8")
    return path


def env(spec, **settings):
    return bbsd.env(spec, compiled=False, **settings)


@pytest.mark.parametrize("observe", ["sensors", "cells"])
@pytest.mark.parametrize("spec", ["rich", LIFTING, CARTPOLE], ids=["rich", "lifting", "cartpole"])
def test_gymnasium_finds_nothing_wrong(spec, observe, request):
    path = request.getfixturevalue("rich") if spec == "rich" else spec
    with warnings.catch_warnings():
        warnings.filterwarnings("ignore", ".*Box observation space (minimum|maximum) value")
        check_env(env(path, observe=observe), skip_render_check=True)


def lived(world, n_episodes, seed):
    """All that is observed and earned in whole episodes of random choices."""
    chosen, seen = np.random.default_rng(seed), []
    for episode in range(n_episodes):
        observation, _ = world.reset(seed=seed if episode == 0 else None)
        over = False
        while not over:
            seen.append(observation)
            limits = getattr(world.action_space, "nvec", None)
            n = world.action_space.n if limits is None else limits
            observation, reward, terminated, truncated, info = world.step(chosen.integers(n))
            over = terminated or truncated
            seen.append(np.array([reward, terminated, truncated, *info.values()], np.float64))
    return np.concatenate([each.ravel() for each in seen])


@pytest.mark.parametrize("spec", ["rich", CARTPOLE], ids=["rich", "cartpole"])
def test_whole_episodes_follow_from_the_seed(spec, request):
    path = request.getfixturevalue("rich") if spec == "rich" else spec
    world, other = env(path), env(path)
    first = lived(world, 3, 7)
    assert lived(other, 3, 7).tobytes() == first.tobytes()
    assert lived(world, 3, 7).tobytes() == first.tobytes()
    assert lived(world, 3, 8).tobytes() != first.tobytes()


def evaluated(spec, seed):
    evaluation = bbsd.evaluate(spec, episodes=EPISODES, seed=seed, set=SHORT, keep_each=True)
    return evaluation.each.returns


def returns_of(world, choose):
    returns = []
    for episode in range(EPISODES):
        observation, _ = world.reset(seed=episode)
        over = False
        while not over:
            observation, _, terminated, truncated, info = world.step(choose(observation))
            over = terminated or truncated
        returns.append(info["return"])
    return np.array(returns)


@pytest.mark.slow
@pytest.mark.parametrize("spec", [LIFTING, CARTPOLE], ids=["lifting", "cartpole"])
def test_a_controller_earns_what_its_design_is_evaluated_at(spec):
    loaded = bbsd.load(spec, seed=5, set=SHORT)
    world = env(spec, observe="cells", seed=5, set=SHORT)
    exchange, controller = world.exchange, controller_of(loaded.meaning, architecture_of(loaded.meaning))
    assert exchange.names == tuple(dimension.name for dimension in controller.dimensions)

    def choose(cells):
        robots = cells.reshape(exchange.n_robots, -1).tolist()
        return np.squeeze(exchange.choices[[command(controller, robot) for robot in robots]])

    assert returns_of(world, choose).tobytes() == evaluated(spec, 5).tobytes()


@pytest.mark.slow
@pytest.mark.parametrize("spec", [LIFTING, CARTPOLE], ids=["lifting", "cartpole"])
def test_agents_earn_what_their_design_is_evaluated_at(spec):
    world = env(spec, seed=3, set=SHORT)
    agents, exchange = bbsd.Agent.team(spec, seed=3, set=SHORT), world.exchange

    def choose(observation):
        acts = []
        for agent, robot in zip(agents, observation.reshape(exchange.n_robots, -1), strict=True):
            named = exchange.named(robot)
            acts.append(agent.act({name: named[name] for name in agent.inputs}).number)
        return np.squeeze(exchange.choices[acts])

    def reset_agents_and(reset):
        def begin(**settings):
            for agent in agents:
                agent.reset()
            return reset(**settings)

        return begin

    world.reset = reset_agents_and(world.reset)
    assert returns_of(world, choose).tobytes() == evaluated(spec, 3).tobytes()


def test_rewards_of_one_robot_add_up_to_its_return():
    world = env(CARTPOLE)
    world.reset(seed=0)
    total, over = 0.0, False
    while not over:
        _, reward, terminated, truncated, info = world.step(1)
        total, over = total + reward, terminated or truncated
    assert total == info["return"]
    assert terminated
    assert not truncated


def test_an_episode_without_an_end_is_cut_after_its_steps():
    world = env(LIFTING, set=["environment.steps=3"])
    world.reset(seed=0)
    ends = [world.step(np.zeros(3, np.int64))[2:4] for _ in range(3)]
    assert ends == [(False, False), (False, False), (False, True)]


@pytest.mark.parametrize("spec", ["rich", CARTPOLE], ids=["rich", "cartpole"])
def test_lanes_are_what_gymnasium_makes_of_single_environments(spec, request):
    path = request.getfixturevalue("rich") if spec == "rich" else spec
    ours = env(path, api="vector", lanes=5)
    theirs = SyncVectorEnv([lambda: env(path)] * 5)
    assert ours.metadata["autoreset_mode"] == theirs.metadata["autoreset_mode"]
    assert ours.single_action_space == theirs.single_action_space
    assert ours.observation_space == theirs.observation_space
    seen, others = ours.reset(seed=2)[0], theirs.reset(seed=2)[0]
    chosen, n_ends = np.random.default_rng(0), 0
    for _ in range(60):
        assert seen.tobytes() == others.tobytes()
        assert seen.dtype == others.dtype
        actions = chosen.integers(len(ours.exchange.numbers), size=ours.action_space.shape)
        seen, *rest, info = ours.step(actions)
        others, *others_rest, others_info = theirs.step(actions)
        for one, other in zip(rest, others_rest, strict=True):
            np.testing.assert_array_equal(one, other)
        n_ends += sum(rest[1] | rest[2])
        if (rest[1] | rest[2]).any():
            np.testing.assert_array_equal(info["_return"], others_info["_return"])
            np.testing.assert_array_equal(
                info["return"][info["_return"]], others_info["return"][info["_return"]]
            )
    assert n_ends > 5


@pytest.mark.slow
def test_compiled_worlds_are_the_same():
    plain, compiled = env(CARTPOLE), bbsd.env(CARTPOLE)
    assert isinstance(compiled, gymnasium.Env)
    assert lived(plain, 2, 1).tobytes() == lived(compiled, 2, 1).tobytes()
