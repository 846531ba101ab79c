from __future__ import annotations

import json
from dataclasses import replace
from math import inf, nan

import pytest

from bbsd.evaluation import Interval
from bbsd.report.plain import design_plain, disagreement_plain, evaluation_plain, json_text
from bbsd.runs.rivals import Rival


def test_an_evaluation_as_plain_data(evaluation):
    assert evaluation_plain(evaluation) == {
        "return": {"mean": 301.3734, "sd": 7.02, "ci95": [300.938, 301.809]},
        "episodes": 1000,
        "agents": 1,
        "exact": False,
        "steps": 300.0,
        "reward_terms": {"leveling": -12.11, "near_goal": 212.2},
        "control_share": {"stop_at_goal": 0.75, "nobody": 0.25},
    }


def test_values_that_were_not_finite_are_listed_where_there_were_any(evaluation):
    assert evaluation_plain(replace(evaluation, not_finite={"tilt_0": 3}))["not_finite"] == {"tilt_0": 3}


def test_expectations_are_listed_where_there_are_any(evaluation):
    plain = evaluation_plain(replace(evaluation, expectation_share={"stop_at_goal": 0.5, "push_more": nan}))
    assert plain["expectation_share"] == {"stop_at_goal": 0.5, "push_more": None}


def test_a_design_as_plain_data(designed):
    assert design_plain(designed, seed=7, runs=2) == {
        "architecture": "runs/lifting-seed0/architecture.yaml",
        "return": {"mean": 301.3734, "sd": 7.02, "ci95": [300.938, 301.809]},
        "episodes": 1000,
        "lifetime": {"mean": 299.2, "sd": 20.0, "ci95": [296.2, 302.2]},
        "random": {"mean": -612.3, "sd": 300.0, "ci95": [-642.5, -582.1]},
        "method": "paper",
        "structure": ["stop_at_goal", "push_more"],
        "seconds": 41.2,
        "compile_seconds": 0.1,
        "seed": 7,
        "runs": 2,
        "search_episodes": 250_000,
    }


def test_json_has_null_for_what_is_not_finite(evaluation):
    odd = replace(evaluation, returns=Interval(inf, nan, -inf, nan, 1), reward_terms={"level": nan})
    plain = json.loads(json_text(evaluation_plain(odd)))
    assert plain["return"] == {"mean": None, "sd": None, "ci95": [None, None]}
    assert plain["reward_terms"] == {"level": None}


def test_json_refuses_a_nan_that_was_overlooked():
    with pytest.raises(ValueError, match="not JSON compliant"):
        json_text({"mean": nan})


def around(mean):
    return Interval(mean, 1.0, mean - 0.5, mean + 0.5, 1000)


def test_a_rival_stands_beside_a_design(designed):
    random = Rival("random", around(304.5), 250_000, ("push_more",))
    plain = design_plain(replace(designed, rivals=(random,)), seed=7, runs=1)
    assert plain["rival"] == {
        "method": "random",
        "return": 304.5,
        "ci95": [304.0, 305.0],
        "episodes": 250_000,
        "structure": ["push_more"],
    }
    unable = Rival("q", None, 0, (), "too many cells")
    plain = design_plain(replace(designed, rivals=(random, unable)), seed=7, runs=1)
    assert [rival["method"] for rival in plain["rivals"]] == ["random", "q"]
    assert plain["rivals"][1]["reason"] == "too many cells"
    assert plain["warnings"] == ["rival q: too many cells"]


def test_runs_that_disagree_are_a_warning(designed):
    several = replace(designed, each=((around(9.0), ("a",)), (around(1.0), ("b",))))
    plain = design_plain(several, seed=7, runs=2)
    assert [run["structure"] for run in plain["each_run"]] == [["a"], ["b"]]
    assert plain["warnings"] == ["local optima: 1 of 2 runs is up to 8.0000 below the best"]
    assert disagreement_plain([designed, designed]) == {}
    json.loads(json_text(plain))
