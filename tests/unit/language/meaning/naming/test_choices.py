"""State and world that are one of several names, in small specs."""

import pytest

from bbsd.language.loading import check
from bbsd.language.meaning.naming.choices import choices_of
from bbsd.language.meaning.tables.labels import Numbers
from tests.unit.language.specs import codes, meaning_of, source

MODE = "environment: {state: {mode: 'one of [idle, search, home]%s', phase: 'one of [busy, idle]'}%s}\n%s"


def spec(starting: str = "", environment: str = "", rest: str = "") -> str:
    return MODE % (starting, environment, rest)


def test_names_are_known_with_the_lists_that_have_them() -> None:
    choices = choices_of(meaning_of(spec()).spec.environment)
    assert choices["idle"] == (("idle", "search", "home"), ("busy", "idle"))
    assert choices["home"] == (("idle", "search", "home"),)


@pytest.mark.parametrize(
    ("text", "cells"),
    [
        ("behaviors: {stop: {inputs: {reached: mode}}}", ("idle", "search", "home")),
        ("behaviors: {stop: {inputs: {reached: phase}, rules: []}}", ("busy", "idle")),
        ("behaviors: {stop: {inputs: {reached: home if tilted else mode}}}", ("idle", "search", "home")),
    ],
)
def test_a_value_with_names_is_a_complete_partition(text: str, cells: tuple[str, ...]) -> None:
    inputs = meaning_of(spec(rest=text)).episode.modules[0].inputs
    assert tuple(inputs["reached"]) == cells
    assert not isinstance(inputs["reached"], Numbers)


def test_what_has_names_is_told_by_name() -> None:
    environment = (
        ", world: {light: 'one of [red, green]'}, definitions: {now: mode, rest: home},"
        " sensors: {seen: light, all: 'list(mode[r] for r in team)'}"
    )
    episode = meaning_of(
        spec(environment=environment, rest="behaviors: {stop: {excited: speed > 0}}")
    ).episode
    modes = ("idle", "search", "home")
    assert {
        name: episode.labels(name) for name in ("mode", "light", "seen", "all", "now", "rest", "speed")
    } == {
        "mode": modes,
        "light": ("red", "green"),
        "seen": ("red", "green"),
        "all": modes,
        "now": modes,
        "rest": modes,
        "speed": (),
    }


@pytest.mark.parametrize(
    "starting", ["", " starting home", " starting at random", " starting home if robot == 0 else idle"]
)
def test_cells_that_name_all_values_cover_everything(starting: str) -> None:
    cells = "{a: mode == idle, b: mode == search, c: mode == home}"
    assert codes(spec(starting, f", sensors: {{place: {cells}, tilted: speed > 0}}")) == []
    cells = "{a: mode == idle, b: mode == home}"
    assert codes(spec(starting, f", sensors: {{place: {cells}, tilted: speed > 0}}")) == ["BB032"]


def test_a_state_that_starts_as_another_has_its_names() -> None:
    environment = ", dynamics: {last: before(mode)}"
    text = spec(environment=environment).replace("phase:", "last: mode, phase:")
    assert meaning_of(text).episode.labels("last") == ("idle", "search", "home")
    (diagnosis,) = check(source(text.replace("before(mode)", "idle if speed > 0 else busy")))
    assert diagnosis.code == "BB137"
    assert diagnosis.message == "last is idle, search or home, and this is busy or idle"


@pytest.mark.parametrize("name", ["height", "tilted", "near_by"])
def test_names_of_values_are_no_one_else_s(name: str) -> None:
    text = spec(environment=", definitions: {near_by: height < 1}").replace("search", name)
    assert codes(text) == ["BB025"]
