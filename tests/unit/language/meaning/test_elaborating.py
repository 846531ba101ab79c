from bbsd.expression import graph, scope
from bbsd.language.meaning import elaborate
from bbsd.language.models import Spec
from bbsd.text import read
from tests.unit.language.specs import source


def test_nothing_is_said_about_broken_names() -> None:
    spec = Spec.model_validate(read(source("reward: {near: lost + sum(1 for v in lost), far: hight}")).data)
    meaning, mistakes = elaborate(spec, 0, frozenset({"lost"}))
    assert meaning is None
    assert [(path, mistake.code) for path, mistake in mistakes] == [(("reward", "far"), "BB052")]


def test_a_spec_that_unrolls_too_far_is_told_where(monkeypatch) -> None:
    monkeypatch.setattr(graph, "MAX_NODES", 1000)
    spec = Spec.model_validate(read(source("reward: {near: sum(height * k for k in range(2000))}")).data)
    meaning, mistakes = elaborate(spec, 0)
    assert meaning is None
    assert [(path, mistake.code) for path, mistake in mistakes] == [(("reward", "near"), "BB068")]


def test_after_very_many_mistakes_no_more_are_looked_for(monkeypatch) -> None:
    monkeypatch.setattr(scope, "MAX_MISTAKES", 3)
    reward = ", ".join(f"r{index}: unknown{index}" for index in range(9))
    spec = Spec.model_validate(read(source(f"reward: {{{reward}}}")).data)
    assert len(elaborate(spec, 0)[1]) == 3
