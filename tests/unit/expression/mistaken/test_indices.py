"""Indices by a step of what is one value: it is no series, and its value before is before(...)."""

import pytest

from bbsd.language.loading import check
from tests.unit.language.specs import source

SERIES = "height is one value, no series over the steps"
PARTS = {
    "reward": "reward: {{more: '{0}'}}",
    "excited": "behaviors: {{stop: {{excited: '{0} > 2'}}}}",
    "expects": "behaviors: {{stop: {{expects: '{0} > 2'}}}}",
    "sensor": "environment: {{sensors: {{more: '{0}'}}}}",
    "dynamics": "environment: {{dynamics: {{height: '{0} + speed'}}}}",
}


def told(place: str, expression: str, robots: int) -> list[tuple[str, str | None]]:
    part = PARTS[place].format(expression)
    if robots == 1:
        part = (
            part.replace("environment: {", "environment: {robots: 1, ")
            if "environment" in part
            else (f"environment: {{robots: 1}}\n{part}")
        )
    found = check(source(part))
    return [(each.message, each.correction.edits[0].text if each.correction else None) for each in found]


@pytest.mark.parametrize("robots", [1, 3])
@pytest.mark.parametrize(
    ("place", "expression", "written"),
    [
        ("reward", "height[step - 1]", "before(height)"),
        ("reward", "height[t - 1]", "before(height)"),
        ("reward", "height[step]", "height"),
        ("reward", "height[step - 2]", None),
        ("expects", "height[step - 1]", "before(height)"),
        ("sensor", "height[step - 1]", "before(height)"),
        ("dynamics", "height[step - 1]", "height"),
        ("excited", "height[step]", "height"),
        ("excited", "height[step - 1]", None),
    ],
)
def test_a_value_at_a_step(place: str, expression: str, written: str | None, robots: int) -> None:
    assert told(place, expression, robots) == [(SERIES, written)]


def test_what_one_robot_has_is_not_another_robots() -> None:
    assert told("excited", "height[0]", 1) == [
        ("height is one value, and no list: there is one robot", "height")
    ]
    assert told("reward", "height[-1]", 1) == [(SERIES, "before(height)")]


@pytest.mark.parametrize(
    "expression", ["height[step % robots]", "height[robot]", "max(height[t - 1] for t in team)"]
)
def test_a_robot_may_be_told_by_the_step(expression: str) -> None:
    assert told("reward", expression, 3) == []
