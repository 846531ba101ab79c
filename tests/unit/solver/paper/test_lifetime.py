from dataclasses import replace

import numpy as np
import pytest

from bbsd.evaluation import Agents, RewardNotFinite
from bbsd.kernel.keys import keys
from bbsd.solver.paper import lifetime as module
from bbsd.solver.paper.lifetime import explore, run_lifetimes
from bbsd.solver.random_agents import random_agents
from tests.unit.problems import problem_of
from tests.unit.solver.problems import guess, learning

KEYS = keys(5, 0, 8)
KEY_OF_A_LATE_MISTAKE = 4


def lives_of(search="sampled", structure="", **changed):
    problem, settings = guess(structure, search=search)
    agents = random_agents(problem, 1, 8)
    return agents, run_lifetimes(problem, agents, KEYS, 1, learning(settings, **changed))


def test_a_lifetime_of_one_episode_has_the_initial_structure():
    agents, lives = lives_of(episodes=1, last=1)
    np.testing.assert_array_equal(lives.structures, agents.structures)
    assert lives.returns.shape == (8, 1)


def test_the_structure_returned_is_that_of_the_last_episode():
    agents, two = lives_of(episodes=2, last=1)
    assert (two.structures != agents.structures).any()
    _, three = lives_of(episodes=3, last=1)
    np.testing.assert_array_equal(three.returns[:, :2], two.returns)


def test_a_given_structure_is_kept_to_the_end():
    agents, lives = lives_of(structure="structure: [even, odd]")
    np.testing.assert_array_equal(agents.structures, [[0, 1]] * 8)
    np.testing.assert_array_equal(lives.structures, agents.structures)
    assert lives.returns.shape == (8, 2)  # its last episodes


@pytest.mark.parametrize("search", ["sampled", "exact"])
def test_given_layers_stay_while_open_ones_are_learned(search):
    _, lives = lives_of(search, structure="structure: [open, reckless, open]")
    assert (lives.structures[:, 1] == 2).all()
    assert {tuple(structure) for structure in lives.structures.tolist()} <= {(0, 2, 1), (1, 2, 0)}


def test_exact_search_takes_the_best_assignment_of_what_was_learned():
    problem, settings = guess(search="exact")
    agents = random_agents(problem, 1, 8)
    one = run_lifetimes(problem, agents, KEYS, 1, learning(settings, episodes=1, last=1))
    two = run_lifetimes(problem, agents, KEYS, 1, learning(settings, episodes=2, last=1))
    orders = [(a, b, 3 - a - b) for a in range(3) for b in range(3) if a != b]
    for agent in range(8):
        worth = {order: sum(one.values[agent, layer, order[layer]] for layer in range(3)) for order in orders}
        present, chosen = tuple(agents.structures[agent]), tuple(two.structures[agent])
        assert worth[chosen] == pytest.approx(max(worth.values()))
        if worth[present] == max(worth.values()):
            assert chosen == present


def test_exploring_agents_have_random_structures_but_not_in_the_last_episodes():
    problem, settings = guess()
    present = np.tile([0, 1, 2], (4000, 1))
    settings = learning(settings, episodes=4, last=2)
    often, never = (
        replace(settings, rates=settings.rates._replace(exploration=4 * (rate,))) for rate in (0.3, 0.0)
    )
    explored = explore(problem, keys(1, 0, 4000), present, often, 2)
    others = np.mean((explored != present).any(axis=1))
    assert others == pytest.approx(0.3 * 5 / 6, abs=0.03)  # one of six orders is the present one
    for episode in (3, 4):
        np.testing.assert_array_equal(explore(problem, keys(1, 0, 4000), present, often, episode), present)
    np.testing.assert_array_equal(explore(problem, keys(1, 0, 4000), present, never, 2), present)


@pytest.mark.parametrize("explored", ["kept", "dropped"])
def test_the_next_structures_compete_with_what_was_explored_or_with_what_was_before(explored, monkeypatch):
    problem, settings = guess()
    agents = random_agents(problem, 1, 200)
    settings = learning(settings, episodes=4, last=1, explored=explored)
    settings = replace(settings, rates=settings.rates._replace(exploration=(0.0, 0.5, 0.5, 0.5)))
    competing, lived = [], []
    chosen, run = module.choose, module.explore

    def choosing(*arguments):
        competing.append(arguments[3])
        return chosen(*arguments)

    def exploring(*arguments):
        lived.append((arguments[2], run(*arguments)))
        return lived[-1][1]

    monkeypatch.setattr(module, "choose", choosing)
    monkeypatch.setattr(module, "explore", exploring)
    lives = run_lifetimes(problem, agents, keys(5, 0, 200), 1, settings)
    for present, (before, after) in zip(competing[1:], lived[:-1], strict=True):
        assert (before != after).any()
        np.testing.assert_array_equal(present, after if explored == "kept" else before)
    np.testing.assert_array_equal(lives.structures, lived[-1][0])  # the last episodes explore nothing


def test_by_counters_a_pair_is_worth_its_share_of_the_reinforcement():
    """(9) by (11): with a rate of 1, what a step under the pair earned times the share of steps it controlled."""
    problem, settings = guess("structure: [reckless, even, odd]")
    agents = random_agents(problem, 1, 1)
    settings = learning(settings, episodes=1, last=1, estimate="counters")
    settings = replace(settings, rates=settings.rates._replace(learning=(1.0,)))
    lives = run_lifetimes(problem, agents, keys(1, 0, 1), 1, settings)
    # The reckless one on top says 9 in both steps: -1 a step, all the time.
    assert lives.values.tolist() == [[[0, 0, 0], [0, 0, 0], [0, 0, -1]]]


def test_what_was_earned_under_a_behavior_is_its_value():
    text = """
    bbsd: 1
    name: two
    environment: {steps: 4, state: {x: 0}}
    behaviors:
      low: {actions: {a: {x: 1}}, rules: [otherwise: a]}
      high: {excited: step % 2 == 0, actions: {a: {x: 10}}, rules: [otherwise: a]}
    reward: {x: x}
    design: {learning: {episodes: 2, last: 1, rate: 0.5}}
    """
    problem, (_, settings) = problem_of(text), guess()
    agents = Agents(
        (np.ones((1, 1), np.uint8), np.ones((1, 1), np.uint8)), np.zeros((1, 2), np.int64), np.array([[0, 1]])
    )
    lives = run_lifetimes(problem, agents, keys(1, 0, 1), 1, learning(settings, episodes=1, last=1))
    assert lives.returns.tolist() == [[22]]
    assert lives.values.tolist() == [[[0.5 * 2, 0], [0, 0.5 * 20]]]  # layers, lowest first, by behaviors


def test_agents_learn_alike_alone_and_together():
    problem, settings = guess()
    agents = random_agents(problem, 1, 8)
    together = run_lifetimes(problem, agents, KEYS, 1, settings)
    some = np.array([6, 1])
    apart = run_lifetimes(problem, agents[some], KEYS[some], 1, settings)
    np.testing.assert_array_equal(apart.returns, together.returns[some])
    np.testing.assert_array_equal(apart.structures, together.structures[some])
    np.testing.assert_array_equal(apart.values, together.values[some])


def test_a_reward_that_is_not_finite_is_reported_with_its_generation_and_episode():
    text = """
    bbsd: 1
    name: odd
    environment: {steps: 3, state: {x: "chance(0.5)"}}
    behaviors: {b: {actions: {a: {x: x}}}}
    reward: {fine: 1, bad: "1 / (step - 2) if x else 0"}
    """
    problem, (_, settings) = problem_of(text), guess()
    agents = random_agents(problem, 1, 1)
    settings = replace(learning(settings, episodes=4), learned=False)
    with pytest.raises(
        RewardNotFinite, match=r"bad was inf in step 2 for robot 0 \(generation 7, episode [2-9]"
    ):
        run_lifetimes(problem, agents, keys(KEY_OF_A_LATE_MISTAKE, 0, 1), 7, settings)
