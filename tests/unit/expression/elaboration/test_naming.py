"""Values with names: two states with a name in common, one with others."""

from dataclasses import replace

import pytest

from bbsd.expression.elaboration import elaboration
from bbsd.expression.elaboration.naming import listed, one_reading
from bbsd.expression.graph import Level, evaluate
from bbsd.expression.kinds import Kind
from bbsd.expression.node_data import Slot
from bbsd.expression.scope import Definition, Named, PerRobot, Scope
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.tree import Span
from tests.unit.expression.scopes import scope

MODES = ("idle", "search", "home")
PHASES = ("busy", "idle")
LIGHTS = ("red", "green")
VALUES = {
    "mode": (1.0, 0.0, 2.0),
    "other": (1.0, 1.0, 0.0),
    "phase": (1.0, 0.0, 1.0),
    "light": (0.0, 1.0, 0.0),
}
STATES = {"mode": MODES, "other": MODES, "phase": PHASES, "light": LIGHTS}


def named_scope() -> Scope:
    here = scope()

    def state(name: str) -> PerRobot:
        def value(robot: int) -> Named:
            leaf = here.graph.leaf("slot", Slot(name, robot), Kind.NUMBER, Level.LANE)
            return Named(((STATES[name], leaf),))

        return PerRobot(value)

    own = {
        "rest": Definition((), parse("idle"), ("definitions", "rest")),
        "is_home(m)": Definition(("m",), parse("m == home"), ("definitions", "is_home(m)")),
    }
    own["is_home"] = own.pop("is_home(m)")
    choices = {
        "idle": (MODES, PHASES),
        "search": (MODES,),
        "home": (MODES,),
        "busy": (PHASES,),
        "red": (LIGHTS,),
        "green": (LIGHTS,),
    }
    names = {**here.names, **{name: state(name) for name in STATES}, **own}
    return replace(here, names=names, choices=choices)


def result(text: str) -> object:
    here = named_scope()
    value = elaboration.value(parse(text), here)
    assert not here.findings.mistakes, here.findings.mistakes
    assert not isinstance(value, tuple)
    node = value.node if isinstance(value, Named) else value

    def leaf(node: object, _: object) -> object:
        name, robot, _place = node.slot  # type: ignore[attr-defined]
        return VALUES[name][robot] if name in VALUES else {"ok": True, "x": 1.5, "k": 0.0}[name]

    number = evaluate([node], leaf)[0]
    return value.names[int(number)] if isinstance(value, Named) else number


@pytest.mark.parametrize(
    ("text", "value"),
    [
        ("mode", "search"),
        ("mode == search", True),
        ("mode != search", False),
        ("search == mode", True),
        ("phase == idle", True),
        ("mode == idle", False),
        ("mode == other", True),
        ("mode == other == search", True),
        ("home if ok else mode", "home"),
        ("(idle if ok else home) == mode", False),
        ("(idle if ok else idle) == phase", True),
        ("mode[2]", "home"),
        ("mode[k + 1]", "idle"),
        ("mode == rest", False),
        ("phase == rest", True),
        ("is_home(mode[2])", True),
        ("any(mode[r] == home for r in team)", True),
        ("all(m == mode for m in list(mode[r] for r in team))", False),
        ("list(mode, home)[k]", "search"),
        ("list(idle, mode)[k] == idle", True),
        ("sum(1 if mode[r] == search else 0 for r in team)", 1),
    ],
)
def test_values(text: str, value: object) -> None:
    assert result(text) == value


@pytest.mark.parametrize(
    ("text", "code", "part"),
    [
        ("mode == serach", "BB137", "serach"),
        ("mode == red", "BB137", "red"),
        ("mode == light", "BB139", "light"),
        ("mode == phase", "BB139", "phase"),
        ("mode == 1", "BB139", "1"),
        ("mode == ok", "BB139", "ok"),
        ("mode < search", "BB139", "mode < search"),
        ("idle == idle", "BB137", "idle"),
        ("mode + 1", "BB139", "mode"),
        ("not mode", "BB139", "mode"),
        ("max(mode[r] for r in team)", "BB139", "mode[r]"),
        ("argmin(x for m in list(mode, home))", "BB062", "argmin(x for m in list(mode, home))"),
        ("home if ok else 1", "BB139", "home if ok else 1"),
        ("mode if ok else light", "BB139", "mode if ok else light"),
        ("list(mode, light)[k]", "BB139", "k"),
        ("list(mode, 1)[k]", "BB139", "k"),
        ("mode == list(mode, home)", "BB056", "list(mode, home)"),
        ("one of [idle, search]", "BB136", "one of [idle, search]"),
        ("sleep", "BB052", "sleep"),
    ],
)
def test_mistakes_are_told_once_where_they_are(text: str, code: str, part: str) -> None:
    here = named_scope()
    elaboration.value(parse(text), here)
    found = [
        (mistake.code, text[mistake.span.start :][: mistake.span.length])
        for _, mistake in here.findings.mistakes
    ]
    assert found == [(code, part)]


def test_a_bare_name_of_several_states_is_one_reading_after_another() -> None:
    here = named_scope()
    value = elaboration.value(parse("idle"), here)
    assert isinstance(value, Named)
    assert [names for names, _ in value.readings] == [MODES, PHASES]
    assert one_reading(value, Span(0, 4), here) is here.graph.unknown
    assert [mistake.code for _, mistake in here.findings.mistakes] == ["BB137"]


def test_many_names_are_not_all_listed() -> None:
    assert listed(MODES) == "idle, search or home"
    assert listed(tuple("abcdefgh")) == "a, b, c, d, e, ... or h"
