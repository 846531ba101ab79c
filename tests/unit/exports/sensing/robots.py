"""A spec for the tests of sensing: memory, what was before, draws, lists, tables, and robots that differ."""

import bbsd
from bbsd.architecture import architecture_of
from bbsd.exports.exported import exported_design
from tests.unit.architecture.designs import SPECS, meaning_of, random_architecture
from tests.unit.exports.designs import SHIPPED

ROBOTS = """
bbsd: 1
name: robots
constants:
  full: 10
  gains: [1, 2.5]
  map: [[0, 1, 2], [3, 4, 5]]
environment:
  robots: {robots}
  steps: 25
  world:
    lamp: uniform(0, 9)
  state:
    place: uniform(0, 9)
    speed: robot
    charge: full
    turns: 0
    side: 3 - robot
    signal: false
    clock: 0
  dynamics:
    place: place + 0.3 * speed
    charge: max(charge - abs(speed), 0)
    signal: false
    clock: clock + 1 if place > 3 else 0
    lamp: lamp + 0.1
  sensors:
    light: list(lamp - place + k for k in range(2))
    noisy: light[0] + normal(0, 1)
    rising: light[1] > before(light[1])
    far: light[0] > side
    field: values(map[floor(place)][floor(light[0])], 0, 5)
    tired: clock > 4
    ahead: place > max(place[r] for r in team) - 0.5 if robot == 0 else light[0] > 1
    late: step > 15
    shape:
      round: noisy > 2
      flat: noisy ** 3 < -1
      other: otherwise
behaviors:
  go:
    inputs: [rising, far, tired, late]
    actions:
      on:
        speed: min(speed + gains[1], 4)
        turns: turns + uniform(0, 1) + integers(0, 3)
        signal: chance(0.5)
      back: {{speed: -1, signal: true}}
  turn:
    inputs: [shape, field]
    actions:
      left: {{turns: "normal(turns, 2)"}}
      right: {{turns: turns - speed}}
  rest:
    excited: charge < 5 and noisy > 0
    inputs: [ahead]
    actions:
      plug: {{charge: full}}
structure: [rest, turn, go]
reward: {{up: 1}}
""".replace("      on:\n", "      onward:\n")


def robots(count, seed=0):
    """This many robots with tables drawn."""
    meaning = meaning_of(ROBOTS.format(robots=count))
    return exported_design(meaning, random_architecture(meaning, seed))


def shipped(name, *overrides):
    """A shipped design as what is exported; a spec with holes gets tables that are drawn."""
    meaning = bbsd.load(SPECS / f"{name}.yaml", set=overrides).meaning
    design = architecture_of(meaning) if name in SHIPPED else random_architecture(meaning, 1)
    return exported_design(meaning, design)
