"""Searches that end before their budget is spent: by the return, by what does not get better, by time."""

import json
from itertools import pairwise

import pytest

import bbsd
from bbsd import api
from tests.end_to_end.commands import bbsd as command
from tests.end_to_end.commands import written

SPEC = """
bbsd: 1
name: guess
environment:
  steps: 2
  state: {at: "integers(0, 5)", said: -1}
  sensors: {seen: "values(at, 0, 5)"}
behaviors:
  odd: {inputs: [seen], actions: {one: {said: 1}, three: {said: 3}, five: {said: 5}}}
  even: {inputs: [seen], actions: {none: {said: 0}, two: {said: 2}, four: {said: 4}}}
reward: {right: 1 if said == at else 0}
design:
  method: hill
  budget: 200_000
  answer: {candidates: 5, episodes: 100, judged: 200}
"""
BEST = 2.0
PAPER = {
    "design.method": "paper",
    "design.budget": None,
    "design.coevolution": {"generations": 60, "agents": 60},
} | {"design.learning": {"episodes": 4, "last": 2}}


@pytest.fixture
def spec(tmp_path):
    path = tmp_path / "guess.yaml"
    path.write_text(SPEC)
    return path


def exact(design):
    return bbsd.evaluate(design, exact=True).mean


@pytest.mark.parametrize("method", ["hill", "auto", "paper"])
def test_a_return_that_is_enough_ends_a_search(method):
    settings = PAPER if method == "paper" else {"design.method": method}
    whole = bbsd.design(SPEC, set=settings)
    assert whole.ended == ()
    enough = 1.0 if method == "paper" else 1.5
    found = bbsd.design(SPEC, set={**settings, "design.stop.return": enough})
    (ending,) = found.ended
    assert (ending.run, ending.ended_by) == (1, "return")
    assert found.spent < whole.spent / 2
    assert exact(found) > enough
    assert found.metrics[-1]["ended_by"] == "return"
    last = -1 if method == "paper" else -2
    assert found.metrics[:last] == whole.metrics[: len(found.metrics) + last]


def test_a_return_that_no_design_has_ends_nothing():
    found, whole = (bbsd.design(SPEC, set=stop) for stop in ({"design.stop.return": BEST + 0.1}, {}))
    assert found.ended == ()
    assert (found.metrics, found.text.partition("stop:")[0]) == (
        whole.metrics,
        found.text.partition("stop:")[0],
    )


@pytest.mark.parametrize("method", ["hill", "auto", "paper"])
def test_a_search_ends_where_nothing_gets_better(method):
    settings = PAPER if method == "paper" else {"design.method": method, "design.budget": 600_000}
    wait = 3_000 if method == "paper" else 100_000
    found = bbsd.design(SPEC, set={**settings, "design.stop.unimproved": wait})
    (ending,) = found.ended
    assert ending.ended_by == "unimproved"
    assert ending.done < ending.of
    if method != "paper":
        means = [line["structure"] for line in found.metrics if line["stage"] == "search"]
        assert len(means) > 3
        searched = [line["episodes"] for line in found.metrics[:-1]]
        assert searched[-1] - searched[0] >= wait * 0.9
        assert all(one < other for one, other in pairwise(searched))


def test_jobs_and_lanes_change_nothing_of_when_it_ends(spec, tmp_path):
    words = [
        "design",
        spec,
        "--runs",
        "3",
        "-q",
        "--json",
        "--set",
        "design.stop={return: 1.5, unimproved: 60_000}",
    ]
    alone = command(*words, "--out", tmp_path / "a")
    together = command(*words, "--out", tmp_path / "b", "--jobs", "2", "--lanes", "7")
    assert alone[0] == together[0] == 0
    assert written(tmp_path / "a") == written(tmp_path / "b")
    results = [json.loads(out)["ended"] for _, out, _ in (alone, together)]
    assert results[0] == results[1]
    assert [each["run"] for each in results[0]] == [1, 2, 3]


@pytest.mark.parametrize("settings", [{}, PAPER], ids=["search", "paper"])
@pytest.mark.parametrize("at", ["first", "last"])
def test_a_search_that_ends_early_and_is_stopped_ends_with_the_same_bytes(spec, tmp_path, settings, at):
    values = {**settings, "design.stop.return": 1.0 if settings else 1.5}
    whole = bbsd.design(spec, set=values, out=tmp_path / "whole")
    told = []

    def stop(progress):
        told.append(progress)
        if at == "first" or len(told) == len(whole.metrics) - (not settings):
            raise KeyboardInterrupt

    with pytest.raises(api.Interrupted):
        bbsd.design(spec, set=values, out=tmp_path / "run", progress=stop)
    again = bbsd.design(spec, set=values, out=tmp_path / "run", resume=True)
    assert written(again.folder) == written(whole.folder)
    assert again.ended == whole.ended


def test_more_is_more_although_the_return_is_enough(spec, tmp_path):
    found = bbsd.design(spec, set={"design.stop.return": 1.5}, out=tmp_path / "run")
    more = bbsd.design(found, more=20_000)
    assert more.ended == ()
    assert more.spent > found.spent + 10_000
    assert [line.get("ended_by") for line in more.metrics if line["stage"] == "answer"] == ["return", None]


@pytest.mark.parametrize("method", ["hill", "paper"])
def test_a_time_limit_ends_a_search_cleanly(spec, tmp_path, method):
    words = ["design", spec, "--out", tmp_path / "run", "--time-limit", "0.5s"]
    huge = [f"{key}={json.dumps(value)}" for key, value in PAPER.items()]
    huge += ["design.coevolution.generations=100000"]
    for setting in huge if method == "paper" else ["design.budget=1_000_000_000"]:
        words += ["--set", setting]
    code, out, err = command(*words)
    assert code == 0
    assert "ended early, after" in out.replace("\n", " ")
    assert "what a time ends cannot be reproduced" in err
    record = json.loads((tmp_path / "run" / "run.json").read_text())
    assert record["result"]["ended"][0]["ended_by"] == "time"
    assert "the time was over" in command("runs", tmp_path / "run")[1]
    assert "the time was over" in command("watch", tmp_path / "run")[1]
    before = written(tmp_path / "run")
    assert command(*words, "--resume", "-q")[0] == 0
    assert written(tmp_path / "run") == before
    if method == "hill":
        assert command("design", tmp_path / "run", "--more", "8_000", "-q")[0] == 0
        assert written(tmp_path / "run") != before


def test_a_time_limit_is_a_time(spec):
    for text in ("10", "0s", "soon"):
        code, _, err = command("design", spec, "--time-limit", text)
        assert code == 2
        assert "is no time, such as 90s, 10m or 2h" in err.replace("\n", " ")


def test_why_a_search_ended_is_on_the_page(spec, tmp_path):
    from bbsd.report.page.origin import repeat_plain

    found = bbsd.design(spec, set={"design.stop.return": 1.5}, out=tmp_path / "run")
    facts = repeat_plain(bbsd.page(found.folder, episodes=20))["facts"]
    assert any(name == "search" and "earns enough (design.stop.return)" in text for name, text in facts)
