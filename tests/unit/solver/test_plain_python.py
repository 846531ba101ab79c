"""The solver's compiled functions give the same bits as plain Python, on keys of all 64 bits."""

import json
import os
import subprocess
import sys
from pathlib import Path

import numpy as np

import bbsd
from bbsd.kernel.keys import keys
from bbsd.solver.draws import marks
from bbsd.solver.methods.credit import credit_backwards, learn_values, perturbed_tables, rates_between
from bbsd.solver.methods.distribution import draw_choices, draw_hands
from bbsd.solver.methods.joint import deal
from bbsd.solver.paper.culture import Culture, draw_memes
from bbsd.solver.paper.estimates import update_values
from bbsd.solver.paper.genetics import OPEN_CELL, expected_fitness, next_pool, random_pool
from bbsd.solver.paper.pairing import members
from bbsd.solver.structures import (
    OPEN,
    candidates_for,
    random_structures,
    search_exact,
    search_sampled,
)
from tests.unit.solver.problems import BREEDING

KEYS = [0, 3, 2**63 - 1, 2**63, 2**64 - 1]


def structures_learned():
    rng = np.random.default_rng(1)
    keys = np.concatenate([np.array(KEYS, np.uint64), rng.integers(0, 2**64, 7, dtype=np.uint64)])
    layers = np.array([OPEN, 4, OPEN, OPEN])
    candidates = candidates_for(layers, 6)
    first = random_structures(keys, layers, candidates)
    values = np.round(rng.normal(size=(12, 4, 6)), 1)  # rounded: with ties
    sampled = search_sampled(keys, values, first, layers, candidates, 5)
    exact = search_exact(values, first, layers, candidates)
    update_values(values, sampled, rng.normal(size=(12, 7)), 0.3)
    return [first, sampled, exact, values]


def pools_bred(key):
    given_cells = np.array([OPEN_CELL, 1, OPEN_CELL, OPEN_CELL], np.uint8)
    pool = random_pool(key, 6, given_cells, 3)
    fitness = np.array([0.0, 2.0, 1.0, -np.inf, 2.0, 1.0])
    breeding = BREEDING._replace(children=2, hard_mutation=0.4, soft_mutation=0.3)
    return [
        pool,
        expected_fitness(key, fitness, breeding),
        next_pool(key, pool, fitness, 3, given_cells, breeding),
    ]


def designs_drawn(key):
    choices = np.array([[0.2, 0.5, 0.3], [0.9, 0.1, 0.0]])
    which = np.array([3, 0, 2**40])
    cells, hands = np.empty((3, 2), np.uint8), np.empty((3, 2), np.int64)
    draw_choices(np.uint64(key), which, np.cumsum(choices, axis=1), cells)
    draw_hands(np.uint64(key), which, choices, hands)
    children, streams = np.empty((4, 3), np.int64), keys(key, 0, 4)
    deal(streams, np.tile([0, 2, 3], (4, 1)), np.tile([3, 1, 0], (4, 1)), 5, children)
    return [cells, hands, children]


def choices_practiced(key):
    rng, streams, n_pairs = np.random.default_rng(1), keys(key, 0, 5), 6
    asked = rng.integers(-3, 2 * n_pairs, (7, 2, 2, 4)).astype(np.int32)
    joint_cells = rng.integers(0, 3, (7, 2, 4)).astype(np.int32)
    credit, weight, sums, counts = np.zeros((4, n_pairs))
    critic, visits = np.zeros((2, 3))
    credit_backwards(
        asked, joint_cells, rng.normal(size=(7, 2, 4)), np.array([7.0, 3.0, 5.0]), critic, visits, sums, counts,
        0.9, 0.6,
    )  # fmt: skip
    size = learn_values(credit, weight, sums, counts)
    given_cells, first_pairs = np.array([OPEN_CELL, 1, OPEN_CELL], np.uint8), np.array([0, 3, 5, 6])
    tables = perturbed_tables(credit, weight, first_pairs, given_cells, size, streams, marks(n_pairs))
    return [critic, visits, credit, weight, tables, rates_between(0.01, 0.5, streams)]


def everything():
    """Results of all compiled functions, floats as hexadecimal digits."""
    culture = Culture(np.array([[0, 1], [1, 0], [2, 0]]), np.array([-5.0, -1.0, 5.0]))
    results = structures_learned()
    for key in KEYS:
        results += [
            *pools_bred(key),
            *designs_drawn(key),
            *choices_practiced(key),
            members(key, [np.zeros(4), np.zeros(3)], 10),
            draw_memes(key, culture, 10, 0.7),
        ]
    return [result.astype("<f8").tobytes().hex() for result in results]


def test_compiled_and_plain_results_are_the_same_bits():
    places = [Path(bbsd.__file__).parents[1], Path(__file__).parents[3]]
    environment = os.environ | {"NUMBA_DISABLE_JIT": "1", "PYTHONPATH": os.pathsep.join(map(str, places))}
    plain = subprocess.run(
        [sys.executable, "-W", "error", __file__], env=environment, capture_output=True, text=True, check=True
    )
    assert json.loads(plain.stdout) == everything()


if __name__ == "__main__":
    json.dump(everything(), sys.stdout)
