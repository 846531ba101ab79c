import numpy as np
import pytest

from bbsd.evaluation import NotEnumerable, agents_of, detailed_outcomes, enumerate_starts, weighted_evaluation
from bbsd.kernel.streams import fold
from bbsd.solver.random_agents import random_agents
from tests.unit.architecture.designs import shipped
from tests.unit.problems import RICH, problem_of

STARTING = """
bbsd: 1
name: starting
constants: {{last: 2}}
environment: {{steps: 1, state: {{x: "{x}", y: "{y}"}}, sensors: {{s: "{s}"}}}}
behaviors: {{b: {{actions: {{a: {{x: x}}}}, rules: [otherwise: a]}}}}
structure: [b]
reward: {{r: "{reward}"}}
"""


def starting(x="0", y="0", s="0", reward="x + y"):
    return problem_of(STARTING.format(x=x, y=y, s=s, reward=reward))


def exact(problem):
    """The exact evaluation of one agent, and the returns and weights that it comes from."""
    every, weights = enumerate_starts(problem)
    agent = random_agents(problem, 0, 1)
    outcomes = list(detailed_outcomes(every, agent, np.arange(len(weights), dtype=np.uint64), 1))
    return (
        weighted_evaluation(every, outcomes, weights),
        np.concatenate([o.returns for o in outcomes]),
        weights,
    )


def test_every_start_is_tried_once():
    found, returns, weights = exact(starting("integers(3, 5)", "integers(-1, last)"))
    assert sorted(returns) == sorted(x + y for x in (3, 4, 5) for y in (-1, 0, 1, 2))
    np.testing.assert_allclose(weights, 1 / 12)
    assert found.mean == pytest.approx(4.5)


def test_starts_have_the_probabilities_of_their_chances():
    found, returns, weights = exact(starting("chance(0.25)", "integers(1, 2)", reward="(10 if x else 0) + y"))
    assert dict(zip(returns, weights, strict=True)) == {1: 0.375, 2: 0.375, 11: 0.125, 12: 0.125}
    assert found.mean == pytest.approx(2.5 + 1.5)


@pytest.mark.parametrize(("probability", "mean"), [("0", 0), ("1", 1), ("1 / last", 0.5)])
def test_a_chance_may_be_certain_or_impossible(probability, mean):
    assert exact(starting(f"chance({probability})", reward="1 if x else 0"))[0].mean == mean


def test_a_range_of_one_is_its_value():
    assert exact(starting("integers(5, 5)"))[0].mean == 5


def test_one_draw_used_twice_is_one_choice():
    found, returns, _ = exact(starting("integers(0, 3)", "x * x"))
    assert sorted(returns) == [0, 2, 6, 12]
    assert found.mean == 5


def test_without_draws_there_is_one_start():
    found, _, weights = exact(starting("7"))
    assert (found.mean, weights.tolist()) == (7, [1])


@pytest.mark.parametrize(
    ("problem", "message"),
    [
        (lambda: starting("uniform(0, 1)"), "a value is drawn by uniform"),
        (lambda: starting("integers(0, 1)", "integers(0, x)"), "a value is drawn by integers"),
        (lambda: starting("integers(0.5, 2)"), "a value is drawn by integers"),
        (lambda: starting("integers(0, 1)", s="normal(0, 1)"), "during the episode"),
        (lambda: starting("integers(1, 10000)", "integers(1, 101)"), "1010000 starts; at most 1000000"),
        (lambda: starting("integers(1, 10 ** 15)"), "from 1000000000000000 values"),
        (lambda: problem_of(RICH), "during the episode"),
    ],
)
def test_what_cannot_be_enumerated_says_why(problem, message):
    with pytest.raises(NotEnumerable, match=message):
        enumerate_starts(problem())


def test_the_abstract_problem_is_what_brute_force_finds():
    problem = problem_of(shipped("abstract"), seed=3, lanes=25)
    policy = np.array(problem.meaning.constants.plain("policy"), int)
    agents = random_agents(problem, fold(3, 4), 4)
    every, weights = enumerate_starts(problem)
    for agent in range(4):
        architecture = agents.architecture(agent)
        right = 0
        for row in range(5):
            for column in range(5):
                said = [
                    index
                    for index in architecture.structure[::-1]
                    if architecture.tables[index][5 * row + column]
                ]
                right += bool(said) and said[0] + 1 == policy[row, column]
        keys = np.arange(len(weights), dtype=np.uint64)
        found = weighted_evaluation(
            every, detailed_outcomes(every, agents_of([architecture]), keys, 1), weights
        )
        assert found.mean == pytest.approx((right - (25 - right)) / 25)
