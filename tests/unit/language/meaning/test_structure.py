import pytest

from bbsd.language.meaning.structure import OPEN_LAYER, Structure
from tests.unit.language.specs import codes, meaning_of

BEHAVIORS = (
    "behaviors: {a: {actions: {go: {}}}, b: {actions: {go: {}}}, c: {actions: {go: {}}}, stop: null}\n"
)


def structure(part: str) -> Structure:
    return meaning_of(BEHAVIORS + part).structure


def test_without_a_structure_all_layers_are_open() -> None:
    found = structure("")
    assert found.layers == (OPEN_LAYER,) * 3
    assert found.candidates == (0, 1, 2)
    assert found.is_open


def test_the_design_may_want_fewer_layers() -> None:
    assert structure("design: {layers: 2}").layers == (OPEN_LAYER,) * 2


def test_a_spec_lists_the_highest_layer_first_and_the_model_the_lowest() -> None:
    found = structure("structure: [c, a, b]")
    assert found.layers == (1, 0, 2)
    assert not found.is_open


def test_open_layers_are_for_behaviors_not_named() -> None:
    found = structure("structure: [open, b, open]")
    assert found.layers == (OPEN_LAYER, 1, OPEN_LAYER)
    assert found.candidates == (0, 2)


def test_a_behavior_may_be_left_out() -> None:
    found = structure("structure: [a]")
    assert found.layers == (0,)
    assert not found.is_open


def test_one_open_layer_for_one_behavior_is_no_choice() -> None:
    found = structure("structure: [a, open, c]")
    assert found.layers == (2, 1, 0)
    assert not found.is_open


@pytest.mark.parametrize(
    "part",
    ["structure: [a, a]", "structure: [a, d]", "structure: [open, open, open, open]", "structure: [a, b, c, open]",
     "structure: []", "design: {layers: 4}"],
)  # fmt: skip
def test_structures_that_cannot_be(part: str) -> None:
    assert codes(BEHAVIORS + part) == ["BB042"]
