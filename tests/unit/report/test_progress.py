from __future__ import annotations

from io import StringIO

from rich.console import Console

from bbsd.api import Progress
from bbsd.report.progress import episode_listener, generation_listener, progress_line


def ended(run, runs, generation, generations, mean=250.5):
    return Progress(run, runs, generation, generations, mean, best=301.25, lifetime=-12.0)


def shown_generations(console, generations, **options):
    with generation_listener(console, **options) as listener:
        for generation in generations:
            listener(generation)
    return console.file.getvalue()


def test_a_plain_line_says_where_a_run_is_and_how_well_its_agents_do():
    expected = "generation 3/50: mean 250.50, best 301.25, lifetime -12.00"
    assert progress_line(ended(1, 1, 3, 50)) == expected
    assert progress_line(ended(2, 4, 3, 50)) == f"run 2/4, {expected}"


def test_without_a_terminal_there_is_a_line_for_each_tenth_of_a_run():
    text = shown_generations(Console(file=StringIO(), width=20), [ended(1, 1, g, 50) for g in range(1, 51)])
    assert [line.split(":")[0] for line in text.splitlines()] == [
        f"generation {g}/50" for g in range(5, 51, 5)
    ]


def test_a_short_run_has_a_line_for_each_generation():
    text = shown_generations(Console(file=StringIO()), [ended(1, 1, g, 3) for g in (1, 2, 3)])
    assert len(text.splitlines()) == 3


def test_quiet_says_nothing():
    generations = [ended(1, 1, g, 3) for g in (1, 2, 3)]
    for terminal in (False, True):
        assert (
            shown_generations(Console(file=StringIO(), force_terminal=terminal), generations, quiet=True)
            == ""
        )


def test_a_terminal_shows_one_line_with_a_curve_that_starts_anew_with_each_run():
    console = Console(file=StringIO(), force_terminal=True, width=120, color_system=None)
    first = [ended(1, 2, g, 4, mean=float(g)) for g in (1, 2, 3, 4)]
    text = shown_generations(console, [*first, ended(2, 2, 1, 4)])
    assert "run 2/2, generation 1/4 mean 250.50, best 301.25, lifetime -12.00 ▅ " in text


def test_the_live_line_fits_into_80_columns():
    console = Console(file=StringIO(), force_terminal=True, width=80, color_system=None)
    text = shown_generations(console, [ended(3, 8, 25, 100, mean=-1250.0)])
    assert "run 3/8, generation 25/100 mean -1250.0, best 301.2, lifetime -12.0" in text


def test_after_a_run_s_last_generation_a_terminal_shows_its_final_race():
    console = Console(file=StringIO(), force_terminal=True, width=80, color_system=None)
    text = shown_generations(console, [ended(1, 2, 1, 2), ended(1, 2, 2, 2)])
    assert "run 1/2, final race mean 250.50" in text


def shown_episodes(console):
    with episode_listener(console) as listener:
        for done in (4000, 8000, 10_000):
            listener(done, 10_000)
    return console.file.getvalue()


def test_a_terminal_shows_how_many_episodes_are_done_and_clears_the_line():
    console = Console(file=StringIO(), force_terminal=True, width=80, color_system=None)
    text = shown_episodes(console)
    assert "compiling" not in text.splitlines()[-1]
    assert "10,000 of 10,000 episodes" in text
    assert text.endswith("\x1b[1A\x1b[2K")


def test_without_a_terminal_nothing_is_said_of_episodes():
    assert shown_episodes(Console(file=StringIO())) == ""


def test_runs_that_go_on_side_by_side_have_a_line_each():
    console = Console(file=StringIO(), force_terminal=True, width=120, height=20, color_system=None)
    text = shown_generations(console, [ended(2, 3, 1, 4), ended(1, 3, 1, 4), ended(2, 3, 2, 4)])
    last = [line for line in text.splitlines() if "generation 2/4" in line or "generation 1/4" in line][-2:]
    assert [line.partition(" mean")[0].rpartition("run")[2] for line in last] == [
        " 2/3, generation 2/4",
        " 1/3, generation 1/4",
    ]


def test_a_run_that_begins_takes_the_line_of_one_that_ended():
    console = Console(file=StringIO(), force_terminal=True, width=120, height=20, color_system=None)
    ended_runs = [ended(1, 3, 1, 2), ended(2, 3, 1, 2), ended(1, 3, 2, 2)]
    text = shown_generations(console, [*ended_runs, ended(3, 3, 1, 2)])
    last = text[text.rindex("run 3/3, generation 1/2") :]
    assert "run 2/3, generation 1/2" in last
    assert "run 1/3" not in last
