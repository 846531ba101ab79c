import numpy as np
import pytest

from bbsd.solver.arena import Arena
from bbsd.solver.methods.method import arrays_of, restored
from bbsd.solver.methods.q_learning import q_learning
from bbsd.solver.methods.q_learning.q_learning import METHOD, TooManyJointCells
from tests.unit.problems import problem_of
from tests.unit.solver.problems import guess

KEY = 5

EITHER = """
bbsd: 1
name: either
environment: {steps: 2, state: {a: "integers(0, 1)", b: "integers(0, 1)", said: 0}}
behaviors:
  first: {inputs: {a: "values(a, 0, 1)"}, actions: {one: {said: 1}}}
  second: {inputs: {b: "values(b, 0, 1)"}, actions: {two: {said: 2}}}
reward: {right: 1 if said == (1 if a == b else 2) else 0}
"""
"""Who should act depends on whether the behaviors see the same, which neither sees."""


def states(arena, budget, key=KEY):
    """The states of a search, the first included."""
    states = [METHOD.begin(arena, key, budget)]
    while states[-1].spent < budget:
        states.append(METHOD.advance(states[-1], arena, key, budget))
    return states


def arena(lanes=None):
    return Arena(guess(lanes=lanes)[0], 1)


def test_what_projects_without_loss_becomes_the_first_champion():
    *_, end = states(arena(), 4000)
    assert end.champions.fitness[0] == end.joint_mean == 2
    assert end.loss == pytest.approx(0, abs=1e-9)


def test_what_behaviors_cannot_do_stays_a_reference():
    *_, end = states(Arena(problem_of(EITHER), 1), 4000)
    assert end.joint_mean == 2
    assert end.projected_mean < 1.9
    assert end.loss > 0.1


@pytest.mark.parametrize("budget", [1, 2, 3, 60, 2005, 2300])
def test_rounds_spend_something_and_together_the_budget(budget):
    spent = [state.spent for state in states(arena(), budget)]
    assert spent[-1] == budget
    assert (np.diff(spent) > 0).all()


def test_a_search_that_was_written_down_goes_on_equally():
    whole = states(arena(), 3000)
    half = whole[-3]
    again = restored(METHOD.begin(arena(), KEY, 3000), arrays_of(half))
    while again.spent < 3000:
        again = METHOD.advance(again, arena(), KEY, 3000)
    assert str(arrays_of(again)) == str(arrays_of(whole[-1]))


def test_lanes_change_nothing_and_keys_do():
    ends = [
        str(arrays_of(states(arena(lanes), 2500, key)[-1])) for lanes, key in ((1, KEY), (64, KEY), (64, 6))
    ]
    assert ends[0] == ends[1] != ends[2]


def test_a_partition_that_is_too_fine_is_refused(monkeypatch):
    monkeypatch.setattr(q_learning, "MOST_VALUES", 4 * 6 - 1)
    with pytest.raises(TooManyJointCells):
        METHOD.begin(arena(), KEY, 100)
    monkeypatch.setattr(q_learning, "MOST_VALUES", 4 * 6)
    METHOD.begin(arena(), KEY, 100)
