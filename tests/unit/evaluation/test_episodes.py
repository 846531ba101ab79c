import numpy as np
import pytest

from bbsd.evaluation import agents_of, detailed_outcomes, episodes, returns_of
from bbsd.kernel.keys import keys, own_keys
from bbsd.solver.random_agents import random_agents
from tests.unit.problems import RICH, problem_of


@pytest.fixture(scope="module")
def problem():
    return problem_of(RICH, lanes=4)


def test_all_agents_meet_the_same_episodes(problem):
    agents, streams = random_agents(problem, 1, 3), keys(5, 0, 4)
    returns = returns_of(problem, agents, streams, 1)
    assert returns.shape == (3, 4)
    for agent in range(3):
        alone = agents_of([agents.architecture(agent)])
        np.testing.assert_array_equal(returns_of(problem, alone, streams, 1)[0], returns[agent])


def test_agents_may_have_episodes_of_their_own(problem, monkeypatch):
    agents, streams = random_agents(problem, 1, 3), own_keys(5, 3, 4)
    returns = returns_of(problem, agents, streams, 1)
    assert returns.shape == (3, 4)
    for agent in range(3):
        alone = agents_of([agents.architecture(agent)])
        np.testing.assert_array_equal(returns_of(problem, alone, streams[agent], 1)[0], returns[agent])
    monkeypatch.setattr(episodes, "BATCH", 5)
    outcomes = detailed_outcomes(problem, agents, streams, 1)
    np.testing.assert_array_equal(np.concatenate([each.returns for each in outcomes]), returns.ravel())


def test_more_episodes_begin_with_the_same(problem):
    agents = random_agents(problem, 1, 2)
    some, more = (returns_of(problem, agents, keys(5, 0, count), 1) for count in (3, 6))
    np.testing.assert_array_equal(more[:, :3], some)


@pytest.mark.parametrize("batch", [1, 5, 12])
def test_batches_change_nothing(problem, batch, monkeypatch):
    agents, streams = random_agents(problem, 1, 3), keys(5, 0, 4)
    expected = returns_of(problem, agents, streams, 1)
    monkeypatch.setattr(episodes, "BATCH", batch)
    np.testing.assert_array_equal(returns_of(problem, agents, streams, 1), expected)
    outcomes = list(detailed_outcomes(problem, agents, streams, 1))
    assert [len(outcome.returns) for outcome in outcomes] == [batch] * (12 // batch) + [12 % batch] * (
        12 % batch > 0
    )
    np.testing.assert_array_equal(np.concatenate([each.returns for each in outcomes]), expected.ravel())


def test_agents_are_taken_by_index_and_given_other_structures(problem):
    agents = random_agents(problem, 1, 3)
    chosen = agents[np.array([2, 0, 2])]
    assert len(chosen) == 3
    np.testing.assert_array_equal(chosen.members, agents.members[[2, 0, 2]])
    np.testing.assert_array_equal(chosen.structures, agents.structures[[2, 0, 2]])
    turned = agents.with_structures(agents.structures[:, ::-1])
    np.testing.assert_array_equal(turned.architecture(1).structure, agents.structures[1, ::-1])
    np.testing.assert_array_equal(turned.architecture(1).tables[0], agents.pools[0][1])


def test_architectures_are_agents_of_their_own(problem):
    agents = random_agents(problem, 1, 3)
    again = agents_of([agents.architecture(agent) for agent in range(3)])
    for found, expected in zip(again.pools, agents.pools, strict=True):
        np.testing.assert_array_equal(found, expected)
    np.testing.assert_array_equal(again.structures, agents.structures)
