from dataclasses import replace

from bbsd.evaluation import Interval
from bbsd.report.wording.warnings import disagreement, warnings_of
from bbsd.runs.outcome.visits import Unvisited
from bbsd.solver.judgement import Selection


def around(mean, half=0.5):
    return Interval(mean, 1.0, mean - half, mean + half, 1000)


def test_terms_that_no_random_agent_earned_are_named(designed):
    assert warnings_of(designed) == []
    found = warnings_of(replace(designed, selection=Selection(None, ("goal", "key"), 1000, 10_000)))
    assert found == ["1,000 random agents in 10,000 episodes never earned goal, key"]


def test_agents_that_all_earn_the_same_leave_nothing_to_select_by(designed):
    alike = replace(designed, selection=Selection(-200.0, ("goal",), 1000, 10_000), first_reward=31_000)
    (told,) = warnings_of(alike)
    assert told == (
        "1,000 random agents in 10,000 episodes all earned -200.00, and never goal: "
        "there is nothing to select by; a better design was there in episode 31,000"
    )


def test_cells_that_no_candidate_visited_are_told(designed):
    missed = (Unvisited("go", 3, 6, 1000), Unvisited("stop", 1, 2, 1000))
    assert warnings_of(replace(designed, unvisited=missed)) == [
        "cells that no candidate visited in 1,000 episodes, where any choice is as good: 3 of 6 of go, 1 of 2 of stop"
    ]


def test_runs_disagree_where_their_intervals_lie_apart():
    assert disagreement([around(9.0), around(8.5)]) == ""
    assert disagreement([around(9.0)]) == disagreement([]) == ""
    told = disagreement([around(9.0), around(1.0), around(8.9), around(3.0)])
    assert told == "local optima: 2 of 4 runs are up to 8.0000 below the best"
