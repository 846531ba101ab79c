"""How warnings are told: after mistakes, where they are written, not too many, and only when they are asked for."""

from __future__ import annotations

import pickle
from typing import TYPE_CHECKING

import pytest

import bbsd
from bbsd.errors import Severity, SpecError
from bbsd.expression.scope import Findings
from bbsd.language.loading import MAX_DIAGNOSES, check, load, loaded_again
from bbsd.language.warnings import finding
from bbsd.text import Source
from tests.unit.language.specs import source

if TYPE_CHECKING:
    from pathlib import Path

UNUSED = "constants: {goal: 3}"


def codes(text: Source) -> list[str]:
    return [each.code for each in check(text, warnings=True)]


def test_a_spec_with_warnings_is_used_and_has_them() -> None:
    loaded = load(source(UNUSED))
    assert "nothing uses the constant goal" in [each.message for each in loaded.warnings]
    assert check(source(UNUSED)) == ()


def test_they_are_in_the_order_of_the_text() -> None:
    places = [each.place for each in load(source(UNUSED)).warnings]
    assert len(places) > 1
    assert places == sorted(places)


def test_a_mistake_brings_no_warning_that_only_follows_from_it() -> None:
    wrong = source("constants: {goal: 3}\nreward: {near: 1 if height > gaol else 0}")
    assert codes(wrong) == ["BB052"]


def test_warnings_of_single_expressions_stand_after_the_mistakes(monkeypatch: pytest.MonkeyPatch) -> None:
    report = Findings.report

    def report_and_warn(self: Findings, path: object, *rest: object) -> None:
        self.warn(("environment", "steps"), "BB201", "made up")
        report(self, path, *rest)  # type: ignore[arg-type]

    monkeypatch.setattr(Findings, "report", report_and_warn)
    with pytest.raises(SpecError) as caught:
        load(source("reward: {near: hight}"))
    assert [each.code for each in caught.value.diagnoses] == ["BB052", "BB201"]
    assert [each.code for each in caught.value.mistakes] == ["BB052"]


def test_only_so_many_are_shown() -> None:
    many = ", ".join(f"c{number}: 1" for number in range(MAX_DIAGNOSES + 5))
    warnings = load(source(f"constants: {{{many}}}")).warnings
    assert len(warnings) == MAX_DIAGNOSES
    assert "more warnings are not shown" in warnings[-1].advice


def test_of_what_is_extended_only_its_own_file_is_told(tmp_path: Path) -> None:
    base, over = tmp_path / "base.yaml", tmp_path / "over.yaml"
    base.write_text(source("constants: {goal: 3}").text)
    over.write_text("extends: base.yaml\nconstants: {other: 3}\n")
    files = {each.place.file for each in load(Source.read(over)).warnings}
    assert files == {str(over)}
    assert [each.message for each in bbsd.check(over)] == ["nothing uses the constant other"]


def test_they_are_those_of_the_spec_without_overrides() -> None:
    loaded = load(source(UNUSED), overrides=["environment.state.height=2"])
    assert loaded.warnings == load(source(UNUSED)).warnings
    mended = load(source("reward: {near: hight}"), overrides=["reward.near=height"])
    assert mended.warnings == ()
    again = loaded_again(load(source(UNUSED)), overrides=["environment.steps=7"])
    assert "nothing uses the constant goal" in [each.message for each in again.warnings]


def test_they_are_looked_for_once_and_only_when_asked_for(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []
    monkeypatch.setattr(finding, "warnings_of", lambda meaning: asked.append(meaning) or iter(()))
    loaded = load(source())
    assert asked == []
    assert loaded.warnings == loaded.warnings == ()
    assert len(asked) == 1


def test_a_loaded_spec_goes_to_other_processes_with_and_without_them() -> None:
    loaded = load(source(UNUSED))
    messages = [each.message for each in loaded.warnings]
    assert [each.message for each in pickle.loads(pickle.dumps(loaded)).warnings] == messages
    assert [each.message for each in pickle.loads(pickle.dumps(load(source(UNUSED)))).warnings] == messages


def test_in_python_check_has_mistakes_and_warnings(tmp_path: Path) -> None:
    path = tmp_path / "spec.yaml"
    path.write_text(source(UNUSED).text)
    assert {each.severity for each in bbsd.check(path)} == {Severity.WARNING}
    path.write_text(source("reward: {near: hight}").text)
    assert {each.severity for each in bbsd.check(path)} == {Severity.MISTAKE}
