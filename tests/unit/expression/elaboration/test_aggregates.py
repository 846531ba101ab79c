import pytest

from bbsd.expression.elaboration import elaboration
from bbsd.expression.elaboration.aggregates import MAX_ELEMENTS
from bbsd.expression.syntax.parsing import parse
from tests.unit.expression.scopes import marked, scope, valued


@pytest.mark.parametrize(
    ("text", "value"),
    [("sum(x[r] for r in team)", 3.5), ("mean(x[r] for r in team)", 3.5 / 3), ("min(x[r] for r in team)", -2.0),
     ("max(1, x, 3)", 3.0), ("any(ok[r] for r in team)", True), ("all(ok[r] for r in team)", False),
     ("any(x > 1, ok)", True), ("argmin(x[r] for r in team)", 1.0), ("argmax(x[r] for r in team)", 2.0),
     ("argmax(3, 5, 5)", 1.0), ("argmin(sonar)", 0.0), ("max(sonar)", 3.0), ("sum(a * b for a, b in table)", 14.0),
     ("sum(v for v in sonar)", 6.0), ("list(k * k for k in range(4))", [0.0, 1.0, 4.0, 9.0]),
     ("list(x, ok)", [1.5, True]),
     ("list()", []), ("sum(list(1, 2, 3))", 6.0), ("sum(sum(a * b for a in range(3)) for b in range(3))", 9.0),
     ("sum(x for x in team)", 3.0), ("list(x)", [1.5]), ("sum(1 for r in others)", 2.0)],
)  # fmt: skip
def test_values(text: str, value: object) -> None:
    assert valued(text) == value


def test_others_are_all_robots_but_this_one() -> None:
    assert [valued("list(r for r in others)", robot) for robot in range(3)] == [[1, 2], [0, 2], [0, 1]]
    assert valued("argmin(x[r] for r in others)", 1) == 0.0


def test_sums_go_from_left_to_right() -> None:
    assert valued("sum(v for v in list(0.1, 0.2, 0.3))") == 0.1 + 0.2 + 0.3


def test_a_bound_name_hides_and_is_forgotten_after() -> None:
    assert valued("sum(goal for goal in range(3)) + goal") == 6.0


@pytest.mark.parametrize(
    ("text", "code", "part"),
    [("max(x)", "BB056", "max(x)"), ("sum(list())", "BB056", "sum(list())"),
     ("sum(ok[r] for r in team)", "BB055", "ok[r]"),
     ("any(x[r] for r in team)", "BB055", "x[r]"), ("max(table)", "BB056", "table"),
     ("sum(v for v in x)", "BB062", "x"),
     ("sum(v for v, w in sonar)", "BB062", "(v for v, w in sonar)"), ("argmax(a for a, b in table)", "BB062",
     "argmax(a for a, b in table)"), ("sum((v for v in sonar), 1)", "BB062", "sum((v for v in sonar), 1)"),
     ("sum(1 for v in range(x))", "BB064", "x"), ("sum(1 for v in range(1, 2))", "BB054", "range(1, 2)"),
     ("sum(1 for v in range(10001))", "BB060", "range(10001)")],
)  # fmt: skip
def test_mistakes(text: str, code: str, part: str) -> None:
    assert marked(text) == [(code, part)]


def test_one_mistake_in_an_element_is_told_once() -> None:
    assert marked("sum(hight[r] for r in team)") == [("BB052", "hight")]


def test_for_the_team_there_are_no_others() -> None:
    assert marked("sum(1 for r in others)", None) == [("BB059", "others")]


def test_lists_of_lists_are_bounded_by_all_their_elements() -> None:
    rows = MAX_ELEMENTS // 100
    here = scope()
    elaboration.value(parse(f"list(list(0 for a in range(100)) for b in range({rows}))"), here)
    assert not here.findings.mistakes
    elaboration.value(parse(f"list(list(0 for a in range(100)) for b in range({rows + 1}))"), here)
    assert [mistake.code for _, mistake in here.findings.mistakes] == ["BB060"]
