"""Specs that extend others: merged level by level, with mistakes at their own places; no file from elsewhere."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from bbsd.architecture import designed_text, given_architecture
from bbsd.compiler import compile_meaning
from bbsd.errors import SpecError
from bbsd.language import lineage
from bbsd.language.lineage import MAX_FILES, overlay
from bbsd.language.loading import check, load
from bbsd.report.spec.configuration import configuration_text
from bbsd.text import Source, read
from bbsd.text.writing.patch import differences, replace_blocks
from tests.unit.language.specs import BASE


@pytest.fixture(autouse=True)
def _base(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    write("base.yaml", BASE)


def write(name, text):
    """Write a file into the folder of the test."""
    Path(name).write_text(text, encoding="utf-8")


def extending(text, base="base.yaml", name="spec.yaml"):
    write(name, f"extends: {base}\n{text}")
    return Source.read(name)


def reported(source):
    return [(diagnosis.code, diagnosis.place.file, diagnosis.place.line) for diagnosis in check(source)]


@pytest.mark.parametrize(
    ("base", "over", "expected"),
    [
        ({"a": 1}, {"a": 2}, {"a": 2}),
        ({"a": 1, "b": 2}, {"c": 3, "b": 4}, {"a": 1, "b": 4, "c": 3}),
        ({"a": {"b": 1, "c": 2}}, {"a": {"c": 3}}, {"a": {"b": 1, "c": 3}}),
        ({"a": [1, 2]}, {"a": [3]}, {"a": [3]}),
        ({"a": {"b": 1}}, {"a": 2}, {"a": 2}),
        ({"a": 1}, {"a": {"b": 2}}, {"a": {"b": 2}}),
        ({"a": 1, "b": 2}, {"a": None}, {"b": 2}),
        ({"a": 1}, {"b": None}, {"a": 1, "b": None}),
        ({"a": 1}, {"b": {"c": None}}, {"a": 1, "b": {"c": None}}),
        ({"a": {"b": 1}}, {"a": {}}, {"a": {"b": 1}}),
    ],
)
def test_mappings_merge_level_by_level_and_all_else_is_replaced(base, over, expected):
    assert json.dumps(overlay(base, over)) == json.dumps(expected)
    document = read(Source("base", json.dumps(base)))
    flat = replace_blocks(document, dict(differences(base, overlay(base, over))))
    assert read(Source("flat", flat)).data == expected


def test_a_spec_is_what_it_extends_with_its_own_changes():
    spec = load(extending("name: other\nenvironment: {steps: 20}\nconstants: {goal: 4}\n")).spec
    assert (spec.name, spec.environment.steps, spec.environment.robots) == ("other", 20, 3)
    assert [*spec.constants] == ["goal"]


def test_null_takes_away_and_opens_again():
    write("given.yaml", BASE + "structure: [stop]\n")
    assert load(extending("", "given.yaml")).spec.structure == ["stop"]
    assert load(extending("structure: null\n", "given.yaml")).spec.structure is None


def test_null_for_what_the_base_does_not_have_is_a_mistake_as_ever():
    assert reported(extending("structre: null\n")) == [("BB020", "spec.yaml", 2)]


def test_files_extend_each_other_in_a_chain():
    extending("environment: {steps: 20, robots: 2}\n", name="middle.yaml")
    found = load(extending("environment: {steps: 30}\n", "middle.yaml"))
    assert (found.spec.environment.steps, found.spec.environment.robots) == (30, 2)


def test_a_base_may_stand_in_a_folder_below(tmp_path):
    (tmp_path / "bases").mkdir()
    write("bases/base.yaml", BASE)
    extending("environment: {steps: 20}\n", "base.yaml", "bases/longer.yaml")
    assert load(extending("", "bases/longer.yaml")).spec.environment.steps == 20


def test_mistakes_are_told_in_the_file_that_makes_them():
    write("base.yaml", BASE.replace("speed: 0", "speed: sped", 1))
    source = extending("environment: {steps: many}\nreward:\n  near: heigt\n")
    assert sorted(reported(source)) == [
        ("BB022", "spec.yaml", 2),
        ("BB052", "base.yaml", BASE.split("\n").index("    speed: 0") + 1),
        ("BB052", "spec.yaml", 4),
    ]


def test_each_mistake_is_shown_with_the_line_of_its_file():
    write("base.yaml", BASE.replace("speed: 0", "speed: sped", 1))
    with pytest.raises(SpecError) as caught:
        load(extending("reward:\n  near: heigt\n"))
    lines = {diagnosis.place.file: caught.value.line(diagnosis.place) for diagnosis in caught.value.diagnoses}
    assert lines == {"base.yaml": "    speed: sped", "spec.yaml": "  near: heigt"}


def test_a_base_that_is_no_yaml_is_told_of_in_its_file():
    write("base.yaml", "bbsd: 1\nname: 'a\n")
    assert reported(extending("")) == [("BB004", "base.yaml", 2)]


def test_a_base_that_is_no_text_is_told_of(tmp_path):
    (tmp_path / "base.yaml").write_bytes(b"name: \xff")
    assert [each[:2] for each in reported(extending(""))] == [("BB003", "base.yaml")]


@pytest.mark.parametrize(
    ("written", "message"),
    [
        ("bas.yaml", 'there is no file "bas.yaml"; did you mean "base.yaml"?'),
        ("../base.yaml", "lies outside of the spec's folder"),
        ("inner/../../base.yaml", "lies outside"),
        ("/etc/passwd", "lies outside"),
        ("spec.yaml", "extends itself"),
        (".", "is not a file"),
        ("[base.yaml]", "not a list"),
        ("3", "not a number"),
        ("''", "not nothing"),
        ('"base\\0.yaml"', "cannot be read"),
        ("a" * 5000, "cannot be read"),
    ],
)
def test_what_cannot_be_extended_is_told_at_its_name(written, message):
    (found,) = check(extending("", written))
    assert (found.code, found.place.line, found.place.column) == ("BB029", 1, 10)
    assert message in found.message


def test_a_link_does_not_lead_out_of_the_folder(tmp_path, tmp_path_factory):
    outside = tmp_path_factory.mktemp("outside") / "base.yaml"
    outside.write_text(BASE, encoding="utf-8")
    (tmp_path / "link.yaml").symlink_to(outside)
    (tmp_path / "linked").symlink_to(outside.parent)
    for base in ("link.yaml", "linked/base.yaml"):
        assert reported(extending("", base)) == [("BB029", "spec.yaml", 1)]


def test_a_link_in_a_circle_is_told_of(tmp_path):
    (tmp_path / "link.yaml").symlink_to(tmp_path / "link.yaml")
    assert reported(extending("", "link.yaml")) == [("BB029", "spec.yaml", 1)]


def test_files_do_not_extend_each_other_in_a_circle():
    extending("", "spec.yaml", "middle.yaml")
    (found,) = check(extending("", "middle.yaml"))
    assert found.place.file == "middle.yaml"
    assert "in a circle" in found.message


def test_chains_are_bounded():
    for number in range(MAX_FILES):
        extending("", f"spec{number - 1}.yaml" if number else "base.yaml", f"spec{number}.yaml")
    assert reported(Source.read(f"spec{MAX_FILES - 2}.yaml")) == []
    assert [each[0] for each in reported(Source.read(f"spec{MAX_FILES - 1}.yaml"))] == ["BB029"]


def test_the_size_of_all_together_is_bounded(monkeypatch):
    monkeypatch.setattr(lineage, "MAX_CHARACTERS", len(BASE))
    assert reported(extending("")) == [("BB029", "spec.yaml", 1)]
    monkeypatch.setattr(lineage, "MAX_CHARACTERS", 10 * len(BASE))
    monkeypatch.setattr(lineage, "MAX_EXTENDED_NODES", 20)
    assert reported(extending("")) == [("BB011", "spec.yaml", 1)]


def test_the_flat_spec_says_the_same_and_keeps_the_comments_of_the_base():
    write("base.yaml", BASE.replace("  steps: 10", "  steps: 10  # of an episode"))
    found = load(extending("environment: {robots: 4}\nconstants: {goal: 3}\n"))
    flat = found.lineage.flat
    assert flat.data == found.data
    assert "steps: 10  # of an episode" in flat.source.text
    assert "extends" not in flat.source.text
    assert load(flat.source).spec == found.spec


def test_a_spec_without_a_base_is_its_own_flat_one():
    assert load(Source("spec.yaml", BASE)).lineage.flat.source.text == BASE


def test_the_configuration_names_the_file_of_each_value():
    text = configuration_text(load(extending("environment: {steps: 20}\n"), overrides=["name=set"]))
    lines = dict(line.split("#") for line in text.splitlines() if "#" in line)
    origins = {line.strip(): origin.strip() for line, origin in lines.items()}
    assert origins["steps: 20"] == "spec.yaml:2"
    assert origins["robots: 3"] == "base.yaml:5"
    assert origins["name: set"] == "--set"


def test_what_is_designed_is_flat():
    write("base.yaml", BASE.replace("steps: 10", "steps: 10  # of an episode"))
    rules = "behaviors: {stop: {rules: [otherwise: halt]}}\nstructure: [stop]\n"
    loaded = load(extending(rules))
    architecture = given_architecture(compile_meaning(loaded.meaning, compiled=False))
    text = designed_text(loaded, architecture)
    assert "extends" not in text
    assert "# of an episode" in text
    assert load(Source("written.yaml", text)).spec == loaded.spec


def test_extends_cannot_be_set():
    with pytest.raises(SpecError) as caught:
        load(Source("spec.yaml", BASE), overrides=["extends=base.yaml"])
    assert [diagnosis.code for diagnosis in caught.value.diagnoses] == ["BB028"]
