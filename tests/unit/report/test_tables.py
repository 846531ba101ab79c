from __future__ import annotations

from dataclasses import replace
from io import StringIO
from math import nan
from pathlib import Path

import pytest
from rich.console import Console

from bbsd.evaluation import Interval, Spread
from bbsd.report.tables import design_table, evaluation_table, seeds_table
from bbsd.runs.rivals import Rival


def printed(table, width=100):
    console = Console(file=StringIO(), width=width, color_system=None)
    console.print(table)
    return "\n".join(line.rstrip() for line in console.file.getvalue().splitlines())


def row(text, first):
    return next(line.split() for line in text.splitlines() if line.startswith(first))


def test_an_evaluation_shows_the_return_with_its_interval_and_basis(evaluation):
    assert "301.37   7.02                 300.94 to 301.81\n1,000 episodes of 300 steps" in printed(
        evaluation_table(evaluation)
    )


def test_an_evaluation_shows_how_single_episodes_are_spread(evaluation):
    spread = Spread(
        277.9, 313.6, {5: 288.0, 50: 303.0, 95: 311.0}, {"worst": 521, "median": 550, "best": 365}
    )
    text = printed(evaluation_table(replace(evaluation, spread=spread)))
    assert row(text, "episodes") == ["episodes", "worst", "5", "%", "50", "%", "95", "%", "best"]
    assert row(text, "return     ") == ["return", "277.90", "288.00", "303.00", "311.00", "313.60"]
    assert row(text, "number") == ["number", "521", "550", "365"]
    text = printed(evaluation_table(replace(evaluation, spread=replace(spread, episodes={}))))
    assert "number" not in text


def test_an_evaluation_shows_each_reward_term_and_who_was_in_control(evaluation):
    text = printed(evaluation_table(evaluation))
    assert row(text, "leveling") == ["leveling", "-12.11"]
    assert row(text, "stop_at_goal") == ["stop_at_goal", "75.0", "%", "█" * 18]
    assert row(text, "nobody") == ["nobody", "25.0", "%", "█" * 6]


def test_bars_are_ascii_where_the_output_has_no_blocks(evaluation):
    assert printed(evaluation_table(evaluation, blocks=False)).isascii()


def test_values_that_were_not_finite_are_listed_only_where_there_were_any(evaluation):
    heading = "infinite or not a number"
    assert heading not in printed(evaluation_table(evaluation))
    text = printed(evaluation_table(replace(evaluation, not_finite={"tilt_0": 12})))
    assert heading in text
    assert row(text, "tilt_0") == ["tilt_0", "12"]


def test_one_episode_has_no_interval(evaluation):
    lone = replace(evaluation, returns=Interval(3.0, nan, nan, nan, 1), episodes=1)
    assert "unknown to unknown\n1 episode of 300 steps" in printed(evaluation_table(lone))


def test_an_exact_evaluation_has_no_interval_either(evaluation):
    text = printed(evaluation_table(replace(evaluation, exact=True, episodes=25, steps=1.0)))
    assert "exact\nall 25 starts, 1 step each" in text


def test_several_agents_and_episodes_of_different_length_are_shown(evaluation):
    text = printed(evaluation_table(replace(evaluation, agents=50, steps=12.25)))
    assert "1,000 episodes of 12.2 steps on average by 50 agents" in text


def test_a_design_shows_its_structure_from_the_highest_layer_down(designed):
    lines = printed(design_table(designed)).splitlines()
    assert [line.split() for line in lines[:3]] == [
        ["layer", "behavior"],
        ["2", "stop_at_goal"],
        ["1", "push_more"],
    ]


def test_a_design_is_compared_with_random_agents(designed):
    text = printed(design_table(designed))
    assert row(text, "design")[1:5] == ["301.37", "300.94", "to", "301.81"]
    assert row(text, "lifetime")[2:6] == ["299.20", "296.20", "to", "302.20"]
    assert row(text, "random")[2:6] == ["-612.30", "-642.50", "to", "-582.10"]
    assert "runs/lifting-seed0/architecture.yaml, designed in 41.2 s" in text


@pytest.mark.parametrize("width", [80, 40, 20])
def test_tables_keep_to_the_width_of_the_terminal(evaluation, designed, width):
    for table in (evaluation_table(evaluation), design_table(designed)):
        assert max(map(len, printed(table, width).splitlines())) <= width


def test_texts_are_no_markup_and_do_not_steer_the_terminal(designed):
    strange = replace(designed, written=Path("[bold]a[/bold]\x1b[31m"), structure=("[red]x",))
    text = printed(design_table(strange))
    assert "[bold]a[/bold]\\x1b[31m/architecture.yaml" in text
    assert "[red]x" in text


def test_expectations_are_shown_where_there_are_any(evaluation):
    assert "expectation" not in printed(evaluation_table(evaluation))
    shares = {"stop_at_goal": 0.5, "push_more": nan}
    text = printed(evaluation_table(replace(evaluation, expectation_share=shares)))
    below = text[text.index("expectation of") :]
    assert row(below, "stop_at_goal") == ["stop_at_goal", "50.0", "%", "█" * 12]
    assert row(below, "push_more") == ["push_more", "never", "in", "control"]


def around(mean):
    return Interval(mean, 1.0, mean - 0.5, mean + 0.5, 1000)


def test_runs_stand_in_a_table_with_their_spread(designed):
    several = replace(designed, each=((around(9.0), ("push", "stop")), (around(1.0), ("stop", "push"))))
    text = printed(design_table(several))
    assert row(text, "   1")[:4] == ["1", "9.0000", "8.5000", "to"]
    assert row(text, "mean")[1:2] == ["5.0000"]
    assert "standard deviation 5.6569" in text
    assert "local optima: 1 of 2 runs is up to 8.0000 below the best" in text


def test_seeds_stand_in_a_table_with_the_best_of_them(designed):
    worse = replace(designed, evaluation=replace(designed.evaluation, returns=around(3.0)))
    text = printed(seeds_table({4: worse, 5: designed}))
    assert row(text, "   4")[:2] == ["4", "3.00"]
    assert "best: runs/lifting-seed0/architecture.yaml" in text


def test_a_rival_has_a_row_and_a_search_no_lifetimes(designed):
    text = printed(
        design_table(
            replace(designed, lifetime=None, rivals=(Rival("random", around(304.5), 250_000, ("push",)),))
        )
    )
    assert row(text, "rival random")[2] == "304.50"
    assert "after 250,000 episodes" in text
    assert "lifetime" not in text


def test_what_was_compiled_before_a_design_is_told_where_it_took_long(designed):
    assert printed(design_table(designed)).endswith("architecture.yaml, designed in 41.2 s")
    slow = replace(designed, seconds=2.2, compile_seconds=14.0)
    assert printed(design_table(slow)).endswith("designed in 2.2 s, after 14.0 s of compiling")
