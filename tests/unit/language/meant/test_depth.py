"""Keys that are indented too little."""

from pathlib import Path

import pytest

from bbsd.language.fixing import fixed
from bbsd.language.loading import check
from bbsd.text import Source
from tests.unit.language.meant.docking import SPEC, corrected, made


def outdented(block: str) -> str:
    return "".join(f"{line.removeprefix('  ')}\n" for line in block.splitlines())


@pytest.mark.parametrize(
    "block",
    [
        "    rules:\n      - when: {contact: true}\n        do: halt\n      - otherwise: no action\n",
        "      mark:\n        seen[0]: true\n",
        "    contact: distance == 0\n",
        "    seen: list(false for k in range(4))\n",
    ],
)
def test_a_key_is_put_into_the_block_above(block: str) -> None:
    source = made(block, outdented(block))
    assert corrected(source) == SPEC
    assert fixed(source).source.text == SPEC


def test_a_behavior_at_the_top_level_is_put_among_the_behaviors() -> None:
    wait = "  wait:\n    excited: contact\n    actions:\n      rest: {speed: 0}\n"
    right = made("structure: [drive]", f"{wait}structure: [wait, drive]")
    assert corrected(made("structure: [drive]", f"{outdented(wait)}structure: [wait, drive]")) == right.text


def test_a_line_that_is_not_indented_as_those_below_it_is_told_itself() -> None:
    source = made("    inputs: [contact]\n", "  inputs: [contact]\n")
    assert corrected(source) == SPEC


def test_in_an_extending_spec_the_block_above_is_that_of_its_own_file(tmp_path: Path) -> None:
    base = made("structure: [drive]", "  wait:\n    excited: contact\n    actions:\n      rest: {speed: 0}")
    (tmp_path / "docking.yaml").write_text(base.text, encoding="utf-8")
    text = (
        "extends: docking.yaml\nbehaviors:\n  drive:\n    excited: contact\n  rules:\n    - otherwise: halt\n"
    )
    (mistake,) = check(Source(str(tmp_path / "own.yaml"), text))
    assert mistake.message.endswith("and belongs to drive")
