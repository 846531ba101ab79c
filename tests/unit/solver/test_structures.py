from collections import Counter
from itertools import permutations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.solver.structures import (
    OPEN,
    candidates_for,
    random_structures,
    search_exact,
    search_sampled,
)

VALUES = st.one_of(st.integers(-2, 2).map(float), st.floats(-1e3, 1e3))


def keys_of(n_agents, seed=1):
    return np.random.default_rng(seed).integers(0, 2**64, n_agents, dtype=np.uint64)


def all_structures(layers, candidates):
    """Every structure that the layers allow."""
    holes = np.flatnonzero(layers == OPEN)
    for filling in permutations(candidates.tolist(), len(holes)):
        structure = layers.copy()
        structure[holes] = filling
        yield structure


def value_of(values, structure):
    return sum(values[layer, behavior] for layer, behavior in enumerate(structure))


@st.composite
def problems(draw, n_agents=3):
    """Layers, candidates, present structures and Ṽ of some agents."""
    n_behaviors = draw(st.integers(1, 5))
    behaviors = draw(st.permutations(range(n_behaviors)))
    n_layers = draw(st.integers(1, n_behaviors))
    is_open = draw(st.lists(st.booleans(), min_size=n_layers, max_size=n_layers))
    layers = np.where(is_open, OPEN, behaviors[:n_layers])
    candidates = candidates_for(layers, n_behaviors)
    present = random_structures(keys_of(n_agents, draw(st.integers(0, 99))), layers, candidates)
    n_values = n_agents * n_layers * n_behaviors
    values = draw(st.lists(VALUES, min_size=n_values, max_size=n_values))
    return layers, candidates, present, np.array(values).reshape(n_agents, n_layers, n_behaviors)


def assert_respects(structures, layers, candidates):
    for structure in structures:
        assert len(set(structure.tolist())) == len(layers)
        assert np.all((structure == layers) | (layers == OPEN))
        assert set(structure[layers == OPEN].tolist()) <= set(candidates.tolist())


def test_candidates_are_the_behaviors_that_no_layer_names():
    np.testing.assert_array_equal(candidates_for(np.array([OPEN, 3, OPEN]), 5), [0, 1, 2, 4])


def test_more_open_layers_than_behaviors_are_refused():
    with pytest.raises(ValueError, match="3 open layers, but only 2 behaviors"):
        candidates_for(np.array([OPEN, 1, OPEN, OPEN]), 3)


@given(problems(), st.integers(0, 2**32))
def test_random_structures_keep_given_layers_and_use_a_behavior_once(problem, seed):
    layers, candidates, _, _ = problem
    assert_respects(random_structures(keys_of(20, seed), layers, candidates), layers, candidates)


def test_random_structures_are_uniform():
    layers = np.array([OPEN, 2, OPEN])
    drawn = random_structures(keys_of(12_000), layers, candidates_for(layers, 5))
    counts = Counter(map(tuple, drawn.tolist()))
    # 4 * 3 = 12 structures, 1000 expected of each, standard deviation 30.3
    assert len(counts) == 12
    assert all(abs(count - 1000) < 5 * 30.3 for count in counts.values())


def test_an_agent_s_draws_do_not_depend_on_the_batch_it_is_in():
    layers, keys = np.full(5, OPEN), keys_of(30)
    candidates = candidates_for(layers, 7)
    present = random_structures(keys, layers, candidates)
    np.testing.assert_array_equal(random_structures(keys[10:20], layers, candidates), present[10:20])
    values = np.random.default_rng(2).normal(size=(30, 5, 7))
    whole = search_sampled(keys, values, present, layers, candidates, 20)
    part = search_sampled(keys[10:20], values[10:20], present[10:20], layers, candidates, 20)
    np.testing.assert_array_equal(part, whole[10:20])


@given(problems(), st.integers(0, 2**32), st.integers(0, 8))
def test_sampled_search_keeps_the_present_structure_or_takes_a_better_one(problem, seed, n_random):
    layers, candidates, present, values = problem
    before = present.copy()
    chosen = search_sampled(keys_of(3, seed), values, present, layers, candidates, n_random)
    np.testing.assert_array_equal(present, before)
    assert_respects(chosen, layers, candidates)
    for agent in range(3):
        gain = value_of(values[agent], chosen[agent]) - value_of(values[agent], present[agent])
        assert np.array_equal(chosen[agent], present[agent]) or gain > -1e-9


def test_sampled_search_finds_the_best_of_few_structures():
    layers = np.full(3, OPEN)
    candidates = candidates_for(layers, 3)
    values = np.random.default_rng(3).normal(size=(200, 3, 3))
    present = np.tile(candidates, (200, 1))
    # 6 structures: 100 random ones miss the best with probability (5 / 6)**100 = 1e-8
    sampled = search_sampled(keys_of(200), values, present, layers, candidates, 100)
    np.testing.assert_array_equal(sampled, search_exact(values, present, layers, candidates))


def test_sampled_search_tries_as_many_random_structures_as_it_is_told():
    layers = np.full(3, OPEN)
    candidates = candidates_for(layers, 3)
    n_agents = 20_000
    values = np.zeros((n_agents, 3, 3))
    values[:, 0, 2] = values[:, 1, 1] = values[:, 2, 0] = 1.0  # [2, 1, 0] is worth 3
    present = np.tile(candidates, (n_agents, 1))
    chosen = search_sampled(keys_of(n_agents), values, present, layers, candidates, 4)
    found = np.mean(np.all(chosen == [2, 1, 0], axis=1))
    # 1 - (5 / 6)**4 = 0.518, standard deviation 0.5 / sqrt(20 000) = 0.0035
    assert found == pytest.approx(1 - (5 / 6) ** 4, abs=5 * 0.0035)


def test_where_nothing_is_known_yet_the_meme_stays():
    layers = np.full(4, OPEN)
    candidates = candidates_for(layers, 6)
    memes = random_structures(keys_of(50), layers, candidates)
    values = np.zeros((50, 4, 6))
    np.testing.assert_array_equal(
        search_sampled(keys_of(50, 2), values, memes, layers, candidates, 20), memes
    )
    np.testing.assert_array_equal(search_exact(values, memes, layers, candidates), memes)


@given(problems())
def test_exact_search_is_as_good_as_the_best_of_all_structures(problem):
    layers, candidates, present, values = problem
    chosen = search_exact(values, present, layers, candidates)
    assert_respects(chosen, layers, candidates)
    for agent in range(3):
        best = max(value_of(values[agent], structure) for structure in all_structures(layers, candidates))
        assert value_of(values[agent], chosen[agent]) >= best - 1e-9


def test_exact_search_keeps_the_present_structure_on_ties():
    layers = np.full(2, OPEN)
    values = np.array([[[1.0, 2.0], [3.0, 4.0]]])  # 1 + 4 = 2 + 3
    for present in ([0, 1], [1, 0]):
        chosen = search_exact(values, np.array([present]), layers, candidates_for(layers, 2))
        np.testing.assert_array_equal(chosen, [present])


def test_given_layers_are_left_out_of_the_search():
    layers = np.array([2, OPEN, OPEN])
    values = np.zeros((1, 3, 4))
    values[0, 1, 2] = values[0, 2, 2] = 100.0  # behavior 2 would be best elsewhere, but is given
    values[0, 1, 3], values[0, 2, 0] = 5.0, 1.0
    present = np.array([[2, 0, 1]])
    np.testing.assert_array_equal(search_exact(values, present, layers, np.array([0, 1, 3])), [[2, 3, 0]])
