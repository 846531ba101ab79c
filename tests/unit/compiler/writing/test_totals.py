import numpy as np
import pytest

from tests.unit.problems import RICH, episode_of, lived, problem_of

COUNTING = """
bbsd: 1
name: counting
environment:
  robots: 2
  steps: 5
  state: {{x: robot}}
  dynamics: {{x: x + 1}}
  ends: {ends}
behaviors:
  low: {{inputs: {{far: x >= 3}}, actions: {{a: {{x: x}}}}}}
  high: {{inputs: {{far: x >= 3}}, actions: {{a: {{x: x}}}}}}
reward:
{reward}
"""


def counting(ends="false", place="x", reward=None):
    """Robots that start at 0 and 1 and go on by 1 a step."""
    terms = reward or f"place: {place}, each: 10"
    lines = [f"  {name}: '{text}'" for name, text in (term.split(": ") for term in terms.split(", "))]
    return problem_of(COUNTING.format(ends=f'"{ends}"', reward="\n".join(lines)))


NEAR_AND_FAR = [[1, 0], [0, 1]]  # low controls near, high far
POOLS = tuple(np.array([table], np.uint8) for table in NEAR_AND_FAR)


def test_a_robot_s_part_goes_to_what_controlled_it():
    outcome = episode_of(counting(), NEAR_AND_FAR, [0, 1])
    # Robot 0 is at 0, 1, 2 under low and earns 11, 12, 13; then at 3, 4 under high: 14, 15.
    # Robot 1 is at 1, 2 under low and earns 12, 13; then at 3, 4, 5 under high: 14, 15, 16.
    assert outcome.credit.tolist() == [[(36 + 25) / 2, (29 + 45) / 2, 0]]
    assert outcome.control.tolist() == [[5, 5, 0]]
    assert outcome.returns.tolist() == [(65 + 70) / 2]


def test_what_nobody_controlled_is_nobody_s():
    outcome = episode_of(counting(), [[1, 0], [1, 0]], [0, 1])
    assert outcome.credit.tolist() == [[0, (36 + 25) / 2, (29 + 45) / 2]]
    assert outcome.control.tolist() == [[0, 5, 5]]


def test_terms_sum_up_to_the_return():
    outcome = episode_of(counting(), NEAR_AND_FAR, [0, 1])
    assert outcome.terms.tolist() == [[(15 + 20) / 2, 50]]


MOSTLY_NOTHING = {
    "the first": "far: 1 if x > 2 else 0, near: x",
    "some": "place: 0.1 * x, far: 0.3 if x > 2 else 0, each: 0.7, odd: x if x % 2 == 1 else 0",
    "many": ", ".join(["place: 0.1 * x", *(f"above_{n}: 0.{n} if x > {n} else 0" for n in range(1, 9))]),
    "something otherwise": "place: 0.1 * x, far: 1 if x > 2 else 0.5, near: 0 if x > 2 else 0.25",
    "minus nothing": "none: -0.0 * x, never: 1 if x > 9 else 0, nor: 1 if x > 9 else -0.0",
    "not a number": "none: x, odd: x / 0 - x / 0 if x > 3 else 0",
    "of the team": "place: x, far: sum(1 if x[r] > 2 else 0 for r in team), near: -1 if x < 2 else 0",
}


@pytest.mark.parametrize("ends", ["false", "sum(x[r] for r in team) >= 8"], ids=["to the last", "an end"])
@pytest.mark.parametrize("reward", MOSTLY_NOTHING.values(), ids=MOSTLY_NOTHING)
def test_terms_that_are_mostly_nothing_add_up_alike_with_details_and_without(reward, ends):
    team = counting(ends, reward=reward).assemble(POOLS, np.zeros((1, 2), np.int64), 1)
    keys, structure = np.array([1], np.uint64), np.array([[0, 1]])
    swift, detailed = team.episode(keys, structure), team.detailed_episode(keys, structure)
    assert swift.returns.tobytes() == detailed.returns.tobytes()
    assert swift.credit.tobytes() == detailed.credit.tobytes()


def test_the_step_in_which_an_episode_ends_is_the_last_that_counts():
    outcome = episode_of(counting(ends="any(x[r] >= 3 for r in team)"), NEAR_AND_FAR, [0, 1])
    assert outcome.steps_taken.tolist() == [2]
    assert outcome.returns.tolist() == [(11 + 12 + 12 + 13) / 2]
    assert outcome.credit.tolist() == [[(23 + 25) / 2, 0, 0]]
    assert outcome.control.tolist() == [[4, 0, 0]]
    assert outcome.terms.tolist() == [[(1 + 2 + 2 + 3) / 2, 20]]


def test_what_is_not_finite_after_the_end_is_not_earned():
    outcome = episode_of(counting(ends="step == 2", place="1 / (3 - step)"), NEAR_AND_FAR, [0, 1])
    assert outcome.returns.tolist() == [0.5 + 1 + 20]


def test_lanes_end_by_themselves():
    text = """
    bbsd: 1
    name: lanes
    environment: {steps: 50, state: {x: "integers(1, 40)"}, dynamics: {x: x - 1}, ends: x <= 0}
    behaviors: {idle: {actions: {a: {x: x}}}}
    reward: {each: 1}
    """
    alone, together = (lived(problem_of(text, lanes=lanes), 30) for lanes in (1, 30))
    assert len(set(alone.steps_taken)) > 10
    np.testing.assert_array_equal(alone.steps_taken, alone.returns)
    np.testing.assert_array_equal(together.steps_taken, alone.steps_taken)
    np.testing.assert_array_equal(together.control, alone.control)


def test_steps_in_which_a_value_is_not_finite_are_counted_by_its_place():
    text = """
    bbsd: 1
    name: odd
    environment:
      robots: 2
      steps: 4
      world: {w: 0}
      state: {x: 1}
      dynamics: {w: "1 / (step - 2)"}
      sensors: {s: "list(log(robot + x - x), sqrt(x - step))"}
      ends: step == 3
    behaviors: {idle: {actions: {a: {x: x}}}}
    reward: {each: 1}
    """
    problem = problem_of(text)
    *counts, deciding = episode_of(problem, [[0]], [0]).not_finite[0].tolist()
    counted = dict(zip(problem.checked_slots, counts, strict=True))
    assert deciding == 0
    assert counted == {
        ("w", None, ()): 1,
        ("x", 0, ()): 0,
        ("x", 1, ()): 0,
        ("s", 0, (0,)): 3,
        ("s", 0, (1,)): 2,
        ("s", 1, (0,)): 0,
        ("s", 1, (1,)): 2,
    }


def test_the_columns_of_credit_earn_the_return_together():
    outcome = lived(problem_of(RICH), 20)
    np.testing.assert_allclose(outcome.credit.sum(axis=1), outcome.returns, rtol=1e-12)
    np.testing.assert_allclose(outcome.terms.sum(axis=1), outcome.returns, rtol=1e-12)
    np.testing.assert_array_equal(outcome.control.sum(axis=1), 3 * outcome.steps_taken)


EXPECTING = """
bbsd: 1
name: expecting
environment:
  robots: 2
  steps: 5
  state: {x: robot}
  dynamics: {x: x + 1}
  sensors: {far: x >= 3}
  ends: "any(x[r] >= 4 for r in team)"
behaviors:
  low: {inputs: [far], actions: {a: {x: x}}, expects: not far and before(x) == x - 1}
  idle: {actions: {a: {x: x}}}
  high: {inputs: [far], actions: {a: {x: x}}, expects: not before(far)}
reward: {each: 1}
"""


def test_expectations_are_counted_after_the_steps_that_their_behavior_controlled():
    # Robot 0 is at 0, 1, 2 before and 1, 2, 3 after steps of low; robot 1 at 1, 2 and 2, 3, then at 3 under high.
    outcome = episode_of(problem_of(EXPECTING), [[1, 0], [0], [0, 1]], [0, 1, 2])
    assert outcome.steps_taken.tolist() == [3]
    assert outcome.control.tolist() == [[5, 0, 1, 0]]
    assert outcome.expectations_met.tolist() == [[3, 0]]


DECIDING = """
bbsd: 1
name: deciding
constants: {{sizes: [1, 2, 3]}}
environment:
  robots: {robots}
  steps: 6
  state: {{x: "0 * uniform(0, 1)", y: 1, waiting: "list(5, 6)"}}
  dynamics: {{y: "{y}", waiting: "list(waiting[1], waiting[0])"}}
behaviors:
  look: {{inputs: {{seen: "{seen}"}}, actions: {{on: {{x: x}}}}}}
reward: {{one: 1}}
"""


@pytest.mark.parametrize("robots", [2, 9])
@pytest.mark.parametrize(
    ("seen", "y", "steps"),
    [
        ("y > 0", "y", 0),
        ("cut(y + step, 2, 3)", "sizes[step % 3]", 0),
        ("cut(sqrt(3 - step), 0, 1)", "y", 3),  # in steps 4 to 6
        ("x / (x * step) < 1", "y", 6),
        ("values(floor(y / x * x), 0, 2)", "y", 6),
        ("y > 0", "sizes[floor(x / x)]", 6),
        ("y > 0", "sizes[floor(log(step - 3))]", 3),  # below 0 in steps 1 and 2, of 0 in step 3
        ("y > 0", "waiting[floor(x / x)]", 6),
        ("cut(y / x, 0, 1)", "waiting[floor(x / x)]", 6),
    ],
)
def test_what_decides_a_cell_or_an_index_is_counted_where_it_is_not_finite(seen, y, steps, robots):
    problem = problem_of(DECIDING.format(seen=seen, y=y, robots=robots))
    *by_slot, deciding = episode_of(problem, [[1] * problem.tables[0].n_cells], [0]).not_finite[0].tolist()
    assert not any(by_slot)
    assert deciding == steps  # each counts once, in a loop over robots or not
