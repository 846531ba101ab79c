"""Dashes of rules: too many, too few, and `otherwise` apart from its action."""

from __future__ import annotations

import pytest

from bbsd.language.fixing import fixed
from tests.unit.language.meant.docking import SPEC, corrected, made

RULES = "      - when: {contact: true}\n        do: halt\n      - otherwise: no action\n"
ONE = "      - when: {contact: true}\n        do: halt\n"
LAST = "      - otherwise: no action\n"


@pytest.mark.parametrize(
    "rules",
    [
        "      - when: {contact: true}\n      - do: halt\n" + LAST,
        ONE + "      - otherwise:\n        do: no action\n",
        ONE + "      - otherwise:\n      - do: no action\n",
        ONE + "      - otherwise\n      - do: no action\n",
        ONE + "      - otherwise\n        do: no action\n",
        ONE + "      - else:\n        do: no action\n",
        ONE + "      - when: otherwise\n        do: no action\n",
        ONE + "      - otherwise:\n          do: no action\n",
        ONE + "        otherwise: no action\n",
    ],
)
def test_a_rule_in_parts_is_told_once_and_joined(rules: str) -> None:
    source = made(RULES, rules)
    assert corrected(source) == SPEC
    assert fixed(source).source.text == SPEC


def test_a_missing_dash_is_told_once_and_written() -> None:
    second = "      - when: {contact: false}\n        do: mark\n"
    right = made(RULES, ONE + second)
    assert corrected(made(RULES, ONE + second.replace("- when", "  when"))) == right.text


def test_several_rules_are_joined_one_by_one() -> None:
    rules = "      - when: {contact: true}\n      - do: halt\n      - otherwise:\n      - do: no action\n"
    assert fixed(made(RULES, rules)).source.text == SPEC


def test_a_last_rule_without_when_is_probably_otherwise() -> None:
    source = made(RULES, ONE + "      - do: no action\n")
    assert corrected(source) == SPEC
    assert fixed(source).source == source
