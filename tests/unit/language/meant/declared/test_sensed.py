"""What a sensor measures already, and what actions cannot set of the world."""

import pytest

from bbsd.language.loading import check
from tests.unit.language.specs import source

WORLD = """
environment:
  world: {wind: 0}
  dynamics: {wind: wind + 1}
  sensors: {windy: "%s"}
behaviors: {stop: {excited: "%s"}}
"""
SET = """
environment:
  world: {wind: 0}
  dynamics: {wind: wind + 1}
behaviors: {stop: {actions: {halt: %s}}}
"""


@pytest.mark.parametrize(
    ("sensor", "excited", "written"),
    [
        ("wind > 2", "wind > 2", "windy"),
        ("wind > 2", "tilted and wind>2", "windy"),
        ("wind", "wind > 3", "windy"),
        ("wind > 2", "wind > 3", None),
        ("wind + normal(0, 1) > 2", "wind + normal(0, 1) > 2", None),
    ],
)
def test_a_sensor_that_is_there_is_advised(sensor: str, excited: str, written: str | None) -> None:
    mistakes = [each for each in check(source(WORLD % (sensor, excited))) if each.code == "BB066"]
    assert len(mistakes) == 1
    correction = mistakes[0].correction
    assert (correction and correction.edits[0].text) == written
    assert ("windy senses that already" in mistakes[0].message) == (written is not None)


@pytest.mark.parametrize(
    ("sets", "left"),
    [("{speed: 0, wind: 0}", "speed: 0"), ("{wind: 0, speed: 0}", "speed: 0"), ("{wind: 0}", None)],
)
def test_an_action_that_sets_the_world(sets: str, left: str | None) -> None:
    (mistake,) = check(source(SET % sets))
    assert mistake.code == "BB033"
    assert "wind is a value of the world" in mistake.message
