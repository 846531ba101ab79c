import numpy as np
import pytest

from bbsd.architecture import given_architecture
from bbsd.evaluation import trace
from bbsd.evaluation.tracing.scene import starting_values
from tests.unit.architecture.designs import meaning_of
from tests.unit.problems import RICH, problem_of

WALK = """
bbsd: 1
name: walk
constants:
  rocks: [[1, 2, 0.5], [3, 4, size]]
  size: 2 * generation
  chart: [10, 20, 30]
environment:
  robots: 2
  steps: 5
  world: {w: 0}
  state: {x: 10 * robot, awake: "true"}
  definitions: {seen: "chart[w]"}
  dynamics: {w: w + 1}
  sensors: {pair: "list(x, -x)"}
  ends: w == 3
view:
  at: ["pair[0]", "1 if awake else 0", 0.5]
  heading: step / 10 + robot
  circles: rocks
  grid: [[0, 1], [w, 0]]
  paths: {track: [[0, 0], [w, size]]}
  marks: {lamp: [seen, step]}
behaviors:
  go:
    actions: {near: {x: x + 1}, far: {x: x + 2, awake: "false"}}
    inputs: {first: robot == 0}
    rules: [{when: {first: true}, do: near}, {otherwise: far}]
structure: [go]
reward: {x: x}
"""


def seen(text, generation=3):
    problem = problem_of(text)
    return trace(problem, given_architecture(problem), 1, generation).scene


def test_a_spec_without_a_view_has_no_scene():
    assert seen(WALK.replace("view:", "x-view:")) is None


def test_a_scene_begins_at_the_start_and_has_every_step():
    found = seen(WALK)
    assert found.places[..., 0].tolist() == [[0, 1, 2, 3], [10, 12, 14, 16]]
    assert found.places[..., 1].tolist() == [[1, 1, 1, 1], [1, 0, 0, 0]]
    assert set(found.places[..., 2].ravel()) == {0.5}
    assert found.headings == pytest.approx(np.array([[0, 0.1, 0.2, 0.3], [1, 1.1, 1.2, 1.3]]))


def test_what_is_there_once_is_as_at_the_end():
    found = seen(WALK)
    assert found.circles.tolist() == [[1, 2, 0.5], [3, 4, 6]]
    assert found.grid.tolist() == [[0, 1], [3, 0]]
    assert found.paths["track"].tolist() == [[0, 0], [3, 6]]
    assert found.area is None


def test_marks_are_followed_and_an_index_clamps():
    assert seen(WALK).marks["lamp"].tolist() == [[10, 0], [20, 1], [30, 2], [30, 3]]


def test_a_start_is_the_one_that_the_episode_begins_with():
    still = """
bbsd: 1
name: still
constants: {low: 2, wide: "3 if generation > 1 else 1"}
environment:
  robots: 3
  steps: 1
  world: {w: "normal(0, 1)"}
  state: {x: "uniform(low, low + wide) + w", n: "integers(0, 9)", armed: chance(0.5)}
behaviors: {b: {actions: {a: {x: x}}, rules: [otherwise: a]}}
structure: [b]
reward: {r: 0}
"""
    problem = problem_of(still)
    for key in (1, 7, 2**63 + 5):
        after = trace(problem, given_architecture(problem), key, 2).values
        found = starting_values(meaning_of(still), key, problem.meaning.constants.vector(2))
        assert found == {slot: column[0] for slot, column in after.items()}


def test_a_start_has_every_stored_value_of_a_rich_spec():
    meaning = meaning_of(RICH)
    found = starting_values(meaning, 1, meaning.constants.vector(1))
    assert found.keys() == meaning.episode.after.keys()
    assert {found["place", robot, ()] for robot in range(3)} == {0.0, 1.0}
    assert found["sides", 0, (0,)] == found["x", 0, ()] - 1
