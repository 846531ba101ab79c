"""Who controls, told by what the controlling actions leave behind."""

import numpy as np
import pytest

from tests.unit.problems import episode_of, lived, problem_of

CHOOSING = """
bbsd: 1
name: choosing
environment: {{robots: {robots}, steps: 1, state: {{x: 0, at: robot}}}}
behaviors:
{behaviors}
reward: {{x: x}}
"""


def choosing(*behaviors, robots=1):
    """A problem whose return says which actions controlled; each behavior sets x."""
    lines = [f"  {name}: {{{parts}}}" for name, parts in behaviors]
    return problem_of(CHOOSING.format(robots=robots, behaviors="\n".join(lines)))


def control_of(problem, tables, structure):
    """The return, and the robot-steps of each behavior and nobody."""
    outcome = episode_of(problem, tables, structure)
    return float(outcome.returns[0]), outcome.control[0].tolist()


LOW = ("low", "actions: {a: {x: 1}, b: {x: 2}}")
HIGH = ("high", "actions: {a: {x: 10}, b: {x: 20}, c: {x: 30}}")
CALM = ("calm", "excited: x > 0, actions: {a: {x: 100}}")


def test_the_highest_activated_layer_controls():
    problem = choosing(LOW, HIGH)
    assert control_of(problem, [[2], [3]], [0, 1]) == (30, [0, 1, 0])
    assert control_of(problem, [[2], [3]], [1, 0]) == (2, [1, 0, 0])


def test_no_action_gives_way_to_the_layers_below():
    assert control_of(choosing(LOW, HIGH), [[1], [0]], [0, 1]) == (1, [1, 0, 0])


def test_a_behavior_that_is_not_excited_gives_way():
    assert control_of(choosing(LOW, CALM), [[1], [1]], [0, 1]) == (1, [1, 0, 0])


def test_nobody_controls_where_all_have_no_action():
    assert control_of(choosing(LOW, HIGH), [[0], [0]], [0, 1]) == (0, [0, 0, 1])


def test_a_behavior_outside_the_structure_never_controls():
    problem = choosing(LOW, HIGH, CALM)
    assert control_of(problem, [[0], [1], [1]], [0]) == (0, [0, 0, 0, 1])
    assert control_of(problem, [[1], [1], [1]], [2, 0]) == (1, [1, 0, 0, 0])


def test_one_behavior_alone_decides():
    assert control_of(choosing(HIGH), [[2]], [0]) == (20, [1, 0])


def test_each_robot_is_controlled_by_what_it_sees():
    problem = choosing(
        ("own", "inputs: {at: 'values(at, 0, 2)'}, actions: {a: {x: 1}, b: {x: 100}}"), robots=3
    )
    assert control_of(problem, [[1, 0, 2]], [0]) == ((1 + 0 + 100) / 3, [2, 1])


def test_two_hundred_actions_are_told_apart():
    many = ", ".join(f"do_{action}: {{x: {action}}}" for action in range(1, 201))
    problem = choosing(("many", f"actions: {{{many}}}"), LOW, ("more", f"actions: {{{many}}}"))
    for action in (1, 127, 128, 200):
        assert control_of(problem, [[action], [1], [0]], [0, 2])[0] == action
        assert control_of(problem, [[0], [1], [action]], [1, 2, 0]) == (action, [0, 0, 1, 0])


@pytest.mark.parametrize("robots", [1, 3])
def test_tables_larger_than_a_word_are_looked_up(robots):
    text = f"""
    bbsd: 1
    name: large
    environment: {{robots: {robots}, steps: 90, state: {{x: 0}}, dynamics: {{x: x + 1}}}}
    behaviors:
      small: {{inputs: {{odd: "x % 2 == 1"}}, actions: {{a: {{x: x}}}}}}
      large: {{inputs: {{x: "values(x, 0, 89)"}}, actions: {{a: {{x: x}}, b: {{x: x}}}}}}
      larger: {{inputs: {{x: "values(x, 0, 89)", odd: "x % 2 == 1"}}, actions: {{a: {{x: x}}}}}}
    reward: {{each: 1}}
    """
    problem = problem_of(text)
    rng = np.random.default_rng(robots)
    large = rng.integers(0, 3, 90)
    larger = rng.integers(0, 2, (90, 2))
    seen = larger[np.arange(90), np.arange(90) % 2]  # row-major over the inputs
    outcome = episode_of(problem, [[0, 1], large, larger.ravel()], [0, 1, 2])
    by_larger = int(np.count_nonzero(seen))
    by_large = int(np.count_nonzero((seen == 0) & (large > 0)))
    by_small = int(np.count_nonzero((seen == 0) & (large == 0) & (np.arange(90) % 2 == 1)))
    expected = np.array([by_small, by_large, by_larger, 90 - by_small - by_large - by_larger])
    np.testing.assert_array_equal(outcome.control[0], robots * expected)
    np.testing.assert_allclose(outcome.credit[0], expected)


def test_lanes_refer_to_individuals_of_small_and_large_tables():
    text = """
    bbsd: 1
    name: pools
    environment: {steps: 1, state: {x: 70}}
    behaviors:
      small: {actions: {a: {x: 1}, b: {x: 2}}}
      large: {inputs: {x: "values(x, 0, 99)"}, actions: {a: {x: 10}}}
    reward: {x: x}
    """
    problem = problem_of(text, lanes=2)
    large = np.zeros((3, 100), np.uint8)
    large[1, 70] = 1
    pools = (np.array([[1], [2]], np.uint8), large)
    members = np.array([[0, 0], [1, 0], [0, 1], [1, 1], [1, 2]])
    structures = np.repeat([[0, 1]], 5, axis=0)
    team = problem.assemble(pools, members, 1)
    outcome = team.episode(np.arange(5, dtype=np.uint64), structures)
    assert outcome.returns.tolist() == [1, 2, 10, 10, 2]


def test_random_agents_are_controlled_by_somebody_or_nobody_in_every_robot_step():
    problem = choosing(LOW, HIGH, CALM, robots=4)
    np.testing.assert_array_equal(lived(problem, 20).control.sum(axis=1), 4)
