"""Keys that are indented too little."""

from __future__ import annotations

import pytest

from bbsd.language.fixing import fixed
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
