"""A misspelled behavior of a spec that extends another is told once, with the name that the base has."""

from pathlib import Path

from bbsd.language.fixing import fixed
from bbsd.language.loading import check, load
from bbsd.text import Source
from tests.unit.language.specs import source


def extending(folder: Path, text: str) -> Source:
    (folder / "base.yaml").write_text(source().text, encoding="utf-8")
    path = folder / "own.yaml"
    path.write_text(f"extends: base.yaml\n{text}", encoding="utf-8")
    return Source.read(path)


def test_a_misspelled_behavior(tmp_path: Path) -> None:
    own = extending(
        tmp_path, "behaviors:\n  stopp:\n    rules:\n      - when: {reached: true}\n        do: halt\n"
    )
    (mistake,) = check(own)
    assert mistake.code == "BB020"
    assert mistake.message == 'base.yaml has no behavior "stopp"; did you mean "stop"?'
    assert mistake.place.line == 3
    mended = fixed(own).source
    assert [*load(mended).spec.behaviors] == ["stop"]


def test_what_is_wrong_in_it_is_told_too(tmp_path: Path) -> None:
    own = extending(
        tmp_path, "behaviors:\n  stopp:\n    rules:\n      - when: {reached: true}\n        do: hold\n"
    )
    assert [(each.code, each.place.line) for each in check(own)] == [("BB020", 3), ("BB036", 6)]


def test_a_behavior_of_its_own_is_none_of_the_base(tmp_path: Path) -> None:
    own = extending(tmp_path, "behaviors:\n  stopp:\n    actions: {go: {speed: 1}}\n")
    assert check(own) == ()
    other = extending(tmp_path, "behaviors:\n  wander:\n    excited: tilted\n")
    assert [each.code for each in check(other)] == ["BB021"]
