import numpy as np
import pytest

from bbsd.compiler import compile_meaning
from bbsd.evaluation import agents_of, detailed_outcomes, evaluation_keys
from bbsd.evaluation.sums import column_sums
from bbsd.explanation.worth.earnings import earnings
from tests.unit.architecture.designs import random_architecture
from tests.unit.problems import RICH, problem_of
from tests.unit.tabular import LAKE, with_table

NAMED = RICH.replace("  goal:", "  weights: 2\n  goal:").replace("abs(x - goal)", "abs(x - goal) * weights")
MANY = RICH.replace("robots: 3", "robots: 12").replace(
    "chart: list(list(1, 2, 3), list(4, 5, 6))",
    f"chart: list({', '.join(['list(1, 2, 3)'] * 12)})",
)


def lake():
    meaning, table = with_table(LAKE.replace("{earned: earned}", "{earned: earned, toll: -0.25}"))
    return compile_meaning(meaning, compiled=False, lanes=1, table=table)


@pytest.mark.parametrize(
    "problem",
    [*map(problem_of, (RICH, NAMED, MANY)), lake()],
    ids=["three robots", "a constant of that name", "robots in loops", "a table of transitions"],
)
def test_earnings_divide_what_was_earned_by_who_controlled_and_by_term(problem):
    keys = evaluation_keys(0, 8)
    agent = agents_of([random_architecture(problem.meaning, 3)])
    found = earnings(problem, agent, keys, 1)
    (outcome,) = detailed_outcomes(problem, agent, keys, 1)
    assert found.by_term.shape == (problem.n_behaviors + 1, 2)
    np.testing.assert_allclose(found.by_term.sum(axis=1), column_sums(outcome.credit) / 8, rtol=0, atol=1e-11)
    np.testing.assert_allclose(found.by_term.sum(axis=0), column_sums(outcome.terms) / 8, rtol=0, atol=1e-11)
    np.testing.assert_array_equal(found.control, column_sums(outcome.control) / 8)
    np.testing.assert_array_equal(found.met, column_sums(outcome.expectations_met) / 8)
    assert found.steps == outcome.steps_taken.mean()
