from dataclasses import replace

import numpy as np
import pytest

from bbsd.solver.arena import Arena
from bbsd.solver.methods import society as module
from bbsd.solver.methods.society import (
    LEADERS_MODULE,
    Size,
    agents_of_society,
    composed,
    first_society,
    next_societies,
    next_society,
    society_of,
)
from bbsd.solver.paper.culture import Culture
from bbsd.solver.space import Designs
from tests.unit.solver.problems import guess

SIZE = Size(population=6, paired=12, exchanged=12)


@pytest.fixture(scope="module")
def arena():
    return Arena(guess()[0], 1)


@pytest.fixture
def society(arena):
    return society_of(arena.space.random(11, 6))


def designs(agents):
    return [np.concatenate(agents.architecture(index).tables) for index in range(len(agents))]


def test_the_first_society_is_the_best_of_many_random_agents(arena):
    society = first_society(arena, 11, 6, 300, 10)
    many = arena.means(Designs(society.pools, np.repeat(society.leader.structures, 6, axis=0)), 1, 200)
    assert arena.means(society.leader, 1, 200)[0] > 1.0
    assert many.mean() > arena.means(arena.space.random(5, 100), 1, 20).mean() + 0.2
    assert (society.culture.fitness > 1.0).any()


def test_leader_and_challenger_live_among_the_agents(arena, society):
    agents = agents_of_society(society, arena.space, 3, SIZE)
    assert len(agents) == SIZE.agents == 26
    for index, known in enumerate((society.leader, society.challenger)):
        np.testing.assert_array_equal(designs(agents)[index], known.tables[0])
        np.testing.assert_array_equal(agents.structures[index], known.structures[0])


def test_some_agents_are_the_leader_with_one_module_exchanged(arena, society):
    agents = agents_of_society(society, arena.space, 3, SIZE)
    own = (agents.members == len(society.pools)).sum(axis=1)
    np.testing.assert_array_equal(own, [3, 0] + [0] * 12 + [2] * 12)
    exchanged = agents.members[14:, :2]
    counts = [np.bincount(column[column < 6], minlength=6) for column in exchanged.T]
    np.testing.assert_array_equal(counts, 1)  # each individual of the two behaviors that evolve, once
    assert (agents.members[14:, 2] == len(society.pools)).all()


def test_what_an_exchange_earns_is_the_fitness_of_that_module_alone(arena, society, monkeypatch):
    """The best agent is the leader with individual 4 of `odd`: its partners, the leader's modules, gain nothing."""
    agents = agents_of_society(society, arena.space, 3, SIZE)
    fitness = np.zeros(SIZE.agents)
    lucky = int(np.flatnonzero(agents.members[14:, 0] == 4)[0]) + 14
    fitness[lucky] = 9.0
    shared = []
    original = module.next_pool
    monkeypatch.setattr(module, "next_pool", lambda *args: shared.append(args[2]) or original(*args))
    next_society(society, agents, fitness, arena.space, 8)
    np.testing.assert_array_equal(shared[0], [0, 0, 0, 0, 3, 0])  # 9, 0, 0 are its best three
    np.testing.assert_array_equal(shared[1], np.zeros(6))


@pytest.mark.parametrize(("leader", "challenger", "leads"), [(2.0, 1.0, 0), (1.0, 1.0, 1), (1.0, 2.0, 1)])
def test_a_challenger_leads_when_it_earns_as_much_again(arena, society, leader, challenger, leads):
    """Who earned most by now, 9, is the next challenger, and has to show it once more."""
    agents = agents_of_society(society, arena.space, 3, SIZE)
    fitness = np.zeros(SIZE.agents)
    fitness[:2], fitness[7] = (leader, challenger), 9.0
    after = next_society(society, agents, fitness, arena.space, 8)
    np.testing.assert_array_equal(after.leader.tables[0], designs(agents)[leads])
    np.testing.assert_array_equal(after.challenger.tables[0], designs(agents)[7])
    np.testing.assert_array_equal(after.challenger.structures[0], agents.structures[7])


def test_the_leader_s_modules_enter_the_pools_behind_the_elite(arena, society):
    (after,), _ = next_societies([society], arena, 5, SIZE, 4)
    evolving = arena.space.behavior_of < 2
    np.testing.assert_array_equal(after.pools[LEADERS_MODULE][evolving], after.leader.tables[0][evolving])


def test_societies_side_by_side_do_not_touch_each_other(arena, society):
    other = society_of(arena.space.random(12, 6))
    together, returns = next_societies([society, other], arena, 5, SIZE, 4)
    (alone,), first_returns = next_societies([society], arena, 5, SIZE, 4)
    np.testing.assert_array_equal(returns[0], first_returns[0])
    np.testing.assert_array_equal(together[0].pools, alone.pools)
    np.testing.assert_array_equal(together[0].culture.memes, alone.culture.memes)
    assert (together[1].pools != alone.pools).any()


def test_most_agents_inherit_a_meme_as_it_is(arena, society):
    meme = np.array([[2, 0, 1]])
    cultivated = replace(society, culture=Culture(meme, np.array([1.0])))
    paired = agents_of_society(cultivated, arena.space, 3, Size(6, 1000, 0)).structures[2:]
    unchanged = (paired == meme).all(axis=1).mean()
    assert 0.8 < unchanged < 0.9  # a third of the exchanges puts a behavior where it stands already


def test_structures_that_earn_become_memes(arena, society):
    (after,), _ = next_societies([society], arena, 5, SIZE, 4)
    assert len(after.culture) == module.CULTURE.size
    order = after.challenger.structures[0].tolist()
    assert order in after.culture.memes.tolist()


def test_mutation_stays_at_one_cell_in_n(arena, society, monkeypatch):
    rates = []
    original = module.next_pool
    monkeypatch.setattr(
        module, "next_pool", lambda *args: rates.append(args[-1].soft_mutation) or original(*args)
    )
    next_societies([society], arena, 5, SIZE, 4)
    assert rates == [1 / 4, 1 / 3]


def test_candidates_are_the_leader_and_the_best_individuals_under_the_best_meme(arena, society):
    np.testing.assert_array_equal(composed(society).tables, society.leader.tables)
    cultivated = replace(society, culture=Culture(np.array([[2, 0, 1], [0, 1, 2]]), np.array([1.0, 3.0])))
    candidates = composed(cultivated)
    np.testing.assert_array_equal(candidates.tables[1], society.pools[0])
    assert candidates.structures[1].tolist() == [0, 1, 2]
