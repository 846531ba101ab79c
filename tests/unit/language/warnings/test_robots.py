from __future__ import annotations

import pytest

from bbsd.language.loading import check, load
from tests.unit.language.specs import source

SAME = "environment: {state: {height: 2, speed: 0}, dynamics: {height: HEIGHT}, world: {wind: 0}}"


def are_alike(part: str) -> bool:
    return "BB206" in {each.code for each in check(source(part), warnings=True)}


@pytest.mark.parametrize(
    "height",
    [
        "height + speed",
        "height + mean(speed[r] for r in others)",
        "'min(height[r] for r in team) + 1'",
        "height + wind",
    ],
)
def test_robots_that_start_alike_and_are_alike_stay_so(height: str) -> None:
    assert are_alike(SAME.replace("HEIGHT", f"'{height.strip(chr(39))}'"))


@pytest.mark.parametrize(
    "height",
    ["height + normal(0, 1)", "height + 0.1 * robot", "height[0] + robot", "height if robot == 0 else 0"],
)
def test_a_draw_or_the_robot_makes_them_differ(height: str) -> None:
    assert not are_alike(SAME.replace("HEIGHT", f"'{height}'"))


def test_a_start_or_a_sensor_makes_them_differ() -> None:
    same = SAME.replace("HEIGHT", "height + speed")
    assert not are_alike(same.replace("height: 2", "height: 'uniform(2, 3)'"))
    assert not are_alike(same.replace("height: 2", "height: 2 + robot"))
    assert not are_alike(f"{same}\nbehaviors: {{stop: {{inputs: {{first: robot == 0}}}}}}")
    assert not are_alike(f"{same}\nbehaviors: {{stop: {{excited: robot == 0}}}}")
    assert not are_alike(f"{same}\nbehaviors: {{stop: {{actions: {{halt: {{speed: robot}}}}}}}}")


def test_one_robot_is_not_compared() -> None:
    same = SAME.replace("HEIGHT", "height + speed").replace("{state", "{robots: 1, sensors: null, state")
    assert not are_alike(same)


@pytest.mark.parametrize(
    ("excited", "robots", "message"),
    [
        ("robot == 3", 3, "there is no robot 3: they count from 0, and robot is one of 0 to 2"),
        ("4 != robot", 3, "there is no robot 4: they count from 0, and robot is one of 0 to 2"),
        ("robot == 1", 1, "there is no robot 1: they count from 0, and robot is 0, the only one"),
        ("robot == 2", 3, None),
        ("robot < 3", 3, None),
    ],
)
def test_a_robot_that_is_not_there(excited: str, robots: int, message: str | None) -> None:
    part = f"environment: {{robots: {robots}}}\nbehaviors: {{stop: {{excited: {excited}}}}}"
    told = [each.message for each in load(source(part)).warnings if each.code in ("BB209", "BB211")]
    assert told == ([] if message is None else [message])
