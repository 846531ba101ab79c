"""Specs of environments with a table of transitions, and their tables, for the tests of what reads them."""

import gymnasium

from bbsd.environments.tables import copied_table
from tests.unit.architecture.designs import meaning_of

TAXI = """
bbsd: 1
name: taxi
environment:
  gymnasium: Taxi-v4
  steps: 60
  observation: {row: 5, column: 5, passenger: 5, stand: 4}
  action: act
  state: {act: 5}
  sensors: {i: "values(row, 0, 4)", j: "values(column, 0, 4)", aboard: passenger == 4}
behaviors:
  drive:
    inputs: [i, j, aboard]
    actions: {south: {act: 0}, north: {act: 1}, east: {act: 2}, west: {act: 3}}
  door:
    inputs: [i, j, aboard]
    actions: {for_one_in: {act: 4}, for_one_out: {act: 5}}
reward: {earned: earned}
"""

WALK = """
bbsd: 1
name: walk
environment:
  gymnasium: NAME
  with: WITH
  steps: 40
  observation: {square: SQUARES}
  action: way
  state: {way: 0}
  sensors: {place: "values(square, 0, SQUARES - 1)"}
behaviors:
  walk:
    inputs: [place]
    actions: {a: {way: 0}, b: {way: 1}, c: {way: 2}, d: {way: 3}}
reward: {earned: earned}
"""


def walk(name, squares, arguments="{}"):
    return WALK.replace("NAME", name).replace("WITH", arguments).replace("SQUARES", str(squares))


CLIFF = walk("CliffWalking-v1", 48)
LAKE = walk("FrozenLake-v1", 16)
ICE = walk("FrozenLake-v1", 16, "{is_slippery: false}")


def environment_of(meaning):
    """The environment that a spec names, unwrapped."""
    outside = meaning.spec.environment.outside
    return gymnasium.make(outside.target, **outside.arguments).unwrapped


def with_table(text):
    """The meaning of a spec, and the table of its environment."""
    meaning = meaning_of(text)
    return meaning, copied_table(environment_of(meaning))
