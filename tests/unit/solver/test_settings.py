import numpy as np
import pytest

from bbsd.solver.settings import Breeding, Coevolution, Enculturation, Learning, Settings


def test_mutation_follows_table_1():
    defaults = Coevolution()
    assert defaults.hard_mutation[0] == 0.01  # log2(1 + 1) = 1
    assert defaults.hard_mutation[2] == 0.005  # log2(3 + 1) = 2
    assert defaults.hard_mutation[39] == pytest.approx(0.01 / 5.357552, rel=1e-6)  # log2(41)
    assert np.all(defaults.hard_mutation[40:] == 0)  # from generation 41
    np.testing.assert_array_equal(defaults.soft_mutation, 2 * defaults.hard_mutation)


def test_the_learning_rate_follows_table_1():
    rate = Learning().rate
    assert rate[0] == pytest.approx(0.099)  # 0.1 * 0.99
    assert rate[1] == pytest.approx(0.09801)  # 0.1 * 0.99 * 0.99


def test_a_generation_s_genetic_settings_count_generations_from_1():
    assert Coevolution().breeding(3) == Breeding(3, 1, 0.5, 0.005, 0.01)


def test_a_lifetime_is_shorter_where_no_structure_is_learned():
    assert Learning().lifetime(learned=True) == 25
    assert Learning().lifetime(learned=False) == 5


def test_without_a_word_a_run_is_the_paper_s_lifting_experiment():
    settings = Settings()
    assert (settings.sharing, settings.culture, settings.layers) == ("uniform", None, None)
    coevolution = settings.coevolution
    assert (coevolution.generations, coevolution.population, coevolution.agents) == (50, 20, 200)
    assert Enculturation() == Enculturation(size=5, rate=0.3, scaled=0.9)


@pytest.mark.parametrize("schedule", ["hard_mutation", "soft_mutation"])
def test_a_schedule_without_a_value_for_each_generation_is_refused(schedule):
    with pytest.raises(ValueError, match=f"{schedule} must hold one value for each of 50 generations"):
        Coevolution(**{schedule: np.zeros(49)})


def test_a_learning_rate_without_a_value_for_each_episode_is_refused():
    with pytest.raises(ValueError, match="rate must hold one value for each of 100 episodes"):
        Learning(episodes=100)


@pytest.mark.parametrize("last", [0, 26])
def test_the_last_episodes_are_within_the_lifetime(last):
    with pytest.raises(ValueError, match="last must be from 1 to 25"):
        Learning(last=last)
