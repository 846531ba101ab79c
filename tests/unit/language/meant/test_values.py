"""Numbers that are too large for what they mean are told as mistakes like others."""

import pytest

import bbsd
from tests.unit.architecture.designs import shipped


@pytest.mark.parametrize(
    "steps",
    ["1e308 * 10", "1e400 / dt", "1e999 s", "9" * 400 + " seconds", "round(1e308 * 10)", "1e308 * 10 * 0"],
)
def test_a_count_that_is_no_number_is_a_mistake(steps):
    text = shipped("object_lifting")
    text = text.replace("steps: 300", f"steps: {steps}")
    (told,) = [each for each in bbsd.check(text) if each.code == "BB022"]
    assert told.message.startswith("steps must be a whole number")
    assert not told.correction
