"""The structure as numbers and as one text."""

from __future__ import annotations

import pytest

from bbsd.language.fixing import fixed
from bbsd.language.loading import check
from bbsd.text import Source
from tests.unit.language.meant.docking import corrected, made

SPEC_OF_TWO = made(
    "structure: [drive]",
    "  wait:\n    excited: contact\n    actions:\n      rest: {speed: 0}\nstructure: [wait, drive]",
)


def written(structure: str) -> Source:
    return Source("docking.yaml", SPEC_OF_TWO.text.replace("structure: [wait, drive]", structure))


@pytest.mark.parametrize(
    "structure",
    [
        "structure: {wait: 2, drive: 1}",
        "structure: {drive: 1, wait: 2}",
        "structure:\n  wait: 20\n  drive: 10",
        "structure:\n  - drive: 1\n  - wait: 2",
        "structure: {2: wait, 1: drive}",
        "structure: wait -> drive",
    ],
)
def test_the_order_of_numbers_is_never_certain(structure: str) -> None:
    source = written(structure)
    assert corrected(source) == SPEC_OF_TWO.text
    assert fixed(source).source == source


def test_both_readings_of_numbers_are_told() -> None:
    (mistake,) = check(written("structure: {wait: 1, drive: 2}"))
    assert "if 1 is, write structure: [wait, drive]" in mistake.advice


@pytest.mark.parametrize(
    "structure", ["structure: wait, drive", "structure: wait > drive", "structure: wait drive"]
)
def test_a_text_is_in_the_order_of_the_list(structure: str) -> None:
    assert fixed(written(structure)).source.text == SPEC_OF_TWO.text


def test_no_open_layer_is_lost() -> None:
    open_ones = SPEC_OF_TWO.text.replace("[wait, drive]", "[open, open]")
    assert corrected(written("structure: {1: open, 2: open}")) == open_ones


def test_how_many_layers_are_open_is_not_certain() -> None:
    source = written("structure: open")
    assert fixed(source).source == source
