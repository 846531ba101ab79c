import numpy as np
import pytest

from bbsd.evaluation import agents_of, detailed_outcomes, evaluation_keys
from bbsd.evaluation.sums import column_sums
from bbsd.explanation.worth.earnings import earnings
from tests.unit.architecture.designs import random_architecture
from tests.unit.problems import RICH, problem_of

NAMED = RICH.replace("  goal:", "  weights: 2\n  goal:").replace("abs(x - goal)", "abs(x - goal) * weights")
MANY = RICH.replace("robots: 3", "robots: 12").replace(
    "chart: list(list(1, 2, 3), list(4, 5, 6))",
    f"chart: list({', '.join(['list(1, 2, 3)'] * 12)})",
)


@pytest.mark.parametrize(
    "text", [RICH, NAMED, MANY], ids=["three robots", "a constant of that name", "robots in loops"]
)
def test_earnings_divide_what_was_earned_by_who_controlled_and_by_term(text):
    problem, keys = problem_of(text), evaluation_keys(0, 8)
    agent = agents_of([random_architecture(problem.meaning, 3)])
    found = earnings(problem, agent, keys, 1)
    (outcome,) = detailed_outcomes(problem, agent, keys, 1)
    assert found.by_term.shape == (4, 2)
    np.testing.assert_allclose(found.by_term.sum(axis=1), column_sums(outcome.credit) / 8, rtol=0, atol=1e-11)
    np.testing.assert_allclose(found.by_term.sum(axis=0), column_sums(outcome.terms) / 8, rtol=0, atol=1e-11)
    np.testing.assert_array_equal(found.control, column_sums(outcome.control) / 8)
    np.testing.assert_array_equal(found.met, column_sums(outcome.expectations_met) / 8)
    assert found.steps == outcome.steps_taken.mean()
