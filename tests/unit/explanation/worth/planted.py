"""Designs with something wrong in them, and what is right in others, for the tests of worth."""

from bbsd.architecture import given_architecture
from bbsd.evaluation import evaluation_key
from bbsd.explanation.worth import Appraisal
from tests.unit.problems import problem_of

PLANTED = """
bbsd: 1
name: planted
environment:
  robots: {robots}
  steps: 10
  world: {{calls: chance(0.5)}}
  state:
    x: 0
    debt: 0
    took: 0
    mood: {mood}
  dynamics:
    calls: chance(0.5)
    mood: (mood + 1) % 2
  sensors:
    tempted: calls
    sure: values(mood, 0, 3)
behaviors:
  work:
    inputs: [sure]
    actions:
      go: {{x: 1, took: 0}}
      stay: {{x: 0, took: 0}}
    rules:
      - when: {{sure: 0}}
        do: go
      - when: {{sure: 3}}
        do: stay
      - otherwise: go
    expects: {expects}
  grab:
    inputs: [tempted]
    actions:
      take: {{took: 1, debt: debt + 1}}
    rules:
      - when: {{tempted: {tempting}}}
        do: take
      - otherwise: no action
  guard:
    excited: x > 9
    actions:
      rest: {{x: 0}}
    rules:
      - otherwise: rest
structure: [guard, grab, work]
reward:
  loot: 3 * took
  cost: "-{cost} * debt if took == 0 else 0"
  work: x if took == 0 else 0
"""


def planted(robots=1, mood="integers(0, 1)", expects="x > 0", tempting="true", cost=2):
    """The text of a design that is planted with mistakes: `grab` is selfish, `guard` idle, a rule of `work` useless."""
    return PLANTED.format(robots=robots, mood=mood, expects=expects, tempting=tempting, cost=cost)


def appraisal_of(text, episodes=200, compiled=False):
    problem = problem_of(text, compiled=compiled)
    return Appraisal(problem, given_architecture(problem), evaluation_key(0), episodes, 1)


def needed():
    """The text of a design whose rewards are infinite without `work`."""
    return planted().replace("  work: x if took == 0 else 0", "  work: 1 / (x + took)")
