from __future__ import annotations

import json
from pathlib import Path

from tests.unit.cli.commands import run

SPECS = Path(__file__).parents[3] / "specs"
WRONG, RIGHT = SPECS / "invalid/BB020_behavior.yaml", SPECS / "mended/BB201_unused.yaml"
ODD = SPECS / "warned/BB201_unused.yaml"


def test_mistakes_are_printed_for_github(capsys):
    assert run("check", WRONG, RIGHT, "--format", "github") == 2
    (line,) = capsys.readouterr().out.splitlines()
    assert line.startswith(f"::error file={WRONG},line=")
    assert ",title=BB020::unexpected key" in line


def test_nothing_is_printed_for_github_where_nothing_is_wrong(capsys):
    assert run("check", RIGHT, "--format", "github") == 0
    assert capsys.readouterr() == ("", "")


def test_mistakes_of_all_files_are_in_one_log(capsys):
    assert run("check", WRONG, SPECS / "invalid/BB006_twice.yaml", "--format", "sarif") == 2
    (log,) = json.loads(capsys.readouterr().out)["runs"]
    assert [each["ruleId"] for each in log["results"]] == ["BB020", "BB006"]


def test_warnings_are_shown_and_change_the_code_only_where_that_is_asked_for(capsys):
    assert run("check", ODD) == 0
    out = capsys.readouterr().out
    assert (
        f"{ODD}:6:3: warning[BB201]: the constant top_speed is used only by fast, which is of no use itself\n"
        in out
    )
    assert f"\n{ODD}: ok, 5 warnings (1 behavior, " in out
    assert run("check", ODD, RIGHT, "--strict") == 2
    out = capsys.readouterr().out
    assert f"\n{ODD}: 5 warnings (1 behavior, " in out
    assert f"\n{RIGHT}: ok (1 behavior, " in out
    assert run("check", RIGHT, "--strict") == 0


def test_warnings_are_in_every_format(capsys):
    assert run("check", ODD, "--format", "github") == 0
    assert capsys.readouterr().out.startswith(f"::warning file={ODD},line=6,col=3,")
    assert run("check", ODD, "--format", "sarif") == 0
    (log,) = json.loads(capsys.readouterr().out)["runs"]
    assert {(each["ruleId"], each["level"]) for each in log["results"]} == {("BB201", "warning")}
    assert run("check", ODD, WRONG, "--format", "json", "--strict") == 2
    found = json.loads(capsys.readouterr().out)
    assert [each["severity"] for each in found["diagnoses"]] == ["warning"] * 5 + ["error"]
    assert [(each["mistakes"], each["warnings"]) for each in found["specs"]] == [(0, 5), (1, 0)]


def test_other_commands_say_in_a_line_that_there_are_warnings(capsys):
    assert run("evaluate", ODD, "--fill", "random", "--agents", "2", "--episodes", "2", "--json") == 0
    out, err = capsys.readouterr()
    assert err.splitlines()[0] == f"5 warnings: bbsd check {ODD} shows them"
    assert "warning" not in out
    assert run("evaluate", RIGHT, "--fill", "random", "--agents", "2", "--episodes", "2", "--json") == 0
    assert "warning" not in capsys.readouterr().err


def wrong(folder):
    """A spec with a mistake that has one reading, and one that has two."""
    path = folder / "wrong.yaml"
    text = (SPECS / "valid" / "BB050_no_else.yaml").read_text()
    (line,) = (line for line in text.splitlines() if line.strip().startswith("near:"))
    path.write_text(text.replace(line, "  near: 1 if tilted && true else 0  # both"))
    return path


def test_what_has_one_reading_is_fixed_in_the_file(tmp_path, capsys):
    path = wrong(tmp_path)
    before = path.read_text()
    assert run("check", "--fix", path) == 0
    assert path.read_text() == before.replace("&&", "and")
    told = capsys.readouterr().out
    assert "corrected[BB050]" in told
    assert "    + |   near: 1 if tilted and true else 0  # both" in told
    assert "1 corrected (" in told
    assert run("check", "--fix", path) == 0
    assert "corrected" not in capsys.readouterr().out


def test_corrections_can_be_shown_only(tmp_path, capsys):
    path = wrong(tmp_path)
    before = path.read_text()
    assert run("check", "--fix", "--diff", path) == 0
    assert path.read_text() == before
    told = capsys.readouterr()
    assert (
        "-  near: 1 if tilted && true else 0  # both\n+  near: 1 if tilted and true else 0  # both"
        in told.out
    )
    assert "would be corrected[" in told.err
    assert "1 would be corrected, nothing written" in told.err
    assert "&&" not in told.err.replace('"&&"', "")
    assert run("check", "--diff", path) == 2


def test_mistakes_that_remain_exit_with_2(tmp_path, capsys):
    path = wrong(tmp_path)
    path.write_text(path.read_text().replace("&& true else 0", "&& true"))
    assert run("check", "--fix", path) == 2
    assert "&&" in path.read_text()
    assert "maybe |   near: 1 if tilted and true else 0  # both" in capsys.readouterr().out
    assert run("check", "--fix", "--format", "json", path) == 2
    assert json.loads(capsys.readouterr().out)["specs"][0]["corrected"] == 0
