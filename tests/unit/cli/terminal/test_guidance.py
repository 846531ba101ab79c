"""Command lines that are not understood are answered by the command that is meant."""

import pytest

from tests.unit.cli.commands import run


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["run", "x.yaml"], "design or evaluate is meant: bbsd design x.yaml"),
        (["x.yaml"], "write bbsd check x.yaml or bbsd design x.yaml"),
        (["chek", "x.yaml"], "did you mean bbsd check x.yaml?"),
        (
            ["design", "x.yaml", "--generations", "5"],
            "bbsd design x.yaml --set design.coevolution.generations=5",
        ),
        (["design", "x.yaml", "--bugdet", "5"], "did you mean --budget?"),
        (["fmt", "x.yaml", "--episodes", "5"], "it is one of bbsd evaluate"),
        (["design", "x.yaml", "--seed", "abc"], "it must be a whole number"),
        (["evaluate", "x.yaml", "--set", "a.b", "=", "2"], "bbsd evaluate x.yaml --set a.b=2"),
        (["export", "x.yaml", "--to", "cpp"], "did you mean bbsd export x.yaml --to c?"),
    ],
)
def test_what_is_meant_is_said(words, said, capsys):
    assert run(*words) == 2
    assert said in " ".join(capsys.readouterr().err.split())


def test_a_hostile_command_steers_nothing(capsys):
    assert run("\x1b[2Jx.yaml") == 2
    assert "\x1b" not in capsys.readouterr().err


def test_the_version_is_a_command_too(capsys):
    assert run("version") == 0
    assert capsys.readouterr().out.startswith("bbsd 0")


def test_a_missing_file_that_is_near_is_named(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "specs").mkdir()
    (tmp_path / "specs" / "docking.yaml").write_text("bbsd: 1")
    assert run("check", "specs/doking.yaml") == 2
    assert 'did you mean "specs/docking.yaml"?' in capsys.readouterr().out
    assert run("check", "docking.yaml") == 2
    assert 'did you mean "specs/docking.yaml"?' in capsys.readouterr().out
