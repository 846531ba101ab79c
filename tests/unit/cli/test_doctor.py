from __future__ import annotations

import json

from bbsd.report import health
from bbsd.report.health import Finding
from tests.unit.cli.commands import run


def test_a_sound_installation_leaves_with_0(capsys):
    assert run("doctor", "--json") == 0
    found = json.loads(capsys.readouterr().out)
    assert found["ok"]
    assert {"bbsd", "Python", "numba", "cores", "cache", "self-check"} <= {
        each["name"] for each in found["findings"]
    }


def test_a_problem_is_shown_and_the_exit_code_is_1(capsys, monkeypatch):
    monkeypatch.setattr(health, "examine", lambda: iter([Finding("cache", "/a", "full"), Finding("b", "c")]))
    assert run("doctor") == 1
    assert capsys.readouterr().out.splitlines() == [
        "cache       /a",
        "            wrong: full",
        "b           c",
    ]
