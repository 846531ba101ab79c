import numpy as np

from bbsd.evaluation import Agents
from bbsd.solver.champions import no_champions
from tests.unit.solver.problems import guess

PROBLEM, _ = guess()
LAYERS = [0, 1, 2]


def agents(*firsts, structures=None):
    """An agent for each: the first cell of its first behavior, all else alike."""
    first = np.zeros((len(firsts), 4), np.uint8)
    first[:, 0] = firsts
    pools = (first, np.zeros((1, 4), np.uint8), np.ones((1, 1), np.uint8))
    members = np.stack([np.arange(len(firsts)), *np.zeros((2, len(firsts)), np.int64)], axis=1)
    return Agents(pools, members, np.array(structures or [LAYERS] * len(firsts)))


def joined(champions, fitness, *firsts, structures=None):
    return champions.joined(agents(*firsts, structures=structures), np.array(fitness, np.float64))


def told(champions):
    return [
        (int(tables[0]), fitness) for tables, fitness in zip(champions.tables, champions.fitness, strict=True)
    ]


def test_the_fittest_of_all_generations_are_kept_the_fittest_first():
    champions = joined(no_champions(PROBLEM, 3), [1, 5, 3], 0, 1, 2)
    assert told(champions) == [(1, 5), (2, 3), (0, 1)]
    one_more = joined(champions, [4], 3)
    assert told(one_more) == [(1, 5), (3, 4), (2, 3)]


def test_the_same_genotype_is_kept_once_with_its_best_fitness():
    champions = joined(no_champions(PROBLEM, 3), [1, 5, 3], 0, 1, 1)
    assert told(champions) == [(1, 5), (0, 1)]
    assert told(joined(champions, [7, 2], 0, 1)) == [(0, 7), (1, 5)]


def test_agents_that_repeat_the_fittest_leave_room_for_others():
    assert told(joined(no_champions(PROBLEM, 2), [5, 5, 5, 4], 1, 1, 1, 2)) == [(1, 5), (2, 4)]


def test_another_structure_is_another_genotype():
    champions = joined(no_champions(PROBLEM, 3), [1, 2], 1, 1, structures=[[0, 1, 2], [0, 2, 1]])
    assert champions.structures.tolist() == [[0, 2, 1], [0, 1, 2]]


def test_of_equals_the_earlier_is_kept():
    champions = joined(no_champions(PROBLEM, 2), [1, 1], 1, 2)
    assert told(joined(champions, [1, 1], 3, 0)) == [(1, 1), (2, 1)]


def test_champions_are_architectures_again():
    champions = joined(no_champions(PROBLEM, 3), [1, 5], 0, 2)
    best, second = champions.architectures(PROBLEM)
    assert [table.tolist() for table in best.tables] == [[2, 0, 0, 0], [0, 0, 0, 0], [1]]
    assert second.tables[0].tolist() == [0, 0, 0, 0]
    assert best.structure.tolist() == LAYERS


def test_at_first_there_are_none():
    assert no_champions(PROBLEM, 3).architectures(PROBLEM) == []
