import numpy as np
import pytest

from bbsd.language.meaning.tables.table import OPEN_CELL
from bbsd.solver.arena import Arena
from bbsd.solver.methods.q_learning.projection import projection
from tests.unit.problems import problem_of
from tests.unit.solver.problems import guess

TWO = """
bbsd: 1
name: two
environment: {steps: 1, state: {a: "integers(0, 1)", b: "integers(0, 1)", said: 0}}
behaviors:
  first: {inputs: {a: "values(a, 0, 1)"}, actions: {one: {said: 1}}}
  second: {inputs: {b: "values(b, 0, 1)"}, actions: {two: {said: 2}}}
reward: {right: said}
"""
"""Each behavior sees one half of what there is: the joint cells are (a, b) = 00, 01, 10, 11."""

FIRST_ABOVE, SECOND_ABOVE = np.array([1, 0]), np.array([0, 1])


def project(values, order, weights=(1, 1, 1, 1), given=(OPEN_CELL,) * 4):
    arena = Arena(problem_of(TWO), 1)
    return projection(
        arena.joint_control,
        np.array(given, np.uint8),
        np.array(values, float),
        np.array(weights, float),
        order,
    )


def test_what_behaviors_can_do_is_found_without_loss():
    # The first where a is 1, else the second where b is 1: only with the first above.
    values = [[1, 0, 0], [0, 0, 1], [0, 1, 0], [0, 1, 0]]
    table, loss = project(values, FIRST_ABOVE)
    assert (table.tolist(), loss) == ([0, 1, 0, 1], 0)
    assert project(values, SECOND_ABOVE).loss == pytest.approx(1 / 4)


def test_every_design_is_its_own_projection():
    problem, _ = guess()
    arena = Arena(problem, 1)
    designs = arena.space.random(2, 40)
    for table, structure in zip(designs.tables, designs.structures, strict=True):
        choices = arena.joint_control.controls(table, structure)
        values = np.eye(arena.joint_control.n_choices)[choices]
        again, loss = projection(arena.joint_control, arena.space.given, values, np.ones(4), structure)
        assert loss == 0
        assert (arena.joint_control.controls(again, structure) == choices).all()


def test_what_cannot_be_told_apart_is_decided_by_weight():
    # Where a is 0 the first should act if b is 0 and must not if b is 1.
    values = [[0, 1, 0], [2, 0, 0], [1, 0, 0], [1, 0, 0]]
    assert project(values, FIRST_ABOVE, (5, 1, 1, 1)).table[0] == 1
    assert project(values, FIRST_ABOVE, (1, 1, 1, 1)).table[0] == 0
    # 2 of 8 in one way, 5 of 8 in the other.
    assert project(values, FIRST_ABOVE, (5, 1, 1, 1)).loss == pytest.approx(2 / 8)


def test_behaviors_are_fitted_to_what_others_really_do():
    # At 00 the second would be best, but it cannot: at 10 it sees the same, and nobody must act. So the first acts.
    values = [[0, 3, 4], [0, 0, 0], [0, -100, -100], [0, -100, 0]]
    table, loss = project(values, FIRST_ABOVE)
    assert table[:3].tolist() == [1, 0, 0]
    assert loss == pytest.approx(1 / 4)


def test_given_cells_stay_and_cost_what_they_cost():
    values = [[1, 0, 0], [1, 0, 0], [1, 0, 0], [1, 0, 0]]
    table, loss = project(values, FIRST_ABOVE, given=(OPEN_CELL, 1, OPEN_CELL, OPEN_CELL))
    assert table.tolist() == [0, 1, 0, 0]
    assert loss == pytest.approx(1 / 2)


def test_cells_that_were_never_met_take_no_action():
    assert project([[0, 1, 2]] * 4, FIRST_ABOVE, (1, 0, 0, 0)).table.tolist() == [0, 0, 1, 0]
