import pytest

from bbsd.language.loading import check
from tests.unit.language.specs import source


def corrected(part: str) -> str:
    """The text of a spec after the correction of its one mistake, as far as it differs."""
    text = source(part)
    (diagnosis,) = check(text)
    if diagnosis.correction is None:
        return ""
    before, after = text.text.splitlines(), text.edited(diagnosis.correction.edits).text.splitlines()
    assert check(text.edited(diagnosis.correction.edits)) == ()
    return "\n".join(line.strip() for line in after if line not in before)


@pytest.mark.parametrize(
    ("part", "line"),
    [
        ("environment:\n  ends: step >= 4 && step > 1", "ends: step >= 4 and step > 1"),
        ("environment: {ends: '! step >= 4'}", "ends: not step >= 4"),
        ("reward: {near: 'height > 2 ? 1 : 0'}", "near: 1 if height > 2 else 0"),
        ("reward:\n  near: pow(height, 2)", "near: height ** 2"),
        ("environment:\n  state:\n    height: random(2, 3)", "height: uniform(2, 3)"),
    ],
)
def test_a_correction_gives_a_spec_without_the_mistake(part: str, line: str) -> None:
    assert corrected(part).replace("'", "") == line


CELLS = "environment:\n  sensors:\n    place:\n      low: height < 1\n      high: height > 2\n"


def test_an_entry_that_is_lacking_is_added_behind_another() -> None:
    assert corrected(CELLS) == "neither: otherwise"


def test_a_name_in_use_is_not_added_again() -> None:
    assert corrected(CELLS + "      rest: height == 1.5\n") == "rest_2: otherwise"


def test_the_sensor_that_cuts_a_number_is_what_to_write_for_it() -> None:
    part = (
        "environment:\n  sensors:\n    band: cut(height, 2, 3)\nbehaviors:\n  stop:\n    inputs: [height]\n"
    )
    assert corrected(part) == "inputs: [band]"
