"""The experiment that lets other people's learners stand beside designs, as far as it goes without them."""

from importlib.util import find_spec

import numpy as np
import pytest

import bbsd
from experiments import learners
from experiments.designs import spec_path


@pytest.mark.skipif(find_spec("stable_baselines3") is not None, reason="stable-baselines3 is installed")
def test_without_the_library_it_says_so(monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["learners"])
    assert learners.main() == learners.MISSING == 2
    assert "pip install stable-baselines3" in capsys.readouterr().err


@pytest.mark.slow
def test_the_steps_of_a_design_are_counted():
    found = learners.designed(spec_path("tasks/cartpole"), 200, 0)
    assert 200 * 8 < found.steps < 200 * 500  # the pole falls after nine steps at the earliest
    assert found.returns.shape == (learners.EPISODES,)


@pytest.mark.slow
def test_learners_are_measured_on_the_episodes_of_an_evaluation(monkeypatch):
    monkeypatch.setattr(learners, "EPISODES", 20)
    path = spec_path("tasks/cartpole_hand")
    world = bbsd.env(path, compiled=False)
    agent = bbsd.Agent(path)

    def choose(observed):
        named = map(world.exchange.named, observed)
        acts = [agent.act({name: known[name] for name in agent.inputs}).number for known in named]
        return world.exchange.choices[acts]

    evaluated = bbsd.evaluate(path, episodes=20, keep_each=True).each.returns
    np.testing.assert_array_equal(learners.measured(path, "sensors", choose), evaluated)
