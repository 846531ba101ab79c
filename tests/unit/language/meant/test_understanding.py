"""Forms that newcomers write: each is told once, with its correction, and all else is read as it is meant."""

import pytest

from bbsd.language.loading import check
from bbsd.text import Source
from tests.unit.language.specs import BASE

RULES = "    rules:\n      - when: {reached: true}\n        do: halt\n      - otherwise: no action\n"
SPEC = (
    BASE.strip().replace("        speed: 0\nreward", f"        speed: 0\n{RULES}reward")
    + "\nstructure: [stop]\n"
)

FORMS = {
    "children beside their block": (
        "    height: uniform(2, 3)\n    speed: 0\n",
        "  height: uniform(2, 3)\n  speed: 0\n",
    ),
    "a block in its neighbor": (
        "  sensors:\n    tilt: height - mean(height[r] for r in team)\n    tilted: tilt > 1\n",
        "    sensors:\n      tilt: height - mean(height[r] for r in team)\n      tilted: tilt > 1\n",
    ),
    "rules among actions": (RULES, "".join(f"  {line}\n" for line in RULES.splitlines())),
    "a singular": ("behaviors:", "behavior:"),
    "another tool's word": ("        do: halt", "        then: halt"),
    "inputs by another name": ("    inputs:", "    sensors:"),
    "rules without dashes": (
        RULES,
        "    rules:\n      when: {reached: true}\n      do: halt\n      otherwise: no action\n",
    ),
    "when as an expression": ("when: {reached: true}", "when: reached == true"),
    "when as a bare truth": ("when: {reached: true}", "when: reached"),
    "a structure of numbers": ("structure: [stop]", "structure:\n  1: stop"),
    "a structure without brackets": ("structure: [stop]", "structure: stop"),
    "a name with a blank": ("stop", "stop it"),
    "a name with capitals": ("halt", "haltNow"),
    "a statement": (
        "  near: 1 if abs(height - 3) < 1 else 0",
        "  near:\n    if abs(height - 3) < 1: 1\n    else: 0",
    ),
    "one reward": ("reward:\n  near: ", "reward: "),
    "behaviors as a list": (
        "  stop:\n    inputs:",
        "  - name: stop\n    inputs:",
    ),
    "a list of terms": ("  near: ", "  - near: "),
}


@pytest.mark.parametrize(("right", "wrong"), FORMS.values(), ids=FORMS)
def test_a_form_is_told_once_and_its_correction_is_right(right: str, wrong: str) -> None:
    assert right in SPEC
    source = Source("spec.yaml", SPEC.replace(right, wrong))
    (diagnosis,) = check(source)
    assert diagnosis.correction is not None
    assert diagnosis.correction.is_certain
    assert check(source.edited(diagnosis.correction.edits)) == ()


PERHAPS = {
    "an action without a name": ("      halt:\n        speed: 0\n", "      speed: 0\n"),
    "a derivative": ("    height: height + speed", "    dheight/dt: speed"),
    "robots by their names": ("robots: 3", "robots: [a, b, c]"),
}


@pytest.mark.parametrize(("right", "wrong"), PERHAPS.values(), ids=PERHAPS)
def test_what_is_not_certain_is_told_once_and_proposed(right: str, wrong: str) -> None:
    text = BASE.strip() + "\n"
    assert right in text
    (diagnosis,) = check(Source("spec.yaml", text.replace(right, wrong)))
    assert diagnosis.correction is not None
    assert not diagnosis.correction.is_certain


def test_the_rest_of_a_spec_is_checked_as_it_is_meant() -> None:
    text = SPEC.replace("behaviors:", "behavior:").replace("reached: height >= 3", "reached: hight >= 3")
    assert [(each.code, each.place.line) for each in check(Source("spec.yaml", text))] == [
        ("BB020", 14),
        ("BB052", 17),
    ]
