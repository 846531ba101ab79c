"""`bbsd compare`, and git that shows differences of designs by it."""

import json
import os
import shutil
import subprocess
import sys

import pytest

from tests.end_to_end.commands import bbsd
from tests.unit.explanation.comparison.designs import WALK, edited

OTHER = edited(
    WALK, ("rules: [otherwise: right]", "rules: [{when: {odd: true}, do: stay}, {otherwise: right}]")
)


@pytest.fixture
def designs(tmp_path):
    (tmp_path / "a.yaml").write_text(WALK)
    (tmp_path / "b.yaml").write_text(OTHER)
    return tmp_path


def test_each_is_compared_with_the_first(designs):
    code, out, err = bbsd("compare", "a.yaml", "b.yaml", "a.yaml", "--episodes", 20, cwd=designs)
    assert (code, err) == (0, "")
    assert out.count("A  a.yaml\n") == 2
    assert "B  b.yaml\n" in out
    assert "Tables and structure are the same." in out


def test_json(designs):
    words = ("compare", "a.yaml", "b.yaml", "--episodes", 20, "--format", "json")
    code, out, err = bbsd(*words, cwd=designs)
    assert (code, err) == (0, "")
    plain = json.loads(out)
    assert plain["return"]["difference"]["mean"] < 0
    assert bbsd(*words, cwd=designs)[1] == out
    assert len(json.loads(bbsd(*words, "b.yaml", cwd=designs)[1])) == 2


def test_a_requirement_that_is_missed_is_said_on_standard_error(designs):
    low = json.loads(
        bbsd("compare", "a.yaml", "b.yaml", "--episodes", 20, "--format", "json", cwd=designs)[1]
    )
    low = low["return"]["difference"]["ci95"][0]
    code, out, err = bbsd("compare", "a.yaml", "b.yaml", "--episodes", 20, "--at-least", 0, cwd=designs)
    assert code == 1
    assert "b.yaml earns more than a.yaml begins at" in err
    assert "A  a.yaml" in out
    assert bbsd("compare", "a.yaml", "b.yaml", "--episodes", 20, "--at-least", low, cwd=designs)[0] == 0
    assert (
        bbsd("compare", "a.yaml", "b.yaml", "--episodes", 20, "--at-least", low + 1e-6, cwd=designs)[0] == 1
    )


def test_mistakes_of_the_user(designs):
    (designs / "holes.yaml").write_text(edited(WALK, ("structure: [back, go]", "")))
    code, out, err = bbsd("compare", "a.yaml", "holes.yaml", cwd=designs)
    assert (code, out) == (2, "")
    assert "holes.yaml: the design has holes: 2 of 2 layers open" in err
    (designs / "infinite.yaml").write_text(edited(WALK, ("late: -y", "far: 1 / (y - y)")))
    code, out, err = bbsd("compare", "a.yaml", "infinite.yaml", cwd=designs)
    assert (code, out) == (2, "")
    assert "infinite.yaml:" in err
    assert "error[BB045]" in err
    assert bbsd("compare", "a.yaml", cwd=designs)[0] == 2
    assert bbsd("compare", "a.yaml", "nowhere.yaml", cwd=designs)[0] == 2
    assert bbsd("compare", "a.yaml", "b.yaml", "--episodes", 1, cwd=designs)[0] == 2


def git(*words, cwd):
    settings = {
        "GIT_CONFIG_GLOBAL": os.devnull,
        "GIT_CONFIG_NOSYSTEM": "1",
        "GIT_AUTHOR_DATE": "2026-01-01T00:00:00Z",
        "GIT_COMMITTER_DATE": "2026-01-01T00:00:00Z",
    }
    who = ("-c", "user.name=designer", "-c", "user.email=designer@example.org")
    done = subprocess.run(
        ["git", *who, *words],
        cwd=cwd,
        env={**os.environ, **settings},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
@pytest.mark.parametrize("way", ["words", "comparison"])
def test_git_shows_what_changed_in_a_design(tmp_path, way):
    git("init", "-q", cwd=tmp_path)
    (tmp_path / ".gitattributes").write_text("architecture.yaml diff=bbsd\n")
    path = tmp_path / "architecture.yaml"
    path.write_text(WALK)
    git("add", ".", cwd=tmp_path)
    git("commit", "-q", "-m", "a design", cwd=tmp_path)
    path.write_text(OTHER)
    tool = f"'{sys.executable}' -m bbsd"
    if way == "words":
        git("config", "diff.bbsd.textconv", f"{tool} explain", cwd=tmp_path)
        shown = git("diff", cwd=tmp_path)
        assert "-1  go    always right" in shown
        assert "+1  go    stay where odd" in shown
    else:
        git(
            "config",
            "diff.bbsd.command",
            f'f() {{ {tool} compare --episodes 20 "$2" "$5" || true; }}; f',
            cwd=tmp_path,
        )
        shown = git("diff", cwd=tmp_path)
        assert "go: right becomes stay" in shown
        assert "of A's robot-steps B would have commanded something else" in shown
    assert "rules:" not in shown
    new = tmp_path / "new"
    new.mkdir()
    shutil.copy(path, new)
    git("add", "-N", ".", cwd=tmp_path)
    shown = git("diff", cwd=tmp_path)
    assert ("+1  go    stay where odd" in shown) == (way == "words")
