import numpy as np
import pytest

from bbsd.evaluation import NoSuchEpisode, chosen_episode

RETURNS = np.array([3.0, -1.0, 7.0, 2.0, -1.0, 7.0])


@pytest.mark.parametrize(("which", "number"), [("worst", 1), ("best", 2), ("median", 0), (4, 4)])
def test_an_episode_is_chosen_by_its_return_the_first_of_equals(which, number):
    assert chosen_episode(RETURNS, which) == number


def test_the_median_of_an_odd_number_is_the_middle_one():
    assert chosen_episode(np.array([5.0, 1.0, 3.0]), "median") == 2


@pytest.mark.parametrize("number", [-1, 6])
def test_an_episode_that_does_not_exist_is_refused(number):
    with pytest.raises(NoSuchEpisode, match=f"no episode {number}: the last one is 5"):
        chosen_episode(RETURNS, number)
