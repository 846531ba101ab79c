from __future__ import annotations

import json
import shutil
from pathlib import Path

import pytest

from bbsd.cli.writing.new import Template, template_text
from bbsd.language.loading import load
from bbsd.report.reference.schema import SCHEMA_FILE, language_schema
from bbsd.text import Source
from tests.unit.cli.commands import run


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("template", Template)
def test_a_new_spec_is_the_template_with_its_own_name(template, capsys):
    assert run("new", "my_robot", "--template", template) == 0
    expected = template_text(template).replace(f"name: {template.replace('_', '-')}\n", "name: my_robot\n")
    assert Path("my_robot.yaml").read_text(encoding="utf-8") == expected
    assert load(Source.read("my_robot.yaml")).spec.name == "my_robot"
    assert capsys.readouterr() == ("", "wrote my_robot.yaml; next: bbsd design my_robot.yaml\n")


def test_the_schema_is_put_beside_it_and_not_overwritten():
    run("new", "first")
    schema = Path(SCHEMA_FILE)
    assert json.loads(schema.read_text(encoding="utf-8")) == language_schema()
    schema.write_text("mine", encoding="utf-8")
    run("new", "second")
    assert schema.read_text(encoding="utf-8") == "mine"


def test_nothing_is_overwritten(capsys):
    Path("mine.yaml").write_text("mine", encoding="utf-8")
    assert run("new", "mine") == 2
    assert Path("mine.yaml").read_text(encoding="utf-8") == "mine"
    assert "mine.yaml already exists" in capsys.readouterr().err


@pytest.mark.parametrize("name", ["no", "a: b", "1", "x" * 120])
def test_any_name_is_written_so_that_it_is_read_as_text(name):
    assert run("new", name) == 0
    assert load(Source.read(f"{name}.yaml")).spec.name == name[:100]


def test_the_suffix_may_be_given():
    run("new", "a.yml")
    assert Path("a.yml").exists()


def test_the_templates_are_listed_with_what_they_are(capsys):
    assert run("new", "--list") == 0
    lines = capsys.readouterr().out.splitlines()
    assert [line.split()[0] for line in lines] == list(Template)
    assert all(line.endswith(".") for line in lines)


@pytest.mark.parametrize("words", [["new"], ["new", "nowhere/a"], ["new", "a", "--template", "none"]])
def test_a_file_that_cannot_be_written_is_reported(words, capsys):
    assert run(*words) == 2
    assert capsys.readouterr().err
    assert not list(Path().iterdir())


@pytest.mark.parametrize("template", Template)
def test_a_template_leaves_how_it_is_designed_to_the_default_method(template):
    assert "design" not in load(Source(template, template_text(template))).data


GOOD = {Template.MINIMAL: 74, Template.TWO_ROBOTS: -13.6, Template.ANSWERS: 1}
"""What a first design of a template earns: of `answers` the most that can be earned."""


@pytest.mark.slow
@pytest.mark.parametrize("template", Template)
def test_a_first_design_of_a_template_is_good(template, capsys):
    run("new", "robot", "--template", template)
    capsys.readouterr()
    assert run("design", "robot.yaml", "--json", "--quiet") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["seconds"] < 60
    assert found["return"]["mean"] >= GOOD[template]
    assert found["return"]["ci95"][0] > found["random"]["ci95"][1]
    shutil.rmtree("runs")
