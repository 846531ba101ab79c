"""Results as the evaluation makes them."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from bbsd.api import Designed
from bbsd.architecture.visits import Visits
from bbsd.evaluation import Decisions, Evaluation, Interval, Trace
from bbsd.evaluation.tracing.decisions import Layer
from bbsd.expression.node_data import Slot
from bbsd.solver.judgement import Selection


@pytest.fixture
def evaluation():
    return Evaluation(
        returns=Interval(301.3734, 7.02, 300.938, 301.809, 1000),
        episodes=1000,
        agents=1,
        reward_terms={"leveling": -12.11, "near_goal": 212.2},
        control_share={"stop_at_goal": 0.75, "nobody": 0.25},
        steps=300.0,
        not_finite={},
    )


@pytest.fixture
def designed(evaluation):
    return Designed(
        name="lifting",
        text="bbsd: 1\n",
        written=Path("runs/lifting-seed0"),
        metrics=(),
        visits=Visits(0, 0, (), ()),
        method="paper",
        structure=("stop_at_goal", "push_more"),
        evaluation=evaluation,
        lifetime=Interval(299.2, 20.0, 296.2, 302.2, 200),
        random=Interval(-612.3, 300.0, -642.5, -582.1, 1000),
        seconds=41.2,
        compile_seconds=0.1,
        selection=Selection(None, (), 1000, 10_000),
        spent=250_000,
        each=(),
        rivals=(),
        first_reward=None,
        unvisited=(),
    )


@pytest.fixture
def trace():
    values = {
        Slot("height", 0): [2.0, 2.5, 3.0],
        Slot("height", 1): [2.1, 2.1, 2.1],
        Slot("tilt", 0): [9.0, 4.0, 1.0],
        Slot("tilt", 1): [9.0, 4.0, 1.0],
        Slot("tilted", 0): [True, False, False],
        Slot("tilted", 1): [True, False, False],
        Slot("place", 0): ["lowest", "highest", "highest"],
        Slot("place", 1): ["highest", "lowest", "lowest"],
        Slot("sonar", 0): [0.5, 0.25, 0.125],
        Slot("sonar", 1): [7.0, 7.0, 7.0],
    }
    controlling = [["push_more", "push_more", "stop_at_goal"], ["push_more", "nobody", "push_more"]]
    rewards = {"near_goal": [np.array([0.1, 0.2, 1.0]), np.array([0.1, 0.2, 0.3])]}
    actions = [["push", "push", "stop"], ["push", "", "push"]]
    wishes = np.array([[[1, 0, 0], [1, 0, 0]], [[1, 0, 0], [0, 0, 0]], [[1, 1, 0], [1, 0, 0]]])
    excited, who = np.ones((3, 2, 3), bool), np.array([[0, 0], [0, -1], [1, 0]])
    return Trace(
        steps=np.arange(1, 4),
        values=values,
        start={slot: value[0] for slot, value in values.items()},
        controlling=controlling,
        actions=actions,
        rewards=rewards,
        robots=2,
        decisions=Decisions(excited, np.array([[[1, 0, 0]] * 2] * 3), wishes, who),
        layers=(
            Layer("stop_at_goal", 1, {}, ("stop",)),
            Layer("push_more", 0, {"place": ("lowest", "highest")}, ("push",)),
        ),
    )
