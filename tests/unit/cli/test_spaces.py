import json

import pytest

from bbsd.language.loading import load
from bbsd.text import Source, read
from tests.unit.cli.commands import run
from tests.unit.environments.arenas import ALLOWED, HERE

ACCESS = ("--allow-import", "tests", "--import-from", *ALLOWED.folders)
REST = """
bbsd: 1
name: pasted
behaviors: {b: {actions: {go: {command: 1}}}}
reward: {earned: earned}
"""


def test_what_is_printed_can_be_pasted(capsys):
    assert run("spaces", "--python", f"{HERE}:Duet", *ACCESS) == 0
    printed = capsys.readouterr().out
    assert f"# {HERE}:Duet" in printed
    assert "# agents: left right" in printed
    assert "  action: command                   # a whole number from 0 to 2\n" in printed
    assert load(Source("pasted.yaml", printed + REST)).spec.environment.robots == 2


def test_it_is_there_for_programs_too(capsys):
    assert run("spaces", "--python", f"{HERE}:Line", "--json", *ACCESS) == 0
    found = json.loads(capsys.readouterr().out)
    assert found["observation"] == "Box(-inf, inf, (2,), float64)"
    assert found["mistakes"] == []
    proposal = read(Source("proposal", found["proposal"])).data
    assert proposal["environment"]["observation"] == ["value_1", "value_2"]


def test_where_a_spec_does_not_fit_it_is_told_below(tmp_path, capsys):
    spec = tmp_path / "spec.yaml"
    text = f"environment: {{python: '{HERE}:Line', steps: 3, observation: [a], action: command, state: {{command: 0}}}}"
    spec.write_text(text + REST, encoding="utf-8")
    assert run("spaces", spec, *ACCESS) == 2
    printed = capsys.readouterr()
    assert "value_2" in printed.out
    assert "spec.yaml:1:" in printed.err
    assert "error[BB113]" in printed.err
    assert run("spaces", spec, "--json", *ACCESS) == 2
    assert [each["code"] for each in json.loads(capsys.readouterr().out)["mistakes"]] == ["BB113"]


@pytest.mark.parametrize(
    "words", [(), ("spec.yaml", "--gymnasium", "CartPole-v1"), ("--gymnasium", "A-v1", "--python", "a:B")]
)
def test_exactly_one_environment_is_looked_at(words, capsys):
    assert run("spaces", *words) == 2
    assert "give SPEC, or one of --gymnasium" in " ".join(capsys.readouterr().err.split())


def test_the_file_of_a_module_is_shown_before_it_is_imported(tmp_path, capsys):
    (tmp_path / "shown_module.py").write_text("raise ValueError('not today')\n", encoding="utf-8")
    words = ("--allow-import", "shown_module", "--import-from", tmp_path)
    assert run("spaces", "--python", "shown_module:Arena", *words) == 2
    first, second, *_ = capsys.readouterr().err.splitlines()
    assert first == f"importing shown_module from {tmp_path}/shown_module.py"
    assert second == "bbsd: the import of shown_module raised ValueError: not today"


def test_what_comes_from_an_environment_cannot_steer_a_terminal(tmp_path, capsys):
    (tmp_path / "steering.py").write_text(
        "class Arena:\n"
        "    def reset(self, *, seed=None):\n"
        "        return {'a\\x1b[2J\\nb: 1': 1.0}, {}\n"
        "    def step(self, action):\n"
        "        raise ValueError('\\x1b[2J')\n",
        encoding="utf-8",
    )
    words = ("--allow-import", "steering", "--import-from", tmp_path)
    assert run("spaces", "--python", "steering:Arena", *words) == 0
    printed = capsys.readouterr()
    assert "\x1b" not in printed.out + printed.err
    assert list(read(Source("proposal", printed.out)).data) == ["environment"]
