from __future__ import annotations

from pathlib import Path

import pytest

from tests.unit.cli.commands import run

UNTIDY, TIDY = "bbsd:  1\nconstants:\n    a: [1,2]\n", "bbsd: 1\n\nconstants:\n  a: [1, 2]\n"


@pytest.fixture(autouse=True)
def _files(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("untidy.yaml").write_text(UNTIDY, encoding="utf-8")
    Path("tidy.yaml").write_text(TIDY, encoding="utf-8")


def text(name):
    return Path(name).read_bytes().decode()


def test_files_are_put_in_the_style(capsys):
    assert run("fmt", "untidy.yaml", "tidy.yaml") == 0
    assert text("untidy.yaml") == text("tidy.yaml") == TIDY
    assert capsys.readouterr() == ("", "formatted untidy.yaml\n")


def test_check_writes_nothing_and_leaves_with_1(capsys):
    assert run("fmt", "--check", "tidy.yaml") == 0
    assert run("fmt", "--check", "untidy.yaml", "tidy.yaml") == 1
    assert text("untidy.yaml") == UNTIDY
    assert capsys.readouterr() == ("", "untidy.yaml is not formatted\n")


def test_diff_writes_nothing_and_shows_what_would_change(capsys):
    assert run("fmt", "--diff", "untidy.yaml") == 0
    assert text("untidy.yaml") == UNTIDY
    changed = [line for line in capsys.readouterr().out.splitlines() if line[0] in "+-"][2:]
    assert changed == ["-bbsd:  1", "+bbsd: 1", "+", "-    a: [1,2]", "+  a: [1, 2]"]


def test_diff_and_check_go_together(capsys):
    assert run("fmt", "--diff", "--check", "untidy.yaml") == 1
    assert capsys.readouterr().out.startswith("--- untidy.yaml\n")


def test_a_mistake_in_one_file_is_shown_and_the_others_are_formatted(capsys):
    Path("wrong.yaml").write_text("a: 1\na: 2\n", encoding="utf-8")
    assert run("fmt", "wrong.yaml", "untidy.yaml") == 2
    assert text("wrong.yaml") == "a: 1\na: 2\n"
    assert text("untidy.yaml") == TIDY
    assert "wrong.yaml:2:1: error[BB006]" in capsys.readouterr().err


def test_the_line_breaks_of_a_file_stay():
    Path("windows.yaml").write_bytes(UNTIDY.replace("\n", "\r\n").encode())
    run("fmt", "windows.yaml")
    assert text("windows.yaml") == TIDY.replace("\n", "\r\n")
