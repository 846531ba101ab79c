"""Specs with one part in another form, and the whole as it is corrected."""

from __future__ import annotations

import pytest

from bbsd.language.fixing import fixed
from bbsd.language.loading import check
from bbsd.text import Source
from tests.unit.language.meant.docking import SPEC, corrected, made


def test_the_spec_has_no_mistake() -> None:
    assert check(Source("docking.yaml", SPEC)) == ()


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("    inputs: [contact]", "    inputs: contact"),
        ("    inputs: [contact]", "    inputs: [distance == 0]"),
        ("      - when: {contact: true}\n        do: halt", "      - contact: true\n        do: halt"),
        ("      - when: {contact: true}\n        do: halt", "      - contact: halt"),
        ("      - otherwise: no action", "        otherwise: no action"),
        (
            "      - when: {contact: true}\n        do: halt\n      - otherwise: no action",
            "      contact: halt\n      otherwise: no action",
        ),
        (
            "      - when: {contact: true}\n        do: halt",
            "      - if: {contact: true}\n        then: halt",
        ),
        ("        do: halt", "        do: {speed: 0}"),
        ("      halt:\n        speed: 0", "      halt:\n        - speed: 0"),
        ("      halt:\n        speed: 0", "      halt:\n        set speed 0"),
        ("        seen[0]: true", "        seen(0): true"),
        ("    mode: one of [near, away]", "    mode: [near, away]"),
        ("  steps: 100", "  steps: 0.1k"),
        ("  steps: 100", "  max_episode_steps: 100"),
        ("  dt: 0.1", "  dt = 0.1"),
        ("    speed: 0\n    seen", "     speed: 0\n    seen"),
        ("reward:\n  docked: 1 if", "reward: docked: 1 if"),
    ],
)
def test_what_has_one_reading_is_corrected_to_the_spec(old: str, new: str) -> None:
    source = made(old, new)
    assert corrected(source) == SPEC
    assert fixed(source).source.text == SPEC


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("  steps: 100", "  steps: 10 / dt"),
        ("structure: [drive]", "structure: [halt]"),
        ("        do: halt", "        do: [halt, mark]"),
        ("      - otherwise: no action", "      - otherwise: null"),
    ],
)
def test_what_is_probably_meant_is_shown_and_not_fixed(old: str, new: str) -> None:
    source = made(old, new)
    assert corrected(source) == SPEC
    assert fixed(source).source == source


@pytest.mark.parametrize(
    ("old", "new", "right"),
    [
        ("      halt:\n        speed: 0", "      halt: {speed = 0}", "      halt: {speed: 0}"),
        ("      halt:\n        speed: 0", "      halt: 0", "      halt: {speed: 0}"),
        (
            "    zone: cut(distance, 0.2, 1)",
            "    zone: {near: distance < 1, far: else}",
            "    zone: {near: distance < 1, far: otherwise}",
        ),
        (
            "    zone: cut(distance, 0.2, 1)",
            "    distance: cut(distance, 0.2, 1)",
            "    distance_is: cut(distance, 0.2, 1)",
        ),
        (
            "    distance: max(distance - speed * dt, 0)",
            "    seen[1]: true",
            "    seen: list(true if k == 1 else seen[k] for k in range(4))",
        ),
        (
            "  sensors:",
            "  definitions:\n    near: lambda a: a < 1\n  sensors:",
            "  definitions:\n    near(a): a < 1\n  sensors:",
        ),
        (
            "  sensors:",
            "  ends: distance == 0\n  sensors:",
            "  ends: all(distance[r] == 0 for r in team)\n  sensors:",
        ),
        ("reward:", "view:\n  at: {x: distance, y: 0}\nreward:", "view:\n  at: [distance, 0]\nreward:"),
        ("    mode: one of [near, away]", "    mode: near", None),
        ("reward:", "design:\n  seed: 3\nreward:", None),
    ],
)
def test_other_forms_are_told_once(old: str, new: str, right: str | None) -> None:
    source = made(old, new)
    if right is None:
        assert len(check(source)) == 1
    else:
        assert corrected(source) == SPEC.replace(old, right)
