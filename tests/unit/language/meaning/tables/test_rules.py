import pytest

from bbsd.expression.scope import Findings
from bbsd.language.meaning.tables.rules import table_of_rules
from bbsd.language.meaning.tables.table import OPEN_CELL, Table
from bbsd.language.models import Otherwise, Rule, When

INPUTS = {"near": ("false", "true"), "tilt": ("below 2", "2 to 5", "5 to 9", "from 9")}
ACTIONS = ("halt", "push")
FREE = OPEN_CELL


def when(do: str, **cells: object) -> When:
    return When.model_validate({"when": cells, "do": do})


def otherwise(do: str) -> Otherwise:
    return Otherwise.model_validate({"otherwise": do})


def given(*rules: Rule) -> list[int]:
    findings = Findings()
    found = table_of_rules(rules, INPUTS, ACTIONS, ("rules",), findings)
    assert not findings.mistakes
    return list(found.given)


def mistakes(*rules: Rule, unusable: tuple[str, ...] = ()) -> list[tuple[tuple[object, ...], str]]:
    findings = Findings()
    table_of_rules(rules, INPUTS, ACTIONS, ("rules",), findings, unusable)
    return [(path, mistake.code) for path, mistake in findings.mistakes]


def test_without_rules_all_cells_are_open() -> None:
    assert table_of_rules(None, INPUTS, ACTIONS, (), Findings()) == Table(bytes([FREE] * 8))
    assert given() == [FREE] * 8


def test_cells_are_in_row_major_order_of_the_inputs() -> None:
    assert given(when("halt", near="false", tilt="2 to 5"), when("push", near=True, tilt="from 9")) == [
        FREE, 1, FREE, FREE, FREE, FREE, FREE, 2,
    ]  # fmt: skip


def test_the_first_rule_that_matches_decides() -> None:
    assert given(when("halt", near=True), when("push", tilt="below 2"), otherwise("no action")) == [
        2, 0, 0, 0, 1, 1, 1, 1,
    ]  # fmt: skip


def test_an_input_not_named_matches_all_its_cells() -> None:
    assert given(when("push", tilt=["below 2", "from 9"])) == [2, FREE, FREE, 2, 2, FREE, FREE, 2]


def test_open_leaves_cells_open_against_later_rules() -> None:
    assert given(when("open", near=True), otherwise("halt")) == [1, 1, 1, 1, FREE, FREE, FREE, FREE]


@pytest.mark.parametrize(
    ("word", "cells"),
    [("below 5", (0, 1)), ("below 9", (0, 1, 2)), ("2 to 9", (1, 2)), ("from 5", (2, 3)), ("from 2", (1, 2, 3)),
     ("5 to 9", (2,))],
)  # fmt: skip
def test_a_rule_may_name_a_range_of_a_cuts_cells(word: str, cells: tuple[int, ...]) -> None:
    expected = [1 if cell in cells else FREE for cell in range(4)]
    assert given(when("halt", tilt=word)) == expected * 2


@pytest.mark.parametrize("word", ["below 3", "9 to 2", "5 to 5", "from", "2", "to 5"])
def test_what_is_no_range_is_told(word: str) -> None:
    assert mistakes(when("halt", tilt=["below 2", word])) == [(("rules", 0, "when", "tilt", 1), "BB035")]


def test_a_table_without_inputs_has_one_cell() -> None:
    assert table_of_rules([otherwise("push")], {}, ACTIONS, (), Findings()).given == bytes([2])


def test_mistakes_are_told_rule_by_rule() -> None:
    assert mistakes(
        when("stop", near="yes"), when("halt", far=True), otherwise("halt"), when("push", near=True)
    ) == [
        (("rules", 0, "do"), "BB036"),
        (("rules", 0, "when", "near", 0), "BB035"),
        (("rules", 1, "when", "far"), "BB034"),
        (("rules", 3), "BB037"),
    ]


def test_nothing_is_said_about_names_that_were_told_of_before() -> None:
    assert mistakes(when("Halt", near=True), when("halt", far=True), unusable=("Halt", "far")) == []


def test_a_table_knows_whether_anything_is_open() -> None:
    assert not Table(bytes([0, 1])).is_open
    assert Table(bytes([0, FREE])).is_open
