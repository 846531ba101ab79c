"""Practice, beyond what every method keeps to."""

import numpy as np
import pytest

from bbsd.solver.arena import Arena
from bbsd.solver.methods.method import arrays_of
from bbsd.solver.methods.practice import METHOD, PUPILS, RUNGS
from tests.unit.problems import problem_of
from tests.unit.solver.problems import guess

pytestmark = pytest.mark.slow

FAR = """
bbsd: 1
name: far
environment:
  steps: 100
  state: {x: 0, going: 0}
  dynamics:
    x: min(max(x + going, 0), 10)
    going: 0
  sensors: {at: "values(x, 0, 10)"}
  ends: x == 10
behaviors:
  left: {inputs: [at], actions: {go: {going: -1}}}
  right: {inputs: [at], actions: {go: {going: 1}}}
reward: {arrived: 1 if x == 10 else 0}
"""
"""A reward at the end of a corridor alone: one random design in some thousand earns anything."""


def searched(arena, budget, key=7):
    state = METHOD.begin(arena, key, budget)
    while state.spent < budget:
        state = METHOD.advance(state, arena, key, budget)
    return state


def test_it_finds_a_reward_that_no_random_design_earns():
    arena = Arena(problem_of(FAR), 1)
    assert not arena.means(arena.space.random(1, 100), 1, 1).any()
    assert searched(arena, 4000).champions.fitness[0] == 1.0


def test_it_learns_the_value_of_being_nearer():
    arena = Arena(problem_of(FAR), 1)
    state = searched(arena, 4000)
    (running,) = state.running
    critic = state.pupils[running].critic
    assert (np.diff(critic[:10]) > 0).all()


def test_different_orders_practice_and_the_worse_ones_are_dropped():
    arena = Arena(guess()[0], 1)
    state = METHOD.begin(arena, 7, 8000)
    orders = {pupil.structure.tobytes() for pupil in state.pupils}
    assert len(state.running) == len(orders) == 6  # all there are
    while len(state.running) == 6:
        assert state.spent < 8000 * RUNGS[0] + 300
        state = METHOD.advance(state, arena, 7, 8000)
    assert len(state.running) == PUPILS // 2
    for measure in ("standing", "promise"):
        best = int(np.argmax([getattr(pupil, measure) for pupil in state.pupils]))
        assert best in state.running
    while state.spent < 8000:
        state = METHOD.advance(state, arena, 7, 8000)
    assert len(state.running) == 1


def test_a_given_order_practices_alone():
    arena = Arena(guess("structure: [reckless, even, odd]")[0], 1)
    state = METHOD.begin(arena, 7, 1000)
    assert [pupil.structure.tolist() for pupil in state.pupils] == [[0, 1, 2]]


@pytest.mark.parametrize("more", [{"lanes": 7}, {"lanes": 3, "jobs": 2}])
def test_all_that_was_learned_is_the_same_for_any_lanes_and_jobs(more):
    alone, other = (arrays_of(searched(Arena(problem_of(FAR, **kind), 1), 700)) for kind in ({}, more))
    assert {name: array.tobytes() for name, array in alone.items()} == {
        name: array.tobytes() for name, array in other.items()
    }
