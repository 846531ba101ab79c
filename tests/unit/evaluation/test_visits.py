import numpy as np
import pytest

from bbsd.architecture import architecture_of
from bbsd.compiler import compile_meaning
from bbsd.evaluation import trace
from bbsd.evaluation.visits import count_visits, visits_of
from bbsd.kernel.keys import keys
from tests.unit.architecture.designs import meaning_of, shipped

TWO = """
bbsd: 1
name: two
environment: {robots: 2, steps: 6, ends: "all(x[r] >= 4 for r in team)", state: {x: "integers(0, 1)"}}
behaviors:
  upper:
    inputs: {far: x >= 2}
    excited: x >= 1
    actions: {go: {x: x + 2}}
    rules: [{when: {far: true}, do: go}, otherwise: no action]
  lower:
    inputs: {at: "values(x, 0, 3)"}
    actions: {go: {x: x + 1}}
    rules: [{when: {at: 3}, do: no action}, otherwise: go]
structure: [upper, lower]
reward: {right: x}
"""


@pytest.mark.parametrize("text", [TWO, shipped("object_lifting_hand")], ids=["two", "lifting"])
def test_visits_are_those_of_the_episodes_traces(text):
    meaning = meaning_of(text)
    problem, architecture = compile_meaning(meaning, compiled=False), architecture_of(meaning)
    visits = count_visits(problem, architecture, 7, 3, 1)
    controlled, steps = np.zeros(len(problem.tables), int), 0
    for key in keys(7, 0, 3).tolist():
        decisions = trace(problem, architecture, key, 1).decisions
        steps += decisions.controlling.size
        controlled += [
            np.count_nonzero(decisions.controlling == index) for index in range(len(problem.tables))
        ]
    assert visits.robot_steps == steps
    assert [int(cells.sum()) for cells in visits.controlled] == controlled.tolist()
    assert visits.nobody == steps - controlled.sum()


def test_a_cell_is_asked_where_its_behavior_is_excited_and_no_higher_one_acts():
    meaning = meaning_of(TWO)
    visits = visits_of(meaning, architecture_of(meaning), 0, 20)
    upper, lower = visits.asked
    assert visits.episodes == 20
    assert lower[2] == lower[3] == 0  # there the upper one acts
    assert upper[0] == lower[1]  # excited, and without an action
    assert (visits.controlled[0] == upper * [0, 1]).all()


def test_compiled_or_not_the_counts_are_the_same():
    meaning = meaning_of(TWO)
    plain, compiled = (
        count_visits(compile_meaning(meaning, compiled=compiled), architecture_of(meaning), 1, 50, 1)
        for compiled in (False, True)
    )
    assert all(np.array_equal(*pair) for pair in zip(plain.asked, compiled.asked, strict=True))
    assert plain.robot_steps == compiled.robot_steps
