"""Folders of runs that older versions wrote: each stays readable, and is continued or refused in words.

`python -m tests.runs` makes those of a new version or revision; nothing that is there is ever made anew.
"""

import json
import shutil
from hashlib import sha256

import pytest

import bbsd as api
from bbsd.runs.storage import choosing, identity, listing
from bbsd.version import REVISION, __version__
from tests.end_to_end.commands import bbsd
from tests.runs.__main__ import EPISODES, FINISHED, HOME, STOPPED, folder_of_this_version

VERSIONS = sorted(path for path in HOME.iterdir() if (path / "expected.json").is_file())
OF_EACH_VERSION = pytest.mark.parametrize("version", VERSIONS, ids=lambda path: path.name)
OF_EACH_RUN = pytest.mark.parametrize("name", [STOPPED, FINISHED])


@pytest.fixture
def copied(version, tmp_path):
    """A copy of all that a version wrote."""
    return shutil.copytree(version, tmp_path / "old")


def content_of(place):
    return {path.relative_to(place): path.read_bytes() for path in place.rglob("*") if path.is_file()}


def expected(version, name):
    return json.loads((version / "expected.json").read_text())[name]


def digest(path):
    return sha256(path.read_bytes()).hexdigest()


def resumed(place, version, name):
    """The outcome of continuing an old run with the words of its own command."""
    design = expected(version, name)
    settings = [word for override in design["set"] for word in ("--set", override)]
    run = place / name
    return bbsd(
        "design", run / "spec.yaml", "--seed", design["seed"], *settings, "--out", run, "--resume", "-q"
    )


def test_there_are_runs_of_this_version():
    """Make them by `python -m tests.runs` when the version or the revision goes up."""
    assert folder_of_this_version() in VERSIONS


@OF_EACH_VERSION
def test_old_runs_are_listed(copied):
    code, out, err = bbsd("runs", copied, "--json")
    found = {run["folder"].rpartition("/")[2]: run for run in json.loads(out)}
    assert (code, err) == (0, "")
    assert {name: (run["state"], run["method"], run["seed"]) for name, run in found.items()} == {
        STOPPED: ("stopped", "paper", 4),
        FINISHED: ("finished", "auto", 4),
    }
    assert (found[STOPPED]["generations"], found[STOPPED]["budget"]) == (5, 8)


@OF_EACH_VERSION
@OF_EACH_RUN
def test_old_runs_are_watched(copied, name):
    code, out, _ = bbsd("watch", copied / name)
    assert (code, out.splitlines()[-1].removeprefix(f"{copied / name} ").split(":")[0]) == (
        0,
        "was stopped" if name == STOPPED else "is done",
    )


@OF_EACH_VERSION
@pytest.mark.slow
def test_old_designs_earn_what_they_earned(copied, version):
    code, out, err = bbsd("evaluate", copied / FINISHED, "--episodes", EPISODES, "--json")
    assert (code, err) == (0, "")
    assert json.loads(out)["return"]["mean"] == pytest.approx(
        expected(version, FINISHED)["mean_return"], rel=1e-9
    )
    assert bbsd("evaluate", copied / STOPPED / "best.yaml", "--episodes", EPISODES)[0] == 0


@OF_EACH_VERSION
def test_old_designs_are_explained_with_what_was_visited(copied):
    code, out, err = bbsd("explain", copied / FINISHED)
    assert (code, err) == (0, "")
    assert "2 layers, highest first" in out
    assert bbsd("explain", copied / STOPPED / "best.yaml")[0] == 0
    visits = json.loads((copied / FINISHED / "visits.json").read_text())
    watched = api.explain(copied / FINISHED).watched
    assert watched.episodes == visits["episodes"]


@OF_EACH_VERSION
def test_an_old_run_without_an_answer_is_refused_in_words(copied):
    for command in ("evaluate", "explain"):
        code, out, err = bbsd(command, copied / STOPPED)
        assert (code, out) == (2, "")
        assert f"the run in {copied / STOPPED} has no answer yet" in err
        assert "--resume" in err


@OF_EACH_VERSION
@OF_EACH_RUN
@pytest.mark.slow
def test_old_runs_are_continued_to_the_same_bytes_or_refused(copied, version, name):
    before = content_of(copied)
    code, _, err = resumed(copied, version, name)
    if version == folder_of_this_version():
        assert (code, err) == (0, "")
        assert digest(copied / name / "architecture.yaml") == expected(version, name)["architecture_sha256"]
        assert digest(copied / name / "metrics.jsonl") == expected(version, name)["metrics_sha256"]
    else:
        assert code == 2
        assert "resume it with the former, or start again without --resume" in err
        assert content_of(copied) == before


@OF_EACH_RUN
def test_a_later_revision_refuses_to_continue_and_reads(name, tmp_path, monkeypatch):
    version = folder_of_this_version()
    copied = shutil.copytree(version, tmp_path / "old")
    before = content_of(copied)
    for module in (identity, choosing, listing):
        monkeypatch.setattr(module, "REVISION", REVISION + 1)
    code, out, err = resumed(copied, version, name)
    assert (code, out) == (2, "")
    assert f"by bbsd {__version__}, revision {REVISION}; this is bbsd {__version__}" in err
    assert f"by bbsd {__version__}, revision {REVISION}" in bbsd("runs", copied / name)[1]
    assert bbsd("watch", copied / name)[0] == 0
    assert content_of(copied) == before
