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


def test_the_cache_is_emptied_first(capsys, monkeypatch, tmp_path):
    root = tmp_path / "cache"
    monkeypatch.setenv("BBSD_CACHE_DIR", str(root))
    (root / "kernels").mkdir(parents=True)
    (root / "kernels" / "a.py").write_bytes(bytes(2_000_000))
    monkeypatch.setattr(health, "examine", lambda: iter([]))
    assert run("doctor", "--clean") == 0
    assert capsys.readouterr().err == f"2.0 MB removed from {root}\n"
    assert not list(root.rglob("*.py"))
