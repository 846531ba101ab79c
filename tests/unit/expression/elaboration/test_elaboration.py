import math
from dataclasses import replace

import pytest

from bbsd.expression.elaboration import elaboration
from bbsd.expression.graph import needed
from bbsd.expression.kinds import Kind
from bbsd.expression.scope import Definition
from bbsd.expression.syntax.parsing import parse
from tests.unit.expression.scopes import marked, mistakes, scope, value_at, valued


@pytest.mark.parametrize(
    ("text", "value"),
    [("2 + 3 * 4", 14), ("7 // 2 + 7 % 4", 6), ("-7 // 2", -4), ("2 ** 3 ** 2", 512), ("2 ** -1", 0.5), ("+x", 1.5),
     ("x if ok else 0", 1.5), ("not ok", False), ("1 < x < 2", True), ("x > 2 or ok and x < 2", True),
     ("sqrt(16) + abs(-2) + hypot(3, 4)", 11), ("atan2(0, -1) == pi", True), ("goal", 3), ("table[1]", [3, 4]),
     ("true == ok", True), ("sign(-3) + round(2.5) + floor(2.9) + ceil(2.1)", 6),
     ("clip(7, 0, 5)", 5), ("clip(-7, 0, 5)", 0), ("clip(3, 0, 5)", 3), ("clip(3, 5, 4)", 4),
     ("wrap(3 * pi) == -pi", True), ("wrap(pi / 2)", 1.5707963267948966)],
)  # fmt: skip
def test_values(text: str, value: object) -> None:
    assert valued(text) == value


def test_what_cannot_be_computed_is_infinite_or_no_number() -> None:
    assert valued("1 / (x - x)") == math.inf
    assert math.isnan(valued("sqrt(-x)"))


@pytest.mark.parametrize(
    "text",
    ["10 ** 300 * 10 ** 300", "9 ** 9 ** 9", "-1 / 0", "0 / 0", "sqrt(-1)", "list(1 / i for i in range(3))"],
)
def test_what_is_certainly_infinite_or_no_number_is_a_mistake(text: str) -> None:
    here = scope()
    elaboration.value(parse(text), here)
    assert [mistake.code for _, mistake in here.findings.mistakes] == ["BB125"]


@pytest.mark.parametrize("text", ["min(1, 1 / 0)", "0 if true else 1 / 0", "x < 1 / 0", "1 / (1 / 0)"])
def test_what_is_infinite_on_the_way_is_none(text: str) -> None:
    here = scope()
    elaboration.value(parse(text), here)
    assert not here.findings.mistakes


@pytest.mark.parametrize(
    ("text", "code", "part"),
    [("x + ok", "BB055", "ok"), ("not x", "BB055", "x"), ("x and ok", "BB055", "x"), ("x == ok", "BB055", "x == ok"),
     ("ok < ok", "BB055", "ok < ok"), ("x if x else 1", "BB055", "x"), ("1 if ok else ok", "BB055", "1 if ok else ok"),
     ("sin(ok)", "BB055", "ok"), ("table + 1", "BB056", "table"), ("table == 1", "BB056", "table"),
     ("table if ok else 1", "BB056", "table"), ("sin(table)", "BB056", "table"), ("x ** x", "BB061", "x"),
     ("sin()", "BB054", "sin()"), ("sin(1, 2)", "BB054", "sin(1, 2)"), ("foo(x)", "BB053", "foo"),
     ("goal(1)", "BB053", "goal(1)"), ("cut(x, 1)", "BB053", "cut(x, 1)"), ("range(3)", "BB053", "range(3)"),
     ("uniform(0, 1)", "BB058", "uniform(0, 1)"), ("before(x)", "BB065", "before(x)"), ("sin(x for x in team)", "BB062",
     "sin(x for x in team)")],
)  # fmt: skip
def test_mistakes_are_told_once_where_they_are(text: str, code: str, part: str) -> None:
    assert marked(text) == [(code, part)]


def test_all_mistakes_of_an_expression_are_told_together() -> None:
    assert marked("(hight + ok) * foo(3) + sin(1, 2)") == [
        ("BB052", "hight"), ("BB055", "ok"), ("BB053", "foo"), ("BB054", "sin(1, 2)"),
    ]  # fmt: skip


def test_what_follows_from_a_mistake_is_not_told() -> None:
    assert [code for code, _ in marked("not (hight + 1) and max(hight, ok)[0] == 3")] == [
        "BB052",
        "BB052",
        "BB055",
    ]


def test_advice_for_the_mistakes_people_make() -> None:
    (mistake,) = mistakes("1 + (x > 2)")
    assert mistake.message == "a truth, where a number is needed"
    assert mistake.advice == "write the condition as: 1 if ... else 0"
    (mistake,) = mistakes("absolute(x)")
    assert 'unknown function "absolute"' in mistake.message


def test_a_power_needs_one_side_that_does_not_change() -> None:
    assert valued("x ** 2") == 2.25
    assert valued("2 ** k", robot=2) == 4
    assert valued("goal ** x", robot=1) == pytest.approx(1 / 9)


def test_kinds_are_demanded_by_the_entry_points() -> None:
    here = scope()
    assert elaboration.number(parse("x"), here).kind is Kind.NUMBER
    assert elaboration.truth(parse("ok"), here).kind is Kind.TRUTH
    assert elaboration.scalar(parse("ok"), here).kind is Kind.TRUTH
    assert not here.findings.mistakes
    for demand, text in ((elaboration.number, "ok"), (elaboration.truth, "x"), (elaboration.scalar, "table")):
        here = scope()
        assert demand(parse(text), here).kind is Kind.UNKNOWN
        assert len(here.findings.mistakes) == 1


def test_a_whole_number_for_the_whole_run() -> None:
    assert elaboration.static_whole(parse("goal + 1"), scope(), "it") == 4
    for text in ("x", "goal / 2"):
        here = scope()
        assert elaboration.static_whole(parse(text), here, "it") is None
        assert [mistake.code for _, mistake in here.findings.mistakes] == ["BB064"]


def words(text: str, robot: int = 0) -> list[object]:
    here = scope(robot, draws=True)
    elaboration.value(parse(text), here)
    assert not here.findings.mistakes
    return [node.data for node in here.graph.nodes.values() if node.operation == "draw"]


def test_each_occurrence_of_a_draw_is_another() -> None:
    assert len(words("uniform(0, 1) - uniform(0, 1)")) == 2


def test_each_robot_draws_for_itself() -> None:
    assert words("normal(0, 1)", robot=0) != words("normal(0, 1)", robot=1)


def test_each_element_draws_for_itself() -> None:
    assert len(words("list(list(uniform(0, 1) for a in range(3)) for b in range(4))")) == 12


def test_a_draw_is_named_by_its_place_alone() -> None:
    assert words("x + uniform(0, 1)") == words("goal * uniform(2, x)".replace("2, x", "0, 1"))


def test_draws_in_arms_of_a_conditional_are_both_made() -> None:
    here = scope(draws=True)
    found = elaboration.number(parse("uniform(0, 1) if chance(0.5) else normal(0, 1)"), here)
    drawn = [node.kind for node in needed([found]) if node.operation == "draw"]
    assert sorted(kind.value for kind in drawn) == ["a number", "a number", "a truth"]


def test_clip_is_the_same_nodes_as_min_and_max() -> None:
    here = scope()
    clipped = elaboration.value(parse("clip(x, -k, k)"), here)
    assert clipped is elaboration.value(parse("min(max(x, -k), k)"), here)


@pytest.mark.parametrize("name", ["clip", "sign"])
def test_a_definition_of_the_spec_s_own_stands_for_a_function_of_numbers(name: str) -> None:
    here = scope()
    own = Definition(("v",), parse("v + 1"), ("definitions", f"{name}(v)"))
    named = replace(here, names={**here.names, name: own})
    assert value_at(elaboration.number(parse(f"{name}(1)"), named)) == 2


def test_a_value_may_be_called_as_a_function_is() -> None:
    here = scope()
    lowest = Definition((), parse("floor(x)"), ("definitions", "floor"))
    named = replace(here, names={**here.names, "floor": lowest})
    assert value_at(elaboration.number(parse("floor + floor(2.5)"), named)) == 3
