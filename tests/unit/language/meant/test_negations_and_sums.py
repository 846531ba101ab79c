"""Texts of which a part was once taken for another sign."""

from __future__ import annotations

import pytest

from bbsd.language.fixing import fixed
from bbsd.language.loading import check
from bbsd.text import Source
from tests.unit.language.meant.docking import corrected, made

HALT = "      halt:\n        speed: 0\n"


@pytest.mark.parametrize("value", ["speed - 0.2", "speed -0.2", "speed + 0.2"])
def test_a_sum_is_a_value_and_no_statement(value: str) -> None:
    source = made(HALT, f"      halt: {value}\n")
    right = f"      halt: {{speed: {value}}}\n"
    assert corrected(source) == made(HALT, right).text
    assert fixed(source).source == source


def test_a_statement_with_a_verb_sets_a_negative_number() -> None:
    assert fixed(made(HALT, "      halt: set speed -0.2\n")).source == made(
        HALT, "      halt: {speed: -0.2}\n"
    )


@pytest.mark.parametrize(
    ("old", "new", "advice"),
    [
        ("{contact: true}", "{contact: not true}", "write contact: false"),
        ("{contact: true}", "{zone: not below 0.2}", "write zone: [0.2 to 1, from 1]"),
    ],
)
def test_what_a_cell_is_not_are_the_other_cells(old: str, new: str, advice: str) -> None:
    source = made("    inputs: [contact]", "    inputs: [contact, zone]")
    mistakes = check(Source("docking.yaml", source.text.replace(old, new)))
    assert [(each.code, each.advice) for each in mistakes] == [("BB035", advice)]


def test_a_path_as_a_key_is_no_name() -> None:
    source = made("  drive:\n", "  drive.rules:\n    - otherwise: halt\n  drive:\n")
    (mistake,) = check(source)
    assert (mistake.code, mistake.advice) == ("BB024", "write drive: and, in the line below, rules:")
    assert fixed(source).source == source
