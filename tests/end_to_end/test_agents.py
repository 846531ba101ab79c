"""Agents that drive other people's environments: the same episodes as `bbsd evaluate` measures, to the last bit."""

import gymnasium
import pytest

import bbsd
from bbsd.environments.lanes.common import seed_of
from bbsd.evaluation import episode_key
from tests.unit.architecture.designs import SPECS


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cartpole_hand", "mountain_car_hand"])
def test_an_agent_in_ones_own_loop_earns_what_is_evaluated(name):
    path = SPECS / "gymnasium" / f"{name}.yaml"
    evaluated = bbsd.evaluate(path, episodes=4, keep_each=True, allow_import=["gymnasium"])
    environment = bbsd.load(path).spec.environment
    outside = environment.outside
    fields = [field.name for field in outside.fields]
    world = gymnasium.make(outside.target, **outside.arguments).unwrapped
    agent, returns = bbsd.Agent(path), []
    for episode in range(4):
        observation, _ = world.reset(seed=seed_of(episode_key(0, episode)))
        agent.reset()
        earned, command = 0.0, 0
        for _ in range(environment.steps):
            act = agent.act(dict(zip(fields, observation, strict=True)))
            command = int(act.sets.get(outside.actions[0], command))
            observation, reward, terminated, truncated, _ = world.step(command)
            earned += float(reward)
            if terminated or truncated:
                break
        returns.append(earned)
    assert returns == list(evaluated.each.returns)
    assert len(set(returns)) > (name != "cartpole_hand")
