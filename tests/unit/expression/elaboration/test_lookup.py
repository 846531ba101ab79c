import pytest

from bbsd.expression.elaboration import elaboration
from bbsd.expression.kinds import Kind
from bbsd.expression.syntax.parsing import parse
from tests.unit.expression.scopes import marked, mistakes, scope, valued


def test_a_name_is_the_robots_own() -> None:
    assert [valued("x", robot) for robot in range(3)] == [1.5, -2.0, 4.0]


def test_an_index_is_another_robot_or_an_element() -> None:
    assert valued("x[2]", 0) == 4.0
    assert valued("x[robot]", 1) == -2.0
    assert valued("sonar[3]", 2) == 23.0
    assert valued("table[1][0]") == 3.0


def test_a_computed_index_is_clamped_and_never_wraps() -> None:
    assert [valued("x[robot + 1]", robot) for robot in range(3)] == [-2.0, 4.0, 4.0]
    assert valued("x[robot - 5]", 1) == 1.5
    assert [valued("sonar[k * 3]", robot) for robot in range(3)] == [0.0, 13.0, 23.0]
    assert valued("table[k][1]", 2) == 4.0


def test_an_index_that_is_no_number_gives_the_first() -> None:
    assert valued("table[0 / 0]") == [1.0, 2.0]
    assert valued("x[1 / 0]", 0) == 4.0


def test_a_definition_is_what_it_stands_for() -> None:
    assert valued("twice(x) + double", 2) == 16.0
    assert valued("double[1]", 0) == -4.0


@pytest.mark.parametrize(
    ("text", "code", "part"),
    [("hight", "BB052", "hight"), ("sin + 1", "BB052", "sin"), ("team", "BB052", "team"), ("twice", "BB054", "twice"),
     ("twice(1, 2)", "BB054", "twice(1, 2)"), ("double(1)", "BB054", "double(1)"), ("early", "BB066", "early"),
     ("goal[0]", "BB057", "goal"), ("x[3]", "BB057", "3"), ("table[-1]", "BB057", "-1"), ("x[ok]", "BB055", "ok")],
)  # fmt: skip
def test_mistakes(text: str, code: str, part: str) -> None:
    assert marked(text) == [(code, part)]


def test_suggestions_come_from_the_names_in_scope() -> None:
    (mistake,) = mistakes("gaol")
    assert mistake.message == 'unknown name "gaol"; did you mean "goal"?'


def test_nothing_is_said_about_what_was_told_before() -> None:
    for text in ("hidden", "hidden(3)", "hidden[2]", "sum(v for v in hidden)", "x[hidden]", "hidden + 1"):
        assert mistakes(text) == []


def test_for_the_team_a_robots_value_needs_to_say_whose() -> None:
    assert valued("max(x[r] for r in team)", None) == 4.0
    assert valued("x[1]", None) == -2.0
    assert [code for code, _ in marked("x", None)] == ["BB059"]


def test_mistakes_in_a_definition_are_told_at_the_definition_once() -> None:
    here = scope()
    here.memo.clear()
    elaboration.value(parse("twice(ok) + twice(ok)"), here)
    assert [(path, mistake.code) for path, mistake in here.findings.mistakes] == [
        (("definitions", "twice(v)"), "BB055")
    ]


def test_rows_of_different_lengths_need_a_plain_number() -> None:
    text = "list(list(1, 2), list(3))"
    assert valued(f"{text}[1]") == [3.0]
    assert [code for code, _ in marked(f"{text}[k]")] == ["BB057"]
    assert [code for code, _ in marked("list(table, list(1, 2))[k]")] == ["BB057"]
    assert [code for code, _ in marked("list(list(1, 2), lost)[k]")] == ["BB052"]


def test_what_is_indexed_must_turn_out_whole() -> None:
    here = scope()
    found = elaboration.value(parse("table[k][x]"), here)
    assert getattr(found, "kind", None) is Kind.NUMBER
    assert [purpose for _, _, purpose, _ in here.findings.wholes] == ["an index"] * 2
