import math

import numpy as np
import pytest

from bbsd.compiler import DetailedOutcome
from bbsd.evaluation import evaluation, from_the_top, interval, weighted_evaluation
from tests.unit.problems import problem_of

TWO = """
bbsd: 1
name: two
environment:
  robots: 2
  steps: 4
  state: {x: 0}
  sensors: {s: "list(x, -x)"}
behaviors:
  a: {actions: {do: {x: 1}}, expects: x > 0}
  b: {actions: {do: {x: 2}}, expects: x > 0}
reward: {one: x, other: -x}
"""


def outcome(returns, taken=4.0):
    """Episodes of two robots; a controls three robot-steps, in two as it expects, and nobody the others."""
    n = len(returns)
    returns = np.array(returns, np.float64)
    terms = np.stack([2 * returns, -returns], axis=1)
    control = np.tile([3.0, 0.0, 2 * taken - 3], (n, 1))
    odd = np.tile([0.0, 0, 0, 2, 0, 0, 1], (n, 1))
    return DetailedOutcome(
        returns, control, terms, control, np.full(n, taken), odd, np.tile([2.0, 0.0], (n, 1))
    )


def test_an_interval_is_the_normal_one_of_the_mean():
    found = interval(np.array([1.0, 2, 3, 6]))
    sd = math.sqrt((4 + 1 + 0 + 9) / 3)
    assert (found.mean, found.count) == (3, 4)
    assert found.sd == pytest.approx(sd)
    assert found.low == pytest.approx(3 - 1.959964 * sd / 2)
    assert found.high == pytest.approx(3 + 1.959964 * sd / 2)


def test_one_value_has_no_interval():
    found = interval(np.array([2.0]))
    assert found.mean == 2
    assert all(math.isnan(bound) for bound in (found.sd, found.low, found.high))


def test_sums_become_means_and_shares():
    found = evaluation(problem_of(TWO), [outcome([1, 2]), outcome([6], taken=2.0)], agents=1)
    assert (found.mean, found.episodes, found.agents, found.exact) == (3, 3, 1, False)
    assert found.reward_terms == {"one": 6, "other": -3}
    assert found.control_share == {"a": 9 / 20, "b": 0, "nobody": 11 / 20}
    assert found.expectation_share["a"] == 2 / 3
    assert math.isnan(found.expectation_share["b"])
    assert found.steps == pytest.approx(10 / 3)
    assert found.not_finite == {"s_0[1]": 6, "what decides a cell or an index": 3}
    assert found.ci95 == (found.returns.low, found.returns.high)


def test_with_several_agents_the_interval_is_that_of_their_means():
    found = evaluation(problem_of(TWO), [outcome([0, 2, 10, 14])], agents=2)
    by_agent = interval(np.array([1.0, 12]))
    assert (found.mean, found.returns.count) == (6.5, 4)
    assert found.ci95 == (by_agent.low, by_agent.high)
    assert found.sd == pytest.approx(np.std([0, 2, 10, 14], ddof=1))


def test_an_exact_evaluation_weighs_every_episode():
    found = weighted_evaluation(problem_of(TWO), [outcome([0]), outcome([8, 4])], np.array([0.5, 0.25, 0.25]))
    assert (found.mean, found.ci95, found.exact) == (3, (3, 3), True)
    assert found.sd == pytest.approx(math.sqrt(0.5 * 9 + 0.25 * 25 + 0.25 * 1))
    assert found.reward_terms == {"one": 6, "other": -3}
    assert found.control_share == {"a": 3 / 8, "b": 0, "nobody": 5 / 8}
    assert found.expectation_share["a"] == pytest.approx(2 / 3)
    assert math.isnan(found.expectation_share["b"])
    assert found.steps == 4


def test_what_each_episode_brought_is_kept_where_it_is_asked_for():
    problem = problem_of(TWO)
    outcomes = [outcome([1.0, 3.0]), outcome([2.0], taken=3.0)]
    found = evaluation(problem, outcomes, 1, keep_each=True)
    assert found.each.returns.tolist() == [1, 3, 2]
    assert found.each.terms["one"].tolist() == [2, 6, 4]
    assert found.each.steps.tolist() == [4, 4, 3]
    assert found.spread.episodes == {"worst": 0, "median": 2, "best": 1}
    assert evaluation(problem, outcomes, 1).each is None
    assert evaluation(problem, outcomes[1:], 1).spread is None
    exact = weighted_evaluation(problem, outcomes, np.array([0.5, 0.25, 0.25]), keep_each=True)
    assert exact.each.probabilities.tolist() == [0.5, 0.25, 0.25]


def test_behaviors_can_be_in_the_order_of_layers():
    found = from_the_top(evaluation(problem_of(TWO), [outcome([1.0, 3.0])], 1), ["b", "a"])
    assert [*found.control_share] == ["b", "a", "nobody"]
    assert [*found.expectation_share] == ["b", "a"]
    left_out = from_the_top(found, ["a"])
    assert [*left_out.control_share] == ["a", "b", "nobody"]


def test_what_is_not_finite_has_no_interval():
    for values in ([1.0, float("inf")], [float("inf"), float("-inf")], [1.0, float("nan")]):
        found = interval(np.array(values))
        assert found.count == 2
        assert all(np.isnan(value) for value in (found.mean, found.sd, found.low, found.high))
