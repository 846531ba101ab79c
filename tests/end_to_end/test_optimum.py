"""The best return of a task by dynamic programming: known optima, and processes small enough for paper."""

from __future__ import annotations

from pathlib import Path

import pytest

from experiments.optimum import NoFiniteProcess, main, optimum

SPECS = Path(__file__).parents[2] / "specs"
COIN = """
bbsd: 1
name: coin
environment:
  steps: 4
  state:
    guess: -1
    coin: integers(0, 1)
  dynamics:
    coin: integers(0, 1)
  sensors:
    seen: values({seen}, 0, 1)
behaviors:
  say:
    inputs: [seen]
    actions:
      heads:
        guess: 0
      tails:
        guess: 1
reward:
  right: {right}
"""


def optimum_of(text, tmp_path):
    path = tmp_path / "spec.yaml"
    path.write_text(text)
    return optimum(path)


@pytest.mark.parametrize(
    ("task", "best", "fixed"),
    [
        ("lake", 0.7442, 0.7402),
        ("lake_8x8", 0.9132, 0.8936),
        ("cliff_walking", -13, -13),
        ("taxi", 7.93, 7.93),
    ],
)
def test_known_optima(task, best, fixed):
    found = optimum(SPECS / "tasks" / f"{task}.yaml")
    assert found.best == pytest.approx(best, abs=5e-5)
    assert found.fixed == pytest.approx(fixed, abs=5e-5)


def test_a_taxi_has_the_states_of_the_benchmark():
    assert (
        optimum(SPECS / "tasks" / "taxi.yaml").n_states == 400
    )  # of 25 * 5 * 4: passengers are not brought where they are


def test_a_coin_that_is_seen_can_be_said(tmp_path):
    seen = COIN.format(seen="coin", right="1 if guess == before(coin) else 0")
    assert optimum_of(seen, tmp_path).best == 4


def test_a_coin_that_is_not_seen_is_guessed(tmp_path):
    hidden = COIN.format(seen="0", right="1 if guess == before(coin) else 0")
    assert optimum_of(hidden, tmp_path).best == pytest.approx(4 / 2)


def test_a_biased_draw_is_bet_on(tmp_path):
    text = COIN.format(seen="0", right="1 if guess == coin else 0").replace(
        "integers(0, 1)", "integers(0, 3) // 3"
    )
    assert optimum_of(text, tmp_path).best == pytest.approx(4 * 3 / 4)


def test_who_knows_the_last_step_may_do_something_else_in_it(tmp_path):
    text = """
bbsd: 1
name: leave-at-last
environment:
  steps: 2
  state:
    gone: false
  ends: gone
behaviors:
  choose:
    actions:
      leave:
        gone: true
reward:
  pay: 1 if gone else 0.6
"""
    found = optimum_of(text, tmp_path)
    assert found.best == pytest.approx(0.6 + 1)
    assert found.fixed == pytest.approx(0.6 + 0.6)


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        (("coin: integers(0, 1)\n  sensors", "coin: uniform(0, 1)\n  sensors"), "uniform"),
        (("steps: 4", "steps: 4\n  robots: 2"), "several robots"),
        (("else 0\n", "else step\n"), "depends on the step"),
        (("  sensors", "    guess: guess + 1\n  sensors"), "states"),
    ],
)
def test_a_task_without_a_finite_process_says_why(change, reason, tmp_path, monkeypatch):
    monkeypatch.setattr("experiments.optimum.MAX_STATES", 50)
    text = COIN.format(seen="0", right="1 if guess == coin else 0").replace(*change)
    with pytest.raises(NoFiniteProcess, match=reason):
        optimum_of(text, tmp_path)


def test_the_command_prints_an_optimum_or_why_there_is_none(monkeypatch, capsys):
    names = [str(SPECS / "tasks" / "lake.yaml"), str(SPECS / "pursuit.yaml")]
    monkeypatch.setattr("sys.argv", ["optimum", *names])
    assert main() == 1
    head, first, second = capsys.readouterr().out.splitlines()
    assert head.split() == ["at", "most", "fixed", "states"]
    assert first.split() == ["lake", "0.7442", "0.7402", "44"]
    assert second.endswith("several robots")
