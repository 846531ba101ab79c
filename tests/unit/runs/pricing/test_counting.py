from dataclasses import replace

import numpy as np
import pytest

from bbsd.kernel.keys import keys
from bbsd.runs.pricing.counting import Counter
from bbsd.solver.random_agents import random_agents
from tests.unit.compiler.twins import CORRIDOR_OUTSIDE, Corridor
from tests.unit.problems import problem_of


def test_episodes_are_counted_and_stay_what_they_are():
    counter, returns = Counter(), []
    for stepper in (Corridor, counter.counted(Corridor)):
        problem = replace(problem_of(CORRIDOR_OUTSIDE, lanes=4), stepper=stepper)
        agents = random_agents(problem, 3, 6)
        team = problem.assemble(agents.pools, agents.members, 1)
        outcome = team.detailed_episode(keys(4, 0, 6), agents.structures)
        returns.append(outcome.returns)
    np.testing.assert_array_equal(*returns)
    assert (counter.episodes, counter.steps) == (6, outcome.steps_taken.sum())
    assert counter.length == outcome.steps_taken.mean() < 9
    counter.clear()
    assert counter == Counter()


@pytest.mark.parametrize(
    ("length", "seconds"),
    [(40, 1.0 + 3.0 * 2), (20, 4.0), (5, 4.0)],
    ids=["twice as long", "as long", "never shorter"],
)
def test_time_beside_beginnings_is_in_proportion_to_the_steps(length, seconds):
    assert Counter(episodes=10, steps=200, beginning=1.0).stretched(4.0, length) == seconds
