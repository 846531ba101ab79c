"""Keys that are given twice."""

from __future__ import annotations

from bbsd.language.fixing import fixed
from bbsd.language.loading import check
from bbsd.text import Source
from tests.unit.language.meant.docking import SPEC, corrected, made

DYNAMICS = "  dynamics:\n    distance: max(distance - speed * dt, 0)\n"
RIGHT = DYNAMICS + "    mode: near\n"
SENSORS = "    contact: distance == 0\n"


def test_two_blocks_of_one_key_are_joined() -> None:
    text = made(SENSORS, SENSORS + "  dynamics:\n    mode: near\n").text
    source = Source("docking.yaml", text)
    assert fixed(source).source.text == SPEC.replace(DYNAMICS, RIGHT)


def test_nothing_is_told_of_what_the_second_block_says() -> None:
    source = made("behaviors:\n", "  sensors:\n    close_by: distance < 1\nbehaviors:\n")
    text = source.text.replace("reward:\n", "reward:\n  close: 1 if all(close_by[r] for r in team) else 0\n")
    (mistake,) = check(Source("docking.yaml", text))
    assert mistake.code == "BB006"


def test_two_behaviors_of_one_name_are_only_proposed_as_one() -> None:
    source = made("structure: [drive]", "  drive:\n    excited: contact\nstructure: [drive]")
    assert "drive:\n    inputs: [contact]" in corrected(source)
    assert fixed(source).source == source


def test_a_value_that_is_given_twice_is_not_corrected() -> None:
    (mistake,) = check(made("    speed: 0\n    seen", "    speed: 0\n    speed: 1\n    seen"))
    assert mistake.correction is None
    assert mistake.advice == "keep one of the two, or give one another name"
