from __future__ import annotations

import json
from dataclasses import replace
from math import inf, nan

import pytest

from bbsd.evaluation import Interval
from bbsd.report.plain import design_plain, evaluation_plain, json_text


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
        "seed": 7,
        "runs": 2,
    }


def test_json_has_null_for_what_is_not_finite(evaluation):
    odd = replace(evaluation, returns=Interval(inf, nan, -inf, nan, 1), reward_terms={"level": nan})
    plain = json.loads(json_text(evaluation_plain(odd)))
    assert plain["return"] == {"mean": None, "sd": None, "ci95": [None, None]}
    assert plain["reward_terms"] == {"level": None}


def test_json_refuses_a_nan_that_was_overlooked():
    with pytest.raises(ValueError, match="not JSON compliant"):
        json_text({"mean": nan})
