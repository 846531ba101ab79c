"""Terms of the reward that are always the same."""

import pytest

from bbsd.language.loading import load
from tests.unit.language.specs import source

PART = """
constants: {{top: 2, weight: 0}}
environment:
  state: {{seen: "list(false for i in range(4))", at: "integers(0, 3)"}}
  dynamics: {{height: "max(height + speed, 0)", seen: "list(seen[i] or i == at for i in range(4))", at: "(at + 1) % 4"}}
behaviors:
  stop:
    actions: {{halt: {{speed: 0}}, sink: {{speed: -1}}, push: {{speed: "clip(speed + 1, 0, top)"}}}}
reward: {{own: "{term}"}}
"""


def told(term: str) -> list[tuple[str, str | None]]:
    found = [each for each in load(source(PART.format(term=term))).warnings if each.code == "BB212"]
    return [(each.message, each.correction.edits[0].text if each.correction else None) for each in found]


@pytest.mark.parametrize(
    ("term", "message", "written"),
    [
        ("1 if height < 0 else 0", "own is always 0: height < 0 never holds: height is never below 0", "height <= 0"),
        ("1 if 0 > height else 0", "own is always 0: 0 > height never holds: height is never below 0", "0 >= height"),
        ("3 if speed > top else -1", "own is always -1: speed > top never holds", None),
        ("3 if speed > 2 else -1", "own is always -1: speed > 2 never holds: speed is never above 2", "speed >= 2"),
        ("1 if height < -1 else 0", "own is always 0: height < -1 never holds", None),
        ("2 if speed <= 2 else 0", "own is always 2: speed <= 2 always holds", None),
    ],
)  # fmt: skip
def test_a_condition_that_is_decided_by_bounds(term: str, message: str, written: str | None) -> None:
    (found,) = told(term)
    assert found == (message, written)


@pytest.mark.parametrize(
    "term",
    [
        "1 if height <= 0 else 0",
        "-1",
        "1 if top > 3 else 0",
        "height if speed < -2 else speed",
        "1 if seen[at] and not before(seen[at]) else 0",
        "weight if height > 1 else 0",
    ],
)
def test_terms_that_change_or_follow_from_constants_are_not_told(term: str) -> None:
    assert told(term) == []
