import numpy as np

from bbsd.evaluation.spread import spread_of, weighted_spread

RETURNS = np.array([4.0, 1.0, 3.0, 2.0, 5.0])


def test_a_spread_has_quantiles_and_the_numbers_of_three_episodes():
    found = spread_of(RETURNS, numbered=True)
    assert (found.worst, found.best) == (1, 5)
    assert found.quantiles == {5: 1.2, 25: 2, 50: 3, 75: 4, 95: 4.8}
    assert found.episodes == {"worst": 1, "median": 2, "best": 4}
    assert spread_of(RETURNS, numbered=False).episodes == {}


def test_a_weighted_spread_is_that_of_as_many_equal_episodes():
    weights = np.array([0.1, 0.5, 0.2, 0.2, 0.0])
    found = weighted_spread(RETURNS, weights)
    assert (found.worst, found.best) == (1, 4)  # what cannot happen is not the best
    assert found.quantiles == {5: 1, 25: 1, 50: 1, 75: 3, 95: 4}
    assert found.episodes == {}
