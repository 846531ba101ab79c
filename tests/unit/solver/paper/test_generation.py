from itertools import pairwise

import numpy as np
import pytest

from bbsd.solver.paper import generation as module
from bbsd.solver.paper import sharing
from bbsd.solver.paper.generation import initial_state, initial_structures, next_generation, share
from bbsd.solver.paper.lifetime import Lifetimes
from tests.unit.problems import problem_of
from tests.unit.solver.problems import guess

KEY = 77


def generations(problem, settings, number):
    """The states and the censuses of the first generations; the first state is the beginning."""
    states, censuses = [initial_state(problem, settings, KEY)], []
    for _ in range(number):
        state, census = next_generation(states[-1], problem, settings, KEY)
        states.append(state)
        censuses.append(census)
    return states, censuses


def same(first, second):
    pools = zip(first.pools, second.pools, strict=True)
    return all((a == b).all() for a, b in pools) and all(
        np.array_equal(getattr(first.champions, name), getattr(second.champions, name))
        for name in ("tables", "structures", "fitness")
    )


def test_a_run_begins_with_random_pools_and_nothing_learned():
    problem, settings = guess()
    state = initial_state(problem, settings, KEY)
    assert [len(pool) for pool in state.pools] == [5, 5, 1]  # nothing of the third is open
    assert state.generation == 0
    assert (len(state.culture), len(state.champions.fitness)) == (0, 0)


def test_the_first_generation_has_the_first_pools():
    problem, settings = guess()
    (before, after), _ = generations(problem, settings, 1)
    for first, lived in zip(before.pools, after.pools, strict=True):
        np.testing.assert_array_equal(first, lived)
    assert after.generation == 1


def test_later_generations_keep_the_best_individual_in_the_first_slot():
    problem, settings = guess()
    states, _ = generations(problem, settings, 4)
    for before, after in pairwise(states[1:]):
        for behavior in range(2):
            best = np.argmax(before.fitness[behavior])
            np.testing.assert_array_equal(after.pools[behavior][0], before.pools[behavior][best])


def test_given_cells_stay_through_evolution():
    problem, settings = guess()
    states, _ = generations(problem, settings, 4)
    assert all((state.pools[1][:, 2] == 2).all() and (state.pools[2] == 1).all() for state in states)
    assert (states[-1].pools[0] != states[0].pools[0]).any()


def test_a_behavior_that_the_structure_leaves_out_does_not_evolve():
    problem, settings = guess("structure: [odd]")
    states, _ = generations(problem, settings, 3)
    assert all(len(state.pools[1]) == 1 for state in states)
    np.testing.assert_array_equal(states[-1].pools[1], states[0].pools[1])


def test_memes_are_drawn_from_the_culture_as_it_stood_and_taken_in_at_the_end(monkeypatch):
    problem, settings = guess()
    cultures, told = [], []
    draw, take_in = module.draw_memes, module.take_in

    def drawing(key, culture, *rest):
        cultures.append(("drawn", len(culture)))
        return draw(key, culture, *rest)

    def taking(culture, structures, *rest):
        taken = take_in(culture, structures, *rest)
        cultures.append(("taken in", len(culture)))
        told.append((structures, taken))
        return taken

    monkeypatch.setattr(module, "draw_memes", drawing)
    monkeypatch.setattr(module, "take_in", taking)
    states, censuses = generations(problem, settings, 3)
    sizes = [len(state.culture) for state in states]
    assert sizes[0] == 0
    assert sizes[1] > 0
    assert cultures == [
        ("taken in", 0),  # in the first generation there is nothing to draw
        *(("drawn", sizes[1]), ("taken in", sizes[1])),
        *(("drawn", sizes[2]), ("taken in", sizes[2])),
    ]
    for (structures, taken), census, state in zip(told, censuses, states[1:], strict=True):
        np.testing.assert_array_equal(structures, census.structures)  # T*, the last episode's
        assert taken is state.culture


def test_the_newborn_follow_memes_or_have_random_structures():
    problem, settings = guess()
    states, _ = generations(problem, settings, 1)
    culture = states[1].culture
    memes = {tuple(meme) for meme in culture.memes.tolist()}
    assert {
        tuple(structure) for structure in initial_structures(culture, problem, settings, 1, 50).tolist()
    } <= memes
    without = initial_structures(states[0].culture, problem, settings, 1, 50)
    assert len({tuple(structure) for structure in without.tolist()}) == 6  # all orders


def test_without_culture_nothing_is_handed_on():
    problem, settings = guess(culture="none")
    states, _ = generations(problem, settings, 2)
    assert len(states[2].culture) == 0
    assert (
        len(
            {
                tuple(structure)
                for structure in initial_structures(states[2].culture, problem, settings, 1, 50).tolist()
            }
        )
        == 6
    )


def test_a_given_structure_is_everybody_s_and_no_culture():
    problem, settings = guess("structure: [even, odd]")
    states, censuses = generations(problem, settings, 2)
    assert all((census.structures == [0, 1]).all() for census in censuses)
    assert len(states[2].culture) == 0


@pytest.mark.parametrize("policy", ["uniform", "value", "difference"])
def test_fitness_is_shared_by_the_policy_of_the_spec(policy):
    _, settings = guess(sharing=policy)
    rng = np.random.default_rng(1)
    fitness, values = rng.normal(size=6), rng.normal(size=(6, 3, 3))
    who = rng.integers(0, 5, (6, 3))
    differences = rng.normal(size=(6, 3))
    lives = Lifetimes(
        np.zeros((6, 4)),
        np.zeros((6, 3), np.int64),
        values,
        differences if policy == "difference" else None,
    )
    expected = {
        "uniform": sharing.uniform(fitness, who, 5),
        "value": sharing.value_based(values, who, 5),
        "difference": sharing.difference_based(differences, who, 5),
    }[policy]
    np.testing.assert_array_equal(share(fitness, lives, who, settings), expected)


def test_the_policies_are_not_the_same_run():
    uniform, value = (generations(*guess(sharing=policy), 1)[0][1] for policy in ("uniform", "value"))
    assert not np.array_equal(uniform.fitness, value.fitness)
    assert same(uniform, value)  # they differ only in what they hand on


def test_a_census_tells_fitness_of_the_last_episodes_and_of_the_lifetime():
    problem, settings = guess()
    _, [census] = generations(problem, settings, 1)
    assert census.fitness.shape == census.lifetime_fitness.shape == (12,)
    assert set((2 * census.fitness).tolist()) <= set(range(-4, 5))  # the mean of 2 episodes of 2 steps
    assert set((4 * census.lifetime_fitness).tolist()) <= set(range(-8, 9))


def test_another_key_is_another_run():
    problem, settings = guess()
    state = initial_state(problem, settings, KEY)
    first, again, other = (next_generation(state, problem, settings, key)[0] for key in (KEY, KEY, KEY + 1))
    assert same(first, again)
    assert not same(first, other)


def test_constants_follow_the_generation():
    text = """
    bbsd: 1
    name: late
    constants: {worth: "1 if generation < 3 else 100"}
    environment: {steps: 1, state: {x: 0}}
    behaviors: {b: {inputs: {never: x > 0}, actions: {a: {x: 1}}, rules: [{when: {never: false}, do: a}]}}
    reward: {x: worth * x}
    """
    problem, (_, settings) = problem_of(text), guess("structure: [odd]")
    _, censuses = generations(problem, settings, 4)
    assert [census.fitness.max() for census in censuses] == [1, 1, 100, 100]
