import numpy as np
import pytest

from bbsd.evaluation import (
    PairedEpisodes,
    RewardNotFinite,
    agents_of,
    episode_key,
    episodes,
    evaluation_keys,
    interval,
    paired_episodes,
    returns_of,
)
from bbsd.solver.random_agents import random_agents
from tests.unit.problems import RICH, problem_of

KEYS = evaluation_keys(0, 6)


@pytest.fixture(scope="module")
def problem():
    return problem_of(RICH)


@pytest.fixture(scope="module")
def agents(problem):
    return random_agents(problem, 3, 4)


def test_every_design_faces_the_same_episodes(problem, agents):
    paired = paired_episodes(problem, agents, KEYS, 1)
    assert len(paired) == 4
    np.testing.assert_array_equal(paired.returns, returns_of(problem, agents, KEYS, 1))
    assert not paired.terms
    same = paired_episodes(problem, agents[np.array([2, 2])], KEYS, 1)
    assert not (same.returns[0] - same.returns[1]).any()
    assert same.difference(1).mean == same.difference(1).low == same.difference(1).high == 0


@pytest.mark.parametrize("batch", [1, 5, 4000])
def test_terms_add_up_to_the_returns_in_batches_of_any_size(problem, agents, batch, monkeypatch):
    monkeypatch.setattr(episodes, "BATCH", batch)
    paired = paired_episodes(problem, agents, KEYS, 1, with_terms=True)
    np.testing.assert_array_equal(paired.returns, returns_of(problem, agents, KEYS, 1))
    assert list(paired.terms) == ["near", "level"]
    np.testing.assert_allclose(sum(paired.terms.values()), paired.returns, rtol=0, atol=1e-12)


def test_differences_are_those_of_pairs(problem, agents):
    paired = paired_episodes(problem, agents, KEYS, 1, with_terms=True)
    assert paired.difference(3, 1) == interval(paired.returns[3] - paired.returns[1])
    assert paired.difference(3) == interval(paired.returns[3] - paired.returns[0])
    by_term = [values[3].mean() - values[1].mean() for values in paired.terms.values()]
    assert sum(by_term) == pytest.approx(paired.difference(3, 1).mean)


def test_designs_of_several_problems_are_put_side_by_side():
    ours = PairedEpisodes(np.array([[1.0, 2.0]]), {"near": np.array([[1.0, 2.0]])})
    theirs = PairedEpisodes(np.array([[4.0, 6.0]]), {"far": np.array([[4.0, 6.0]])})
    both = ours.joined(theirs)
    assert both.returns.tolist() == [[1.0, 2.0], [4.0, 6.0]]
    assert {name: values.tolist() for name, values in both.terms.items()} == {
        "near": [[1.0, 2.0], [0.0, 0.0]],
        "far": [[0.0, 0.0], [4.0, 6.0]],
    }
    assert both.difference(1) == interval(np.array([3.0, 4.0]))
    with pytest.raises(ValueError, match="dimension"):
        ours.joined(PairedEpisodes(np.zeros((1, 3)), {}))


def test_an_error_names_the_design_and_the_episode():
    text = RICH.replace("level: -spread", "level: 1 / (0 if n == 0 and step == 12 else 1)")
    problem = problem_of(text)
    agents = random_agents(problem, 3, 6)
    with pytest.raises(RewardNotFinite) as caught:
        paired_episodes(problem, agents, evaluation_keys(0, 40), 1, labels=list("abcdef"))
    assert caught.value.term == "level"
    assert caught.value.step == 12
    assert caught.value.episode.startswith("episode ")
    assert caught.value.episode[-3:] in {f", {label}" for label in "abcdef"}
    design = "abcdef".index(caught.value.episode[-1])
    number = int(caught.value.episode.split()[1].rstrip(","))
    alone = agents_of([agents.architecture(design)])
    with pytest.raises(RewardNotFinite):
        returns_of(problem, alone, evaluation_keys(0, number)[-1:], 1)


def test_episodes_are_named_by_the_seed_and_their_number():
    assert evaluation_keys(7, 3).tolist() == [episode_key(7, number) for number in range(3)]
    assert evaluation_keys(8, 3).tolist() != evaluation_keys(7, 3).tolist()


def test_rewards_of_others_need_not_be_finite():
    text = RICH.replace("level: -spread", "level: 1 / (0 if n == 0 and step == 12 else 1)")
    problem = problem_of(text)
    agents, keys = random_agents(problem, 3, 6), evaluation_keys(0, 40)
    returns = returns_of(problem, agents, keys, 1, all_finite=False)
    finite = np.isfinite(returns).all(axis=1)
    sound, broken = np.flatnonzero(finite)[0], np.flatnonzero(~finite)[0]
    chosen = agents[np.array([sound, broken])]
    paired = paired_episodes(problem, chosen, keys, 1, all_finite=False)
    np.testing.assert_array_equal(paired.returns, returns[[sound, broken]])
    assert np.isnan(paired.difference(1).mean)
    assert np.isnan(paired.difference(1).low)
    assert paired.difference(1).count == 40
    with pytest.raises(RewardNotFinite):
        paired_episodes(problem, chosen[np.array([1, 0])], keys, 1, all_finite=False)
