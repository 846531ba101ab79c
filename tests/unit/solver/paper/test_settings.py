import numpy as np
import pytest

from bbsd.language.design import CultureSettings
from bbsd.solver.paper.genetics import Breeding
from bbsd.solver.paper.settings import settings_of
from tests.unit.architecture.designs import meaning_of, shipped
from tests.unit.compiler.twins import CORRIDOR_OUTSIDE

SMALL = """
bbsd: 1
name: small
environment: {steps: 1, state: {x: 0}}
behaviors:
  a: {actions: {do: {x: 1}}}
  b: {actions: {do: {x: 2}}}
reward: {x: x}
"""


def settings(design="", structure=""):
    return settings_of(meaning_of(f"{SMALL}{structure}\ndesign: {{{design}}}\n"))


def test_mutation_follows_table_1():
    rates = settings().rates
    assert rates.hard_mutation[0] == 0.01  # log2(1 + 1) = 1
    assert rates.hard_mutation[2] == 0.005  # log2(3 + 1) = 2
    assert rates.hard_mutation[39] == pytest.approx(0.01 / 5.357552, rel=1e-6)  # log2(41)
    assert not any(rates.hard_mutation[40:])  # from generation 41
    np.testing.assert_array_equal(rates.soft_mutation, 2 * np.array(rates.hard_mutation))


def test_mutation_of_the_abstract_problem_ends_at_generation_180():
    rates = settings_of(meaning_of(shipped("paper/abstract"))).rates
    assert len(rates.hard_mutation) == 200
    assert rates.hard_mutation[178] > 0
    assert not any(rates.hard_mutation[179:])


def test_the_learning_rate_follows_table_1():
    rate = settings().rates.learning
    assert rate[0] == pytest.approx(0.099)  # 0.1 * 0.99
    assert rate[1] == pytest.approx(0.09801)  # 0.1 * 0.99 * 0.99


def test_a_generation_s_genetic_settings_count_generations_from_1():
    assert settings().breeding(3) == Breeding(
        tournament=3, elites=1, crossover=0.5, children=1, hard_mutation=0.005, soft_mutation=0.01
    )


def test_without_a_word_a_run_is_the_paper_s_lifting_experiment():
    found = settings()
    assert (found.sharing, found.culture) == ("uniform", CultureSettings(size=5, rate=0.3, scaled=0.9))
    evolved, learning = found.coevolution, found.learning
    assert (evolved.generations, evolved.population, evolved.agents) == (50, 20, 200)
    assert (evolved.tournament, evolved.elites, evolved.crossover) == (3, 1, 0.5)
    assert (found.learned, learning.episodes, learning.last) == (True, 25, 5)
    assert (learning.search, learning.candidates) == ("sampled", 20)


def test_where_the_structure_is_given_a_lifetime_is_its_last_episodes():
    found = settings("learning: {episodes: 25, last: 7}", "structure: [a, b]")
    assert (found.learned, found.learning.episodes, found.learning.last) == (False, 7, 7)
    assert found.culture is None


@pytest.mark.parametrize("structure", ["", "structure: [a, b]", "structure: [open]", "structure: [a]"])
def test_there_is_a_rate_for_every_episode(structure):
    for design in ("learning: {episodes: 3, last: 3}", "learning: {episodes: 7, last: 3}"):
        found = settings(design, structure)
        assert len(found.rates.learning) >= found.learning.episodes


def test_half_a_structure_is_learned_where_there_is_a_choice():
    assert settings(structure="structure: [open]").learned  # by a or b
    assert not settings(structure="structure: [a, open]").learned  # only b is left


def test_culture_may_be_none():
    assert settings("culture: none").culture is None


def test_elites_are_no_more_than_the_population():
    assert settings("method: auto, coevolution: {population: 4, elites: 9}").coevolution.elites == 4


def test_fewer_agents_and_shorter_lifetimes_leave_all_else_as_it_is():
    whole = settings()
    reduced = whole.reduced(2, 1, elites=0)
    assert (reduced.coevolution.agents, reduced.learning.episodes, reduced.learning.last) == (2, 1, 1)
    assert (reduced.coevolution.population, reduced.coevolution.elites) == (20, 0)
    more = whole.reduced(10_000, 10_000)
    assert (more.coevolution, more.learning) == (whole.coevolution, whole.learning)


def test_where_python_steps_the_environment_fewer_episodes_choose_and_judge_unless_they_are_given():
    fewer = settings_of(meaning_of(CORRIDOR_OUTSIDE)).answer
    assert (fewer.episodes, fewer.judged) == (2_000, 1_000)
    given = settings_of(meaning_of(f"{CORRIDOR_OUTSIDE}\ndesign: {{answer: {{judged: 5000}}}}\n")).answer
    assert (given.episodes, given.judged) == (2_000, 5_000)
    assert settings().answer.judged == 5_000
