"""Episodes of other programs are those of an evaluation."""

import numpy as np

from bbsd.adapters.episodes import drawn_key, key_of
from bbsd.evaluation.streams import evaluation_keys


def test_episodes_are_numbered_as_in_an_evaluation():
    np.testing.assert_array_equal([key_of(4, number) for number in range(5)], evaluation_keys(4, 5))
    assert key_of(4, 0) != key_of(5, 0)


def test_further_episodes_follow_from_the_generator():
    ones, others = (np.random.default_rng(1) for _ in range(2))
    keys = [drawn_key(ones) for _ in range(100)]
    assert len(set(keys)) == 100
    assert keys == [drawn_key(others) for _ in range(100)]
    assert max(keys) > 2**63
