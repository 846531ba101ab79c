from __future__ import annotations

from math import exp

import pytest

from bbsd.report.figures import FigureError, draw_curves
from bbsd.report.figures.curves import _points


def metrics(runs, generations=4):
    return [
        {
            "run": run,
            "generation": generation,
            "mean": run * 10.0 - exp(-generation),
            "best": run * 20.0,
            "lifetime": run * 5.0,
            "diversity": {"push": 0.5 / generation, "stop": 0.0},
        }
        for run in range(1, runs + 1)
        for generation in range(1, generations + 1)
    ]


@pytest.mark.slow
@pytest.mark.parametrize("suffix", [".png", ".svg", ".pdf"])
def test_the_same_metrics_give_the_same_bytes(tmp_path, suffix):
    first, second = tmp_path / f"first{suffix}", tmp_path / f"second{suffix}"
    for path in (first, second):
        draw_curves(metrics(2), path)
    assert first.read_bytes() == second.read_bytes()


def test_a_drawing_names_its_lines_and_holds_neither_date_nor_program(tmp_path):
    draw_curves(metrics(1), tmp_path / "curves.svg")
    text = (tmp_path / "curves.svg").read_text()
    for words in ("mean of the agents", "best agent", "mean lifetime fitness", "push", "stop", "generation"):
        assert f"<!-- {words} -->" in text
    assert "<dc:date>" not in text
    assert "matplotlib v" not in text.lower()


def test_returns_to_compare_with_are_lines_or_named_where_they_are_far(tmp_path):
    draw_curves(
        metrics(1),
        tmp_path / "curves.svg",
        title="lifting",
        beside={"by hand": 12.0, "random agents": -900.0},
    )
    text = (tmp_path / "curves.svg").read_text()
    for words in ("lifting", "by hand 12.000", "random agents -900.00, far below"):
        assert f"<!-- {words} -->" in text


def test_the_names_of_many_pools_stand_below_their_diversity(tmp_path):
    lines = metrics(1)
    for line in lines:
        line["diversity"] = {f"behavior_number_{index}": 0.5 for index in range(25)}
    draw_curves(lines, tmp_path / "curves.svg")
    draw_curves(metrics(1), tmp_path / "few.svg")
    heights = [float((tmp_path / name).read_text().partition('height="')[2].partition("pt")[0])
               for name in ("curves.svg", "few.svg")]  # fmt: skip
    assert heights[0] > heights[1] + 72


@pytest.mark.parametrize("lines", [[], metrics(1, generations=1)])
def test_runs_that_have_hardly_begun_can_be_drawn(tmp_path, lines):
    draw_curves(lines, tmp_path / "curves.png")
    assert (tmp_path / "curves.png").stat().st_size > 1000


def search_records(runs):
    return [
        {
            "run": run,
            "method": "random",
            "stage": stage,
            "episodes": episodes,
            "mean": episodes / 1e3,
            "measured": 9,
        }
        for run in range(1, runs + 1)
        for stage, episodes in (("search", 1000), ("search", 2000), ("answer", 3000))
    ]


@pytest.mark.parametrize("runs", [1, 2])
def test_a_search_is_drawn_as_its_best_so_far_over_episodes(tmp_path, runs):
    draw_curves(search_records(runs), tmp_path / "curves.svg")
    text = (tmp_path / "curves.svg").read_text()
    for words in ("best so far" if runs == 1 else "best so far, run 2", "answer", "episodes"):
        assert f"<!-- {words} -->" in text
    assert "generation" not in text


def test_several_runs_are_drawn_as_their_mean_even_if_one_is_not_done():
    lines = metrics(2)[:-1]
    assert _points(lines, ("lifetime",)) == ([1, 2, 3, 4], [7.5, 7.5, 7.5, 5.0])
    assert _points(lines, ("diversity", "push"), run=2) == ([1, 2, 3], [0.5, 0.25, 0.5 / 3])


def test_a_kind_of_file_that_cannot_be_drawn_is_refused(tmp_path):
    with pytest.raises(FigureError, match=r"curves\.gif: the name of a figure's file ends with one of \.png"):
        draw_curves(metrics(1), tmp_path / "curves.gif")


def test_without_matplotlib_it_says_how_to_install_it(tmp_path, monkeypatch):
    monkeypatch.setattr("bbsd.report.figures.files.find_spec", lambda name: None)
    with pytest.raises(FigureError, match=r'pip install "bbsd\[plot\]"'):
        draw_curves(metrics(1), tmp_path / "curves.png")
