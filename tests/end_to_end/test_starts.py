"""Searches that begin with a known design: it is among the candidates of each method, and nothing worse comes out."""

import json
from typing import get_args

import pytest

import bbsd
from bbsd import api
from bbsd.architecture.starting import UnfitStart
from bbsd.language.design import MethodName
from bbsd.runs.storage.records import FolderError
from tests.end_to_end.commands import bbsd as command
from tests.end_to_end.commands import written

N = 60
SPEC = f"""
bbsd: 1
name: tell
environment:
  steps: 2
  state: {{at: "integers(0, {N - 1})", said: -1}}
  sensors: {{seen: "values(at, 0, {N - 1})"}}
behaviors:
  low: {{inputs: [seen], actions: {{{", ".join(f"n{k}: {{said: {k}}}" for k in range(N // 2))}}}}}
  high: {{inputs: [seen], actions: {{{", ".join(f"n{k}: {{said: {k}}}" for k in range(N // 2, N))}}}}}
reward: {{right: 1 if said == at else 0}}
design:
  method: random
  budget: 5_000
  answer: {{candidates: 5, episodes: 100, judged: 100}}
"""
"""Say where you are. There are some 10^170 designs, and nothing that so few episodes find says it everywhere."""
BEST = 2.0


def rules(first, last):
    told = "".join(f"{{when: {{seen: {k}}}, do: n{k}}}, " for k in range(first, last))
    return f"rules: [{told}otherwise: no action]"


HAND = (
    SPEC.replace(f"said: {N // 2 - 1}}}}}", f"said: {N // 2 - 1}}}}}, " + rules(0, N // 2))
    .replace(f"said: {N - 1}}}}}", f"said: {N - 1}}}}}, " + rules(N // 2, N))
    .replace("reward:", "structure: [low, high]\nreward:")
)
PAPER = {"design.method": "paper", "design.budget": None} | {
    f"design.{key}": value
    for key, value in {
        "coevolution.generations": 2,
        "coevolution.population": 4,
        "coevolution.agents": 12,
        "learning.episodes": 3,
        "learning.last": 2,
    }.items()
}


def exact(design):
    return bbsd.evaluate(design, exact=True).mean


def of_method(method):
    return PAPER if method == "paper" else {"design.method": method}


def test_the_design_by_hand_is_the_best_there_is():
    assert exact(HAND) == BEST


@pytest.mark.slow
@pytest.mark.parametrize("method", get_args(MethodName))
def test_a_method_that_begins_with_the_best_design_ends_with_it(method):
    assert exact(bbsd.design(SPEC, set=of_method(method))) < BEST
    designed = bbsd.design(SPEC, set=of_method(method), start=HAND)
    assert exact(designed) == BEST
    assert designed.method == method


@pytest.mark.slow
@pytest.mark.parametrize("method", ["auto", "hill", "joint", "societies", "cross_entropy", "practice", "q"])
def test_a_start_with_a_hole_is_filled(method):
    half = HAND.replace("{when: {seen: 7}, do: n7}, ", "{when: {seen: 7}, do: open}, ")
    assert exact(bbsd.design(SPEC, set=of_method(method), start=half)) >= BEST - 2 / N


def test_several_starts_may_be_given():
    silent = SPEC.replace("actions: {n", "rules: [otherwise: no action], actions: {n")
    silent = silent.replace("reward:", "structure: [high, low]\nreward:")
    for starts in ([silent, HAND], [HAND, silent]):
        assert exact(bbsd.design(SPEC, start=starts)) == BEST


def test_what_the_spec_gives_stays():
    given = SPEC.replace("reward:", "structure: [high, low]\nreward:")
    said = []
    designed = bbsd.design(given, start=HAND, note=said.append)
    assert designed.structure == ("high", "low")
    assert said == ["<text> has 2 layers that the spec gives otherwise; they stay as the spec gives them"]
    assert exact(designed) == BEST


def test_a_start_that_does_not_fit_is_refused(tmp_path):
    with pytest.raises(
        UnfitStart, match='<text> has a behavior lower, and the spec has none; did you mean "low"'
    ):
        bbsd.design(SPEC, start=HAND.replace("low", "lower"), out=tmp_path / "run")
    assert not (tmp_path / "run").exists()


@pytest.fixture
def files(tmp_path):
    """A spec and a design to begin with, as files."""
    for name, text in (("tell.yaml", SPEC), ("hand.yaml", HAND)):
        (tmp_path / name).write_text(text)
    return tmp_path


@pytest.mark.parametrize("change", ["kept", "changed", "gone"])
@pytest.mark.parametrize("named", [True, False])
def test_a_stopped_design_goes_on_with_the_start_that_it_began_with(files, change, named):
    def stop(_progress):
        raise KeyboardInterrupt

    spec, start = files / "tell.yaml", files / "hand.yaml"
    whole = bbsd.design(spec, start=start, runs=2, out=files / "whole")
    with pytest.raises(api.Interrupted):
        bbsd.design(spec, start=start, runs=2, out=files / "run", progress=stop)
    if change == "changed":
        start.write_text(HAND.replace("do: n3", "do: n4"))
    elif change == "gone":
        start.unlink()
    said = []
    again = bbsd.design(
        spec, start=start if named else (), runs=2, out=files / "run", resume=True, note=said.append
    )
    assert written(again.folder) == written(whole.folder)
    assert len(said) == (named and change != "kept")
    assert all("it goes on with what it began with" in each for each in said)


def test_a_run_that_began_without_a_start_does_not_get_one(files):
    spec, start = files / "tell.yaml", files / "hand.yaml"
    bbsd.design(spec, out=files / "run")
    with pytest.raises(api.BadArgument, match="began without a start"):
        bbsd.design(spec, start=start, out=files / "run", resume=True)
    bbsd.design(spec, start=start, below=files / "runs")
    bbsd.design(spec, below=files / "runs")
    for starts, name in ((start, "tell-seed0"), ((), "tell-seed0-2")):
        found = bbsd.design(spec, start=starts, below=files / "runs", resume=True)
        assert found.folder.name == name


def test_the_start_is_a_part_of_what_makes_two_runs_the_same(files):
    one, other = (
        bbsd.design(SPEC, start=start, out=files / name)
        for name, start in (("one", HAND), ("other", HAND.replace("do: n3", "do: n4")))
    )
    (one.folder / "checkpoint.npz").write_bytes((other.folder / "checkpoint.npz").read_bytes())
    (one.folder / "metrics.jsonl").write_bytes((other.folder / "metrics.jsonl").read_bytes())
    (one.folder / "checkpoint.previous.npz").unlink(missing_ok=True)
    with pytest.raises(FolderError, match="of another run: different are the start"):
        bbsd.design(SPEC, out=one.folder, resume=True)


@pytest.mark.slow
def test_runs_side_by_side_and_rivals_begin_with_it_too(files):
    words = ["design", files / "tell.yaml", "--start", files / "hand.yaml", "--runs", "3", "-q", "--json"]
    words += ["--rival", "hill"]
    alone = command(*words, "--out", files / "a")
    together = command(*words, "--out", files / "b", "--jobs", "2", "--lanes", "7")
    assert alone[0] == together[0] == 0, alone[2] + together[2]
    assert written(files / "a") == written(files / "b")
    results = [json.loads(out) for _, out, _ in (alone, together)]
    assert [each["return"]["mean"] for each in results] == [BEST, BEST]
    assert [each["rival"]["return"] for each in results] == [BEST, BEST]


def test_a_run_is_a_start(files):
    first = bbsd.design(SPEC, start=HAND, out=files / "first")
    assert exact(bbsd.design(SPEC, start=first.folder)) == exact(bbsd.design(SPEC, start=first)) == BEST
    code, _, err = command(
        "design", files / "tell.yaml", "--start", files / "nothing.yaml", "--out", files / "run"
    )
    assert code == 2
    assert "there is no such file" in err
