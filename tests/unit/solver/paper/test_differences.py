"""What an agent earns less with a behavior held to No Action, on numbers worked by hand."""

import numpy as np
import pytest

from bbsd.evaluation import Agents, RewardNotFinite
from bbsd.kernel.keys import folded, keys
from bbsd.solver.paper.differences import Differences
from bbsd.solver.paper.lifetime import EPISODE, run_lifetimes
from bbsd.solver.random_agents import random_agents
from tests.unit.problems import problem_of
from tests.unit.solver.problems import guess, learning

TWO = """
bbsd: 1
name: two
environment: {steps: 4, state: {x: 0}}
behaviors:
  low: {actions: {a: {x: 1}}}
  high: {excited: step % 2 == 0, actions: {a: {x: 10}}}
  given: {actions: {a: {x: 100}}, rules: [otherwise: no action]}
reward: {x: x}
"""
ONES = np.ones((1, 1), np.uint8)


def agent(order):
    return Agents((ONES, ONES, ONES - 1), np.zeros((1, 3), np.int64), np.array([order]))


def differences(order, episodes=1):
    problem, one = problem_of(TWO), agent(order)
    sums = Differences(problem, one, 1)
    for _ in range(episodes):
        outcome = problem.assemble(one.pools, one.members, 1).episode(keys(1, 0, 1), one.structures)
        sums.add(keys(1, 0, 1), one.structures, outcome.returns, "episode 1")
    return sums.means.tolist()


@pytest.mark.parametrize("episodes", [1, 3])
def test_a_difference_is_what_is_earned_less_with_a_behavior_held_to_no_action(episodes):
    # x is 1, 10, 1, 10: 22. Without low x is 0, 10, 10, 10: 30, so low costs 8. Without high 1, 1, 1, 1: 4.
    assert differences([2, 0, 1], episodes) == [[22 - 30, 22 - 4, 0]]


def test_who_never_controls_makes_no_difference():
    # Under low, which always acts, x is 1, 1, 1, 1: 4. Without low x is 0, 10, 10, 10: 30.
    assert differences([2, 1, 0]) == [[4 - 30, 0, 0]]


def test_a_behavior_outside_of_the_structure_makes_no_difference():
    assert differences([2, 0]) == [[4 - 0, 0, 0]]


def test_lifetimes_compare_their_last_episodes_on_the_same_streams():
    problem, settings = guess(sharing="difference")
    agents, streams = random_agents(problem, 1, 8), keys(5, 0, 8)
    lives = run_lifetimes(problem, agents, streams, 1, learning(settings, episodes=4, last=2))
    earned = []
    for episode in (3, 4):
        before = run_lifetimes(problem, agents, streams, 1, learning(settings, episodes=episode, last=1))
        silent = agents.held(0)
        team = problem.assemble(silent.pools, silent.members, 1)
        without = team.episode(folded(folded(streams, EPISODE), episode), before.structures).returns
        earned.append(lives.returns[:, episode - 1] - without)
    np.testing.assert_array_equal(lives.differences[:, 0], (earned[0] + earned[1]) / 2)
    assert lives.differences[:, 0].any()
    assert not lives.differences[:, 2].any()  # nothing of it evolves


def test_lifetimes_are_the_same_under_every_policy():
    problem, settings = guess()
    agents, streams = random_agents(problem, 1, 8), keys(5, 0, 8)
    plain = run_lifetimes(problem, agents, streams, 1, settings)
    compared = run_lifetimes(problem, agents, streams, 1, guess(sharing="difference")[1])
    assert plain.differences is None
    for name in ("returns", "structures", "values"):
        np.testing.assert_array_equal(getattr(plain, name), getattr(compared, name))


def test_a_reward_that_is_not_finite_without_a_behavior_names_it():
    text = TWO.replace("reward: {x: x}", 'reward: {x: "1 / x if step > 1 else 0"}')
    problem, one = problem_of(text), agent([2, 1, 0])
    outcome = problem.assemble(one.pools, one.members, 1).episode(keys(1, 0, 1), one.structures)
    sums = Differences(problem_of(text.replace("step % 2 == 0", "step > 2")), one, 1)
    with pytest.raises(RewardNotFinite, match=r"x was inf in step 2 .*episode 7, low held to No Action"):
        sums.add(keys(1, 0, 1), one.structures, outcome.returns, "episode 7")
