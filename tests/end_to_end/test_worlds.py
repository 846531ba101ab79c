"""The worlds that are shipped: a task, and the same task with a design made by hand."""

from __future__ import annotations

from pathlib import Path

import pytest

import bbsd
from bbsd.spec.loading import load
from bbsd.text import Source

SPECS = Path(__file__).parents[2] / "specs"
WORLDS = ("mobile_robot", "pursuit", "forager", "grid_world")
GIVEN = {"name", "summary", "behaviors", "structure", "design"}
"""What a design changes of a task, and what says nothing of the task itself."""


def loaded(name):
    return load(Source.read(str(SPECS / f"{name}.yaml")))


def without_rules(behavior):
    return {key: value for key, value in behavior.items() if key != "rules"}


@pytest.mark.parametrize("name", sorted(path.stem for path in SPECS.glob("*.yaml")))
def test_no_shipped_spec_has_a_mistake(name):
    assert bbsd.check(SPECS / f"{name}.yaml") == ()


@pytest.mark.parametrize("world", WORLDS)
def test_the_hand_made_design_is_of_the_same_task(world):
    task, hand = (loaded(name).document.data for name in (world, f"{world}_hand"))
    assert {key: value for key, value in task.items() if key not in GIVEN} == {
        key: value for key, value in hand.items() if key not in GIVEN
    }
    assert {name: without_rules(each) for name, each in hand["behaviors"].items()} == task["behaviors"]


@pytest.mark.parametrize("world", WORLDS)
def test_the_hand_made_design_earns_more_than_random_agents(world):
    hand = bbsd.evaluate(SPECS / f"{world}_hand.yaml", episodes=200)
    random = bbsd.evaluate(SPECS / f"{world}.yaml", fill="random", agents=100, episodes=2)
    assert hand.ci95[0] > random.ci95[1]


def test_every_start_of_the_grid_world_can_be_tried():
    found = bbsd.evaluate(SPECS / "grid_world_hand.yaml", exact=True)
    assert found.episodes == 6 * 3 * 4
    assert found.reward_terms["arrived"] > 18
