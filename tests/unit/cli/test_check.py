from __future__ import annotations

import json
from pathlib import Path

from tests.unit.cli.commands import run

SPECS = Path(__file__).parents[2] / "specs"
WRONG, RIGHT = SPECS / "invalid/BB020_top.yaml", SPECS / "valid/BB020_top.yaml"


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
