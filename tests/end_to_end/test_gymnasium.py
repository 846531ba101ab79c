"""The shipped specs of other people's environments: they fit them, and hand-made and designed agents do well there."""

from pathlib import Path

import pytest

import bbsd
from bbsd.api.given.environments import opened_environment
from bbsd.architecture import given_architecture
from bbsd.compiler import compile_meaning
from bbsd.evaluation import agents_of, returns_of
from bbsd.kernel.keys import keys
from bbsd.solver.random_agents import random_agents

SPECS = Path(__file__).parents[2] / "specs" / "gymnasium"
ALLOWED = ("gymnasium", "minigrid", "mpe2")
HAND_MADE = {
    "cartpole": (500, 500), "mountain_car": (-125, -114), "lunar_lander": (100, 300),
    "door_and_key": (0.3, 1.2), "spread": (-12, -4),
}  # fmt: skip
"""What a design made by hand earns on average in a few episodes."""


def problem_of(name, *overrides):
    """A spec of an environment that is stepped, as plain Python."""
    loaded = bbsd.load(SPECS / f"{name}.yaml", set=overrides)
    opened = opened_environment(loaded, allow_import=ALLOWED, by_table=False)
    return compile_meaning(loaded.meaning, compiled=False, lanes=4, stepper=opened.stepper)


@pytest.mark.parametrize("path", sorted(SPECS.glob("*.yaml")), ids=lambda path: path.stem)
def test_a_shipped_spec_fits_its_environment(path):
    assert bbsd.spaces(path, allow_import=ALLOWED).mistakes is None


@pytest.mark.parametrize("path", sorted(SPECS.glob("*_hand.yaml")), ids=lambda path: path.stem)
def test_every_design_by_hand_is_measured(path):
    assert path.stem.removesuffix("_hand") in HAND_MADE


@pytest.mark.parametrize("name", HAND_MADE)
def test_a_design_by_hand_earns_what_is_said_and_more_than_random_agents(name):
    hand, task = problem_of(f"{name}_hand"), problem_of(name)
    by_hand = returns_of(hand, agents_of([given_architecture(hand)]), keys(1, 0, 8), 1)
    at_random = returns_of(task, random_agents(task, 2, 8), keys(1, 0, 1), 1)
    least, most = HAND_MADE[name]
    assert least <= by_hand.mean() <= most
    assert by_hand.mean() > at_random.mean()


@pytest.mark.slow
def test_a_small_budget_keeps_the_pole_up_and_two_processes_design_the_same(tmp_path):
    for folder, jobs in (("one", 1), ("two", 2)):
        bbsd.design(
            SPECS / "cartpole.yaml",
            seed=1,
            out=tmp_path / folder,
            jobs=jobs,
            set=["environment.steps=60", "design.budget=5000"],
            allow_import=ALLOWED,
        )
    one, two = (tmp_path / folder / "architecture.yaml" for folder in ("one", "two"))
    assert one.read_bytes() == two.read_bytes()
    evaluation = bbsd.evaluate(one, episodes=50, allow_import=ALLOWED)
    assert evaluation.mean > 55
