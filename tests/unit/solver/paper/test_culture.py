import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.language.design import CultureSettings
from bbsd.solver.paper.culture import Culture, draw_memes, empty_culture, take_in, wheel

SETTINGS = CultureSettings(size=2, rate=0.3, scaled=0.9)
A, B, C = [0, 1, 2], [2, 1, 0], [1, 0, 2]


def culture_of(*memes):
    return Culture(np.array([meme for meme, _ in memes]), np.array([fitness for _, fitness in memes]))


def after(culture, *agents):
    structures = np.array([structure for structure, _ in agents])
    taken = take_in(culture, structures, np.array([fitness for _, fitness in agents]), SETTINGS)
    return list(zip(taken.memes.tolist(), taken.fitness.tolist(), strict=True))


def share_of_each(culture, scaled, n_agents=20_000):
    drawn = draw_memes(21, culture, n_agents, scaled)
    return [np.mean(np.all(drawn == meme, axis=1)) for meme in culture.memes]


def test_new_memes_fill_an_empty_culture_in_the_agents_order():
    assert after(empty_culture(3), (A, 1.0), (B, -5.0)) == [(A, 1.0), (B, -5.0)]


def test_a_known_meme_moves_by_the_forgetting_factor():
    # (22): 0.7 * 10 + 0.3 * 20 = 13
    assert after(culture_of((A, 10.0), (B, 5.0)), (A, 20.0)) == [(A, 13.0), (B, 5.0)]


def test_equal_structures_of_one_generation_are_taken_in_one_after_another():
    # first 10 as a new meme, then 0.7 * 10 + 0.3 * 0 = 7, then 0.7 * 7 + 0.3 * 10 = 7.9
    ((meme, fitness),) = after(empty_culture(3), (A, 10.0), (A, 0.0), (A, 10.0))
    assert meme == A
    assert fitness == pytest.approx(7.9, abs=1e-12)


def test_a_fitter_meme_replaces_the_least_fit_in_its_place():
    assert after(culture_of((A, 1.0), (B, 5.0)), (C, 3.0)) == [(C, 3.0), (B, 5.0)]


@pytest.mark.parametrize("fitness", [1.0, 0.5])
def test_a_full_culture_does_not_take_in_what_is_not_strictly_fitter(fitness):
    assert after(culture_of((A, 1.0), (B, 5.0)), (C, fitness)) == [(A, 1.0), (B, 5.0)]


def test_of_equally_unfit_memes_the_first_is_replaced():
    assert after(culture_of((A, 1.0), (B, 1.0)), (C, 2.0)) == [(C, 2.0), (B, 1.0)]


def test_a_bad_generation_makes_a_meme_less_fit_until_it_is_replaced():
    # A falls to 0.7 * 2 + 0.3 * -10 = -1.6, and C with -1 replaces it
    assert after(culture_of((A, 2.0), (B, 5.0)), (A, -10.0), (C, -1.0)) == [(C, -1.0), (B, 5.0)]


def test_taking_in_leaves_the_culture_that_others_draw_from():
    culture = culture_of((A, 1.0), (B, 5.0))
    after(culture, (C, 9.0), (B, 9.0))
    assert culture.memes.tolist() == [A, B]
    assert culture.fitness.tolist() == [1.0, 5.0]


def test_an_empty_generation_changes_nothing():
    taken = take_in(empty_culture(3), np.empty((0, 3), np.int64), np.empty(0), SETTINGS)
    assert taken.memes.shape == (0, 3)
    assert len(taken) == 0


@given(st.lists(st.tuples(st.permutations(range(3)), st.floats(-9, 9)), min_size=1, max_size=30))
def test_a_culture_never_holds_a_meme_twice_or_more_than_its_size(agents):
    memes = [tuple(meme) for meme, _ in after(empty_culture(3), *agents)]
    assert len(memes) == len(set(memes)) <= SETTINGS.size


def test_sectors_of_the_wheel_follow_scaled_fitness():
    # f - min + 0.1 (max - min): 0 + 1, 4 + 1, 10 + 1; ends 1, 6, 17
    np.testing.assert_allclose(wheel(np.array([-5.0, -1.0, 5.0])), [1.0, 6.0, 17.0])


def test_equally_fit_memes_share_the_wheel_equally():
    np.testing.assert_array_equal(wheel(np.array([3.0, 3.0])), [1.0, 2.0])


def test_memes_are_drawn_by_wheel_and_at_random():
    culture = culture_of((A, -5.0), (B, -1.0), (C, 5.0))
    sectors = np.array([1, 5, 11]) / 17
    # 20 000 draws: standard deviation at most 0.5 / sqrt(20 000) = 0.0035
    np.testing.assert_allclose(share_of_each(culture, 1.0), sectors, atol=5 * 0.0035)
    np.testing.assert_allclose(share_of_each(culture, 0.0), 1 / 3, atol=5 * 0.0035)
    np.testing.assert_allclose(share_of_each(culture, 0.4), 0.4 * sectors + 0.6 / 3, atol=5 * 0.0035)


def test_a_single_meme_is_given_to_everyone():
    np.testing.assert_array_equal(draw_memes(2**64 - 1, culture_of((B, 4.0)), 3, 0.9), [B, B, B])


def test_an_agent_s_meme_does_not_depend_on_how_many_are_born():
    culture = culture_of((A, -5.0), (B, -1.0), (C, 5.0))
    np.testing.assert_array_equal(draw_memes(5, culture, 100, 0.9)[:7], draw_memes(5, culture, 7, 0.9))
