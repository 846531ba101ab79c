"""The worlds that are shipped: a task, and the same task with a design made by hand."""

from __future__ import annotations

from pathlib import Path

import pytest
import yaml

import bbsd
from bbsd.architecture import Architecture, given_architecture
from bbsd.compiler import compile_meaning
from bbsd.evaluation import agents_of, interval, returns_of, trace
from bbsd.kernel.keys import keys
from bbsd.report.figures import draw_episode
from bbsd.report.figures.files import color
from bbsd.runs.run import generations, start
from bbsd.solver.paper.settings import settings_of
from bbsd.solver.random_agents import random_agents

SPECS = Path(__file__).parents[2] / "specs"
PAPER = SPECS / "paper"
WORLDS = ("mobile_robot", "pursuit", "forager", "grid_world")
TASKS = tuple(
    f"tasks/{name}"
    for name in ("cartpole", "mountain_car", "acrobot", "door_and_key", "survival", "aggregation")
)

VARIANTS = ("mobile_robot_failing_sonar",)
"""Those for the paper's loop, as they count its generations."""
SHORTER = {"tasks/aggregation": ["environment.steps=40"]}
"""Episodes of twenty robots take seconds without a compiler."""


def uncompiled(name, overrides=()):
    loaded = bbsd.load(SPECS / f"{name}.yaml", set=overrides)
    return compile_meaning(loaded.meaning, lanes=12, compiled=False)


@pytest.mark.parametrize("path", sorted(SPECS.rglob("*.yaml")), ids=lambda path: path.stem)
def test_no_shipped_spec_has_a_mistake(path):
    assert bbsd.check(path) == ()


@pytest.mark.parametrize(
    "path",
    [
        path
        for path in sorted(
            [*SPECS.glob("*.yaml"), *SPECS.glob("tasks/*.yaml"), *SPECS.glob("everyday/*.yaml")]
        )
        if path.stem not in VARIANTS
    ],
    ids=lambda path: path.stem,
)
def test_tasks_leave_the_method_to_whoever_designs_them(path):
    assert "design" not in yaml.safe_load(path.read_text())


@pytest.mark.parametrize("world", WORLDS + TASKS)
def test_a_hand_made_design_adds_only_rules_and_a_structure(world):
    written = yaml.safe_load((SPECS / f"{world}_hand.yaml").read_text())
    assert set(written) == {"bbsd", "name", "extends", "behaviors", "structure"}
    assert all(set(behavior) == {"rules"} for behavior in written["behaviors"].values())


@pytest.mark.parametrize("world", WORLDS + TASKS)
def test_the_hand_made_design_earns_more_than_random_agents(world):
    task, hand = (uncompiled(name, SHORTER.get(world, ())) for name in (world, f"{world}_hand"))
    by_hand = returns_of(hand, agents_of([given_architecture(hand)]), keys(1, 0, 12), 1)
    at_random = returns_of(task, random_agents(task, 2, 12), keys(1, 0, 1), 1)
    assert interval(by_hand.ravel()).low > interval(at_random.ravel()).high


@pytest.mark.parametrize("world", WORLDS)
def test_a_world_is_drawn_from_above_in_the_colors_of_who_controls(world, tmp_path):
    loaded = bbsd.load(SPECS / f"{world}_hand.yaml", set=["environment.steps=15"])
    lived = bbsd.trace(loaded)
    draw_episode(lived, loaded.spec, tmp_path / "world.svg")
    text = (tmp_path / "world.svg").read_text()
    assert "<!-- from above -->" in text
    assert f"in {len(lived.steps)} steps -->" in text
    in_control = {name for robot in lived.controlling for name in robot} - {"nobody"}
    order = [*loaded.spec.behaviors]
    assert all(color(order.index(name)) in text for name in in_control)


def test_every_start_of_the_grid_world_can_be_tried():
    found = bbsd.evaluate(SPECS / "grid_world_hand.yaml", exact=True)
    assert found.episodes == 6 * 3 * 4
    assert found.reward_terms["arrived"] > 18


@pytest.mark.parametrize("path", sorted(PAPER.glob("*.yaml")), ids=lambda path: path.stem)
def test_an_arm_of_the_paper_is_designed(path):
    small = [
        "coevolution.generations=2",
        "coevolution.agents=4",
        "coevolution.population=3",
        "learning.episodes=3",
        "learning.last=3",
    ]
    loaded = bbsd.load(path, set=[*(f"design.{each}" for each in small), "environment.steps=5"])
    problem = compile_meaning(loaded.meaning, lanes=4, compiled=False)
    settings = settings_of(loaded.meaning)
    lived = generations(start(problem, settings, 0, 0), problem, settings, 0)
    lines = [next(lived)[1] for _ in range(2)]
    assert [line["generation"] for line in lines] == [1, 2]
    assert set(lines[-1]["structure"]) == set(loaded.spec.behaviors)


def test_the_arms_differ_from_the_task_in_what_they_say():
    order, rules, value, no_culture, higher = (
        bbsd.load(PAPER / f"object_lifting_{arm}.yaml")
        for arm in ("order", "rules", "value", "no_culture", "robot_1_higher")
    )
    hand = bbsd.load(SPECS / "object_lifting_hand.yaml").spec
    assert order.spec.behaviors == hand.behaviors
    assert order.spec.structure is None
    assert rules.spec.structure == hand.structure
    assert not any(behavior.rules for behavior in rules.spec.behaviors.values())
    assert value.spec.design.sharing == "value"
    assert no_culture.spec.design.culture == "none"
    assert starts_of(higher, "height") == [2.5, 2, 2]


@pytest.mark.parametrize("name", ["abstract", "object_lifting"])
def test_the_paper_s_problems_are_the_tasks_with_its_method(name):
    task, paper = (yaml.safe_load((folder / f"{name}.yaml").read_text()) for folder in (SPECS, PAPER))
    assert paper.pop("design")["method"] == "paper"
    assert paper == task


def starts_of(loaded, name):
    """The values of a state, robot by robot, before anything happened."""
    problem = compile_meaning(loaded.meaning, compiled=False)
    still = trace(problem, idle(problem), key=1, generation=1)
    return [still.values[name, robot, ()][0] for robot in range(still.robots)]


def idle(problem):
    return Architecture(tuple(0 * table.given for table in problem.tables), problem.candidates)


def test_sonars_fail_from_generation_50_on():
    """Half of the episodes have a sonar that reads 0 but for its noise, in all steps."""
    loaded = bbsd.load(SPECS / "mobile_robot_failing_sonar.yaml", set=["environment.steps=20"])
    problem = compile_meaning(loaded.meaning, compiled=False)
    failed = {}
    for generation in (49, 50):
        bad = [failing(problem, key, generation) for key in range(24)]
        failed[generation] = [each for each in bad if each is not None]
    assert failed[49] == []
    assert 6 < len(failed[50]) < 18
    assert len(set(failed[50])) > 3


def failing(problem, key, generation):
    """The sonar that fails in an episode in which the robot stands still; None if none does."""
    episode = trace(problem, idle(problem), key, generation)
    bad = int(episode.values["bad", 0, ()][0])
    near = [k for k in range(8) if max(map(abs, episode.values["sonar", 0, (k,)])) < 0.3]
    assert near == ([] if bad < 0 else [bad])
    return None if bad < 0 else bad
