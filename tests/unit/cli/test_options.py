from __future__ import annotations

import os
import subprocess
import sys

import pytest

from bbsd.cli.options import spec_files


@pytest.fixture(autouse=True)
def _files(tmp_path, monkeypatch):
    for folder in ("specs", "runs/one", ".hidden"):
        (tmp_path / folder).mkdir(parents=True)
    for file in ("specs/lift.yaml", "specs/lamp.yml", "specs/notes.txt", "runs/one/spec.yaml", ".h.yaml"):
        (tmp_path / file).touch()
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize(
    ("typed", "expected"),
    [
        ("", ["runs/", "specs/"]),
        ("s", ["specs/", "specs/lamp.yml", "specs/lift.yaml"]),
        ("specs/", ["specs/lamp.yml", "specs/lift.yaml"]),
        ("specs/li", ["specs/lift.yaml"]),
        ("r", ["runs/", "runs/one/", "runs/one/spec.yaml"]),
        ("nowhere/", []),
        ("x", []),
    ],
)
def test_specs_and_folders_are_completed(typed, expected):
    assert spec_files(typed) == expected


def bbsd(*words, **variables):
    command = [sys.executable, "-m", "bbsd", *words]
    environment = {**os.environ, "_TYPER_COMPLETE_TEST_DISABLE_SHELL_DETECTION": "1", **variables}
    return subprocess.run(command, env=environment, capture_output=True, text=True, check=False).stdout


@pytest.mark.slow
@pytest.mark.parametrize("shell", ["bash", "zsh", "fish"])
def test_a_shell_gets_a_script_that_asks_the_tool(shell):
    script = bbsd("--show-completion", shell)
    assert "_BBSD_COMPLETE=complete_" + shell in script


def test_a_shell_that_completes_gets_the_specs():
    asked = {"_BBSD_COMPLETE": "complete_bash", "COMP_WORDS": "bbsd design specs/l", "COMP_CWORD": "2"}
    assert bbsd(**asked).split() == ["specs/lamp.yml", "specs/lift.yaml"]
