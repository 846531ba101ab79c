"""The worlds that are shipped: a task, and the same task with a design made by hand."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

import bbsd
from bbsd.architecture import given_architecture
from bbsd.compiler import compile_meaning
from bbsd.evaluation import agents_of, interval, returns_of
from bbsd.kernel.keys import keys
from bbsd.report.figures import episode
from bbsd.report.figures.files import color
from bbsd.solver.random_agents import random_agents

SPECS = Path(__file__).parents[2] / "specs"
WORLDS = ("mobile_robot", "pursuit", "forager", "grid_world")


def uncompiled(name):
    return compile_meaning(bbsd.load(SPECS / f"{name}.yaml").meaning, lanes=12, compiled=False)


@pytest.mark.parametrize("name", sorted(path.stem for path in SPECS.glob("*.yaml")))
def test_no_shipped_spec_has_a_mistake(name):
    assert bbsd.check(SPECS / f"{name}.yaml") == ()


@pytest.mark.parametrize("world", WORLDS)
def test_a_hand_made_design_adds_only_rules_and_a_structure(world):
    written = yaml.safe_load((SPECS / f"{world}_hand.yaml").read_text())
    assert set(written) == {"bbsd", "name", "extends", "behaviors", "structure"}
    assert all(set(behavior) == {"rules"} for behavior in written["behaviors"].values())


@pytest.mark.parametrize("world", WORLDS)
def test_the_hand_made_design_earns_more_than_random_agents(world):
    task, hand = (uncompiled(name) for name in (world, f"{world}_hand"))
    by_hand = returns_of(hand, agents_of([given_architecture(hand)]), keys(1, 0, 12), 1)
    at_random = returns_of(task, random_agents(task, 2, 12), keys(1, 0, 1), 1)
    assert interval(by_hand.ravel()).low > interval(at_random.ravel()).high


@pytest.mark.parametrize("world", WORLDS)
def test_a_world_is_drawn_from_above_in_the_colors_of_who_controls(world, tmp_path):
    loaded = bbsd.load(SPECS / f"{world}_hand.yaml", overrides=["environment.steps=15"])
    lived = bbsd.trace(loaded)
    episode(lived, loaded.spec, tmp_path / "world.svg")
    text = (tmp_path / "world.svg").read_text()
    assert f"<!-- from above, {len(lived.steps)} steps -->" in text
    in_control = {name for robot in lived.controlling for name in robot} - {"nobody"}
    order = [*loaded.spec.behaviors]
    assert all(color(order.index(name)) in text for name in in_control)


def test_every_start_of_the_grid_world_can_be_tried():
    found = bbsd.evaluate(SPECS / "grid_world_hand.yaml", exact=True)
    assert found.episodes == 6 * 3 * 4
    assert found.reward_terms["arrived"] > 18
