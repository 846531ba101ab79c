"""Searches by the command line: budgets, further ones, interrupts, rivals, several seeds."""

import json
import signal

import pytest

from bbsd.api import Interrupted, design
from tests.end_to_end.commands import bbsd, process, written

SPEC = """
bbsd: 1
name: guess
environment:
  steps: 2
  state: {at: "integers(0, 3)", said: 0}
  sensors: {seen: "values(at, 0, 3)"}
behaviors:
  odd: {inputs: [seen], actions: {one: {said: 1}, three: {said: 3}}}
  even: {inputs: [seen], actions: {none: {said: 0}, two: {said: 2}}}
reward: {right: 1 if said == at else 0}
design:
  method: random
  budget: 6_000
  answer: {candidates: 5, episodes: 100, judged: 100}
"""


@pytest.fixture
def spec(tmp_path):
    path = tmp_path / "guess.yaml"
    path.write_text(SPEC)
    return path


def test_a_budget_of_the_command_line_is_that_of_the_run(spec, tmp_path):
    code, out, err = bbsd("design", spec, "--budget", "20_000", "--out", tmp_path / "a", "--json")
    assert code == 0
    result = json.loads(out)
    assert (result["method"], result["lifetime"]) == ("random", None)
    assert 15_000 < result["search_episodes"] <= 20_000
    assert "of 20,000 episodes: best so far" in err
    assert json.loads((tmp_path / "a" / "run.json").read_text())["budgets"] == [20_000]


def test_a_budget_too_small_for_a_race_is_a_mistake(spec):
    code, out, err = bbsd("design", spec, "--budget", "100")
    assert (code, out) == (2, "")
    assert "BB023" in err
    assert "from 5 000 on" in err


def test_the_same_sequence_of_budgets_gives_the_same_bytes(spec, tmp_path):
    for name in ("a", "b"):
        assert bbsd("design", spec, "--out", tmp_path / name, "-q")[0] == 0
        code, out, _ = bbsd("design", tmp_path / name, "--more", "7_000", "-q", "--json")
        assert code == 0
        assert 10_000 < json.loads(out)["search_episodes"] <= 13_000
    assert written(tmp_path / "a") == written(tmp_path / "b")
    assert bbsd("design", spec, "--out", tmp_path / "a", "--resume", "-q")[0] == 0
    assert written(tmp_path / "a") == written(tmp_path / "b")


def test_the_paper_s_loop_cannot_be_given_more(spec, tmp_path):
    code, _, err = bbsd(
        "design", spec, "--set", "design.method=paper", "--budget", "20s", "--out", tmp_path / "a"
    )
    assert code == 2
    assert "has generations" in err
    assert not (tmp_path / "a").exists()


def test_a_budget_by_time_says_that_it_cannot_be_reproduced(spec, tmp_path):
    code, _, err = bbsd("design", spec, "--budget", "0.5s", "--out", tmp_path / "a", "-q")
    assert code == 0
    assert "cannot be reproduced" in err


def test_a_stopped_search_keeps_the_best_so_far_and_ends_with_the_same_bytes(spec, tmp_path):
    words = ["design", spec, "--budget", "600_000"]
    assert bbsd(*words, "--out", tmp_path / "whole", "-q")[0] == 0
    with process(*words, "--out", tmp_path / "a") as running:
        running.stderr.readline()
        running.send_signal(signal.SIGINT)
        out, err = running.communicate()
    assert (running.returncode, out) == (130, "")
    assert f"The best so far, {tmp_path / 'a' / 'best.yaml'}, earned" in err
    assert bbsd("evaluate", tmp_path / "a" / "best.yaml")[0] == 0
    command = err.splitlines()[-1].partition("To continue: bbsd ")[2].split()
    assert command[-1] == "--resume"
    assert bbsd(*command, "-q")[0] == 0
    assert written(tmp_path / "a") == written(tmp_path / "whole")
    assert not (tmp_path / "a" / "best.yaml").exists()


def test_a_second_writer_is_refused(spec, tmp_path):
    words = ["design", spec, "--budget", "3_000_000", "--out", tmp_path / "a"]
    with process(*words) as running:
        running.stderr.readline()
        code, _, err = bbsd(*words, "--resume")
        running.send_signal(signal.SIGINT)
        running.communicate()
    assert code == 2
    assert f"is being written by process {running.pid} on" in err


def test_runs_side_by_side_write_the_same_bytes(spec, tmp_path):
    words = ["design", spec, "--runs", "3", "-q", "--json"]
    alone = bbsd(*words, "--out", tmp_path / "a")
    together = bbsd(*words, "--out", tmp_path / "b", "--jobs", "2", "--lanes", "7")
    assert alone[0] == together[0] == 0
    assert written(tmp_path / "a") == written(tmp_path / "b")
    each = [json.loads(out)["each_run"] for _, out, _ in (alone, together)]
    assert each[0] == each[1]
    assert len(each[0]) == 3


def test_a_search_that_a_rival_s_interrupt_stops_has_its_answer(spec, tmp_path):
    def stop(progress):
        if progress.rival:
            raise KeyboardInterrupt

    with pytest.raises(Interrupted) as stopped:
        design(spec, out=tmp_path / "a", rivals=["hill"], progress=stop)
    assert stopped.value.best is None
    assert (tmp_path / "a" / "architecture.yaml").exists()
    assert design(spec, out=tmp_path / "a", rivals=["hill"], resume=True).rivals[0].method == "hill"


def test_a_timed_search_is_resumed_with_the_budget_that_it_had(spec, tmp_path):
    design(spec, out=tmp_path / "a", within=0.2)
    before = written(tmp_path / "a")
    design(spec, out=tmp_path / "a", within=0.2, resume=True)
    assert written(tmp_path / "a") == before


def test_a_rival_is_shown_beside_the_answer(spec, tmp_path):
    code, out, _ = bbsd("design", spec, "--rival", "hill", "--out", tmp_path / "a", "-q", "--json")
    assert code == 0
    rival = json.loads(out)["rival"]
    assert [*rival][:4] == ["method", "return", "ci95", "episodes"]
    assert rival["episodes"] <= 6000
    code, _, err = bbsd("design", spec, "--rival", "luck", "--out", tmp_path / "b")
    assert code == 2
    assert "luck is none of" in err


def test_all_methods_are_compared(spec, tmp_path):
    code, out, _ = bbsd("design", spec, "--compare-methods", "--out", tmp_path / "a", "-q")
    assert code == 0
    for method in ("societies", "cross_entropy", "hill", "joint", "paper"):
        assert f"rival {method} " in out


def test_several_seeds_stand_in_a_table(spec, tmp_path):
    code, out, _ = bbsd("design", spec, "--seeds", "3-4", "--out", tmp_path / "a", "-q")
    assert code == 0
    assert [line.split()[0] for line in out.splitlines()[:4]] == ["seed", "3", "4", "mean"]
    assert bbsd("design", spec, "--seed", "3", "--out", tmp_path / "b", "-q")[0] == 0
    assert written(tmp_path / "a" / "seed-3") == written(tmp_path / "b")


def test_a_search_is_priced(spec):
    code, out, _ = bbsd("design", spec, "--dry-run", "--runs", "2", "--budget", "50_000")
    assert code == 0
    assert "100,000 to search and choose (method random)" in out
