from __future__ import annotations

from math import inf, pi

import pytest

from bbsd.expression.node_data import Slot
from bbsd.language.warnings.bounds import Bounds
from tests.unit.language.specs import meaning_of

ACTIONS = "halt: {speed: 0}, push: {speed: 'clip(speed + 1, 0, top)'}"
MOVING = f"constants: {{top: 2}}\nbehaviors: {{stop: {{actions: {{{ACTIONS}}}}}}}"


def bounds_of(expression: str, more: str = "") -> tuple[float, float]:
    """Return the bounds of a definition after a step, for the first robot; speed stays from 0 to 2."""
    part = f"{MOVING}\nenvironment: {{definitions: {{value: '{expression}'}}{more}}}"
    meaning = meaning_of(part)
    return Bounds(meaning).of(meaning.episode.definitions[Slot("value", 0)])


@pytest.mark.parametrize(
    ("expression", "expected"),
    [
        ("speed", (0, 2)),
        ("speed + 1", (1, 3)),
        ("1 - 2 * speed", (-3, 1)),
        ("height", (2, inf)),
        ("abs(speed - 1)", (0, 1)),
        ("(speed - 2) ** 2", (0, 4)),
        ("(speed - 2) ** 3", (-8, 0)),
        ("6 / (speed + 1)", (2, 6)),
        ("6 / speed", (-inf, inf)),
        ("height % 4", (0, 4)),
        ("height % speed", (-inf, inf)),
        ("(speed + 1) // 2", (0, 1)),
        ("sqrt(speed + 2)", (2**0.5, 2)),
        ("sin(height)", (-1, 1)),
        ("atan2(height, speed)", (-pi, pi)),
        ("max(speed, 1) + min(speed, 1)", (1, 3)),
        ("step", (1, 10)),
        ("1 if speed > 2 else 5", (5, 5)),
        ("1 if speed >= 2 else 5", (1, 5)),
        ("top", (2, 2)),
        ("round(speed / 3)", (0, 1)),
    ],
)
def test_bounds_follow_from_how_a_value_is_computed(expression: str, expected: tuple[float, float]) -> None:
    assert bounds_of(expression) == expected


def test_a_value_that_grows_is_unlimited_in_that_direction_alone() -> None:
    state = ", state: {height: 0, speed: 0, way: 0}, dynamics: {way: way + abs(speed)}"
    assert bounds_of("way", state) == (0, inf)


def test_a_value_that_turns_round_is_limited() -> None:
    state = ", state: {height: 0, speed: 0, turn: 0}, dynamics: {turn: '(turn + speed) % 4'}"
    assert bounds_of("turn", state) == (0, 4)


def test_what_is_drawn_for_the_constants_is_not_known() -> None:
    part = "constants: {goal: 'uniform(1, 2)', next: goal + 1}\nenvironment: {definitions: {value: next}}"
    meaning = meaning_of(part)
    assert Bounds(meaning).of(meaning.episode.definitions[Slot("value", 0)]) == (-inf, inf)


def test_what_follows_from_constants_alone_counts_as_a_switch() -> None:
    assert bounds_of("1 if top > 1 else 0") == (0, 1)
    assert bounds_of("1 if 2 > 1 else 0") == (1, 1)
