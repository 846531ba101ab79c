import pytest

from bbsd.runs.rehearsal import rehearse, smallest
from bbsd.solver.paper.settings import settings_of
from tests.unit.problems import RICH, problem_of
from tests.unit.solver.problems import guess


def test_a_rehearsal_is_as_small_as_can_be():
    _, settings = guess()
    small = smallest(settings)
    assert (small.coevolution.population, small.coevolution.agents, small.learning.episodes) == (2, 2, 2)
    assert small.coevolution.elites < small.coevolution.population


@pytest.mark.parametrize(
    "options",
    [
        {},
        {"structure": "structure: [even, odd]"},
        {"search": "exact", "sharing": "value"},
        {"culture": "none"},
    ],
    ids=str,
)
def test_every_kind_of_run_can_be_rehearsed(options):
    rehearse(*guess(**options))


def test_a_reward_that_is_not_finite_is_left_for_the_run_to_find():
    problem = problem_of(RICH.replace("reward:", "reward:\n  odd: 1 / (x - x)", 1))
    rehearse(problem, settings_of(problem.meaning))
