from collections import Counter

import numpy as np
import pytest

from bbsd.architecture import joint_space
from bbsd.architecture.deciding import cells_at, excited_at
from bbsd.compiler import compile_meaning
from bbsd.evaluation import situations as module
from bbsd.evaluation import trace
from bbsd.evaluation.situations import TooLongToWatch, counted, situations
from bbsd.evaluation.streams import evaluation_keys
from tests.unit.architecture.designs import meaning_of, random_architecture
from tests.unit.problems import RICH


@pytest.mark.parametrize("seed", range(3))
def test_situations_are_those_of_the_traces(seed):
    meaning = meaning_of(RICH)
    problem, space = compile_meaning(meaning, compiled=False, lanes=3), joint_space(meaning)
    design, streams = random_architecture(meaning, seed), evaluation_keys(seed, 5)
    found = situations(problem, space, design, streams, 1)
    in_traces, in_situations = Counter(), Counter()
    for key in streams.tolist():
        decisions = trace(problem, design, key, 1).decisions
        perceived = np.concatenate([decisions.cells, decisions.excited], axis=-1)
        in_traces.update(map(tuple, perceived.reshape(-1, perceived.shape[-1]).tolist()))
    behaviors = range(problem.n_behaviors)
    cells = [cells_at(space, behavior, found.cells) for behavior in behaviors]
    excited = [excited_at(space, behavior, found.cells) for behavior in behaviors]
    for row, visits in zip(np.stack([*cells, *excited], axis=1).tolist(), found.visits.tolist(), strict=True):
        in_situations[tuple(row)] += visits
    assert in_situations == in_traces
    assert found.steps == in_traces.total()
    assert found.episodes == 5


def test_rows_are_counted_once_each_in_any_space():
    rows = np.array([[1, 0], [0, 2], [1, 0], [0, 2], [1, 0]])
    for sizes in ((2, 3), (2**40, 2**40)):
        cells, visits = counted(rows, sizes)
        assert cells.tolist() == [[0, 2], [1, 0]]
        assert visits.tolist() == [2, 3]
    assert counted(rows, (2, 3), np.array([1, 1, 5, 1, 1]))[1].tolist() == [2, 7]


def test_behaviors_without_inputs_meet_one_situation():
    cells, visits = counted(np.zeros((7, 0), np.int64), ())
    assert (cells.shape, visits.tolist()) == ((1, 0), [7])


def test_an_episode_that_memory_cannot_hold_is_refused(monkeypatch):
    monkeypatch.setattr(module, "MOST_NUMBERS", 10)
    meaning = meaning_of(RICH)
    problem = compile_meaning(meaning, compiled=False)
    with pytest.raises(TooLongToWatch):
        situations(problem, joint_space(meaning), random_architecture(meaning, 0), evaluation_keys(0, 1), 1)
