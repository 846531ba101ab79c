import pytest

from bbsd.language.loading import check
from bbsd.text import Source
from tests.unit.language.specs import BASE

SPEC = BASE.strip() + "\n"
FORMS = {
    "a negation at the start": ("tilted: tilt > 1", "tilted: !tilted_", ""),
    "a tag before brackets": ("tilted: tilt > 1", "tilted: !(tilt > 1)", "tilted: not (tilt > 1)"),
    "a question mark": (
        "1 if abs(height - 3) < 1 else 0",
        "height < 1 ? 1 : 0",
        "near: 1 if height < 1 else 0",
    ),
    "no blank": ("      halt:\n        speed: 0", "      halt:\n        speed:0", "speed: 0"),
    "no colon": ("  dynamics:", "  dynamics", "  dynamics:"),
    "a comment of C": ("  dynamics:", "  // what moves\n  dynamics:", "# what moves"),
    "a comma in braces": (
        "      halt:\n        speed: 0",
        "      halt: {speed: max(0, 1)}",
        'halt: {speed: "max(0, 1)"}',
    ),
    "a bracket": ("    inputs:\n      reached: height >= 3", "    inputs: [tilted", "inputs: [tilted]"),
    "tabs": ("    height: height + speed", "\theight: height + speed", "    height: height + speed"),
    "two tabs": ("      halt:\n        speed: 0", "\t\thalt:\n\t\t\tspeed: 0", "    speed: 0"),
}


@pytest.mark.parametrize(("right", "wrong", "line"), FORMS.values(), ids=FORMS)
def test_what_yaml_cannot_read_is_corrected(right: str, wrong: str, line: str) -> None:
    assert right in SPEC
    source = Source("spec.yaml", SPEC.replace(right, wrong))
    (diagnosis, *_) = check(source)
    assert diagnosis.correction is not None
    after = source.edited(diagnosis.correction.edits)
    assert line in after.text
    if line:
        assert check(after) == ()


def test_what_is_merged_is_written_out() -> None:
    action = "      halt: &halt {speed: 0}\n      stay:\n        <<: *halt"
    source = Source("spec.yaml", SPEC.replace("      halt:\n        speed: 0", action))
    (diagnosis,) = check(source)
    assert diagnosis.correction is not None
    after = source.edited(diagnosis.correction.edits)
    assert "      stay:\n        speed: 0" in after.text
    assert check(after) == ()


def test_a_second_document_is_told_once() -> None:
    (diagnosis,) = check(Source("spec.yaml", SPEC.replace("behaviors:", "---\nbehaviors:")))
    assert diagnosis.code == "BB015"


def test_a_correction_that_would_not_help_is_not_shown() -> None:
    source = Source("spec.yaml", SPEC.replace("inputs:\n", "inputs: [tilted\n"))
    assert all(each.correction is None for each in check(source))
