from bbsd.exports.exported import fixed_values
from tests.unit.architecture.designs import meaning_of, small

BEHAVIORS = """
  one:
    actions:
      sets: {x: 2, fast: true, y: top, z: "top / 4 + 1"}
      computed: {x: x + 1, y: "uniform(0, 1)", z: "of_each[robot]"}
      nothing: {}
    rules: [{otherwise: sets}]
  two:
    actions: {same: {z: "same[robot]", y: -0.5}}
    rules: [{otherwise: same}]
structure: [one, two]
"""
STATE = "state: {x: 0, y: 0, z: 0, fast: false}"
CONSTANTS = "constants: {top: 6, of_each: [1, 2], same: [3, 3]}\nenvironment:"


def test_what_is_the_same_for_all_robots_at_all_times_is_fixed():
    text = small(BEHAVIORS, robots=2).replace("state: {x: 0}", STATE).replace("environment:", CONSTANTS)
    fixed = fixed_values(meaning_of(text))
    assert fixed == ({"x": 2.0, "fast": True, "y": 6.0, "z": 2.5}, {}, {}, {"z": 3.0, "y": -0.5})
    assert [type(value) for value in fixed[0].values()] == [float, bool, float, float]
