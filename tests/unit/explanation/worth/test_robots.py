import pytest

from bbsd.architecture import given_architecture
from bbsd.evaluation import evaluation_keys
from bbsd.explanation.worth import robots
from bbsd.explanation.worth.robots import robots_alike
from tests.unit.problems import problem_of

LINE = """
bbsd: 1
name: line
environment:
  robots: 3
  steps: 4
  state: {{x: "0 if robot < 2 else 1", seen: 0}}
  dynamics: {{seen: "seen + (robot if step > {late} else 0)"}}
  sensors: {{last: robot == 2}}
behaviors:
  go:
    inputs: [last]
    actions: {{move: {{x: x + 1}}, stay: {{x: x}}}}
    rules: [{{when: {{last: true}}, do: stay}}, {{otherwise: move}}]
structure: [go]
reward: {{far: x}}
{view}
"""
VIEW = "view: {at: [x, 0]}"


def alike(late=2, view=""):
    problem = problem_of(LINE.format(late=late, view=view))
    return robots_alike(problem, given_architecture(problem), evaluation_keys(0, 3), 1)


def test_all_pairs_are_compared_step_by_step():
    first, second, third = alike()
    assert (first.first, first.second, first.episodes) == (0, 1, 3)
    assert (first.same_action, first.same_state, first.same_place) == (1.0, 0.5, None)
    # The last one stands at 1, where the others are after the first step.
    assert (second.same_action, second.same_state) == (0.0, 0.25)
    assert (third.first, third.second, third.same_state) == (1, 2, 0.25)


def test_places_are_those_of_the_view():
    first, second, _ = alike(view=VIEW)
    assert (first.same_state, first.same_place) == (0.5, 1.0)
    assert second.same_place == 0.25


@pytest.mark.parametrize("most", [1, 2])
def test_larger_teams_are_not_looked_at(most, monkeypatch):
    monkeypatch.setattr(robots, "MOST_ROBOTS", most)
    assert alike() == ()
