"""Agents that drive worlds, other people's and our own: what they earn is what is evaluated, to the last bit."""

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


@pytest.mark.slow
@pytest.mark.parametrize("name", ["object_lifting_hand", "forager_hand"])
def test_agents_in_our_own_worlds_earn_what_is_evaluated(name):
    path = SPECS / f"{name}.yaml"
    evaluated = bbsd.evaluate(path, episodes=3, keep_each=True)
    assert own_returns(path, 3) == list(evaluated.each.returns)


@pytest.mark.slow
def test_an_agent_of_a_design_earns_what_is_evaluated(tmp_path):
    bbsd.design(SPECS / "object_lifting.yaml", seed=1, out=tmp_path / "run", set=["design.budget=5000"])
    evaluated = bbsd.evaluate(tmp_path / "run", episodes=3, keep_each=True)
    assert own_returns(tmp_path / "run", 3) == list(evaluated.each.returns)


def own_returns(design, episodes):
    """The returns of episodes in the world of a design, each of whose robots is driven by an agent."""
    world, team = bbsd.env(design, api="pettingzoo"), bbsd.Agent.team(design, not_finite="count")
    exchange, returns = world.exchange, []
    for episode in range(episodes):
        observed, info = world.reset(seed=episode)[0], {}
        for agent in team:
            agent.reset()
        while world.agents:
            actions = {
                name: exchange.choices[agent.act(exchange.named(observed[name])).number]
                for name, agent in zip(world.agents, team, strict=True)
            }
            observed, _, _, _, info = world.step(actions)
        returns.append(info["robot_0"]["return"])
    return returns
