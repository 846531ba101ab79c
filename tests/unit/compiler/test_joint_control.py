import numpy as np
import pytest

from bbsd.compiler.joint_control import JointControl
from bbsd.evaluation import Agents, returns_of
from bbsd.kernel.keys import keys
from bbsd.solver.space import Space
from tests.unit.problems import RICH, problem_of
from tests.unit.solver.problems import guess

ROLES = """
bbsd: 1
name: roles
environment: {robots: 5, steps: 3, state: {x: "uniform(0, 1)", way: 0}, dynamics: {x: x + way}}
behaviors:
  lead: {excited: robot == 0, inputs: {far: x > 1}, actions: {go: {way: 1}, wait: {way: 0}}}
  follow: {inputs: {far: x > 1, middle: "cut(x, 0.5, 1.5)"}, actions: {go: {way: 0.5}, back: {way: -0.5}}}
reward: {there: x}
"""
"""One behavior is for the first robot only; both see one value, and the robots are written in a loop."""


@pytest.mark.parametrize("text", [RICH, ROLES])
def test_the_joint_table_of_a_designs_choices_earns_the_same_to_the_bit(text):
    problem = problem_of(text)
    space, control = Space(problem), JointControl(problem)
    designs, episodes = space.random(3, 6), keys(1, 0, 3)
    joint = np.stack(
        [
            control.controls(table, structure)
            for table, structure in zip(designs.tables, designs.structures, strict=True)
        ]
    )
    agents = Agents((joint,), np.arange(6)[:, np.newaxis], np.zeros((6, 1), np.int64))
    by_design = returns_of(problem, space.agents(designs), episodes, 1)
    assert (by_design == returns_of(control.joint_problem, agents, episodes, 1)).all()
    assert len(np.unique(by_design)) > 6


def test_what_behaviors_share_is_in_the_joint_partition_once():
    control = JointControl(problem_of(ROLES))
    # Far or not, three thirds, and whether the robot is the first.
    assert control.partition.n_cells == 2 * 3 * 2
    assert control.n_choices == 5
    assert {tuple(cells) for cells in control.cells.T} == {
        (far, 3 * far + third) for far in range(2) for third in range(3)
    }


def test_choices_of_a_behavior_that_is_not_excited_are_impossible():
    control = JointControl(problem_of(ROLES))
    assert control.excited[1].all()
    assert control.excited[0].sum() == 6
    assert (control.possible[:, 1:3] == control.excited[0][:, np.newaxis]).all()
    assert control.possible[:, [0, 3, 4]].all()


def test_the_higher_layer_controls_where_it_acts():
    problem, _ = guess()
    control = JointControl(problem)
    table = np.array([1, 0, 0, 0, 2, 2, 2, 2, 1], np.uint8)
    odd, even, reckless = 0, 1, 2
    # Numbered over all behaviors: 1 and 2 of odd, 3 and 4 of even, 5 of reckless.
    assert control.controls(table, np.array([reckless, even, odd])).tolist() == [1, 4, 4, 4]
    assert control.controls(table, np.array([odd, even, reckless])).tolist() == [5, 5, 5, 5]
    assert control.controls(table, np.array([reckless, odd])).tolist() == [1, 5, 5, 5]
