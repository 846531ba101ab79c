from __future__ import annotations

import sys
from pathlib import Path

import pytest

from bbsd.cli.designing.continuing import resume_command


@pytest.mark.parametrize(
    ("given", "command"),
    [
        ("design a.yaml", "bbsd design a.yaml --out 'my runs/a' --resume"),
        ("design a.yaml --seed 3 --resume", "bbsd design a.yaml --seed 3 --out 'my runs/a' --resume"),
        ("design a.yaml --out=b", "bbsd design a.yaml --out=b --resume"),
        ("design a.yaml --out b", "bbsd design a.yaml --out b --resume"),
    ],
)
def test_a_stopped_command_is_gone_on_with_in_its_folder(monkeypatch, given, command):
    monkeypatch.setattr(sys, "argv", ["bbsd", *given.split()])
    assert resume_command(Path("my runs/a")) == command
