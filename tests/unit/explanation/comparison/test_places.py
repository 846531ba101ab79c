import numpy as np
import pytest

from bbsd.explanation.comparison import places as module
from bbsd.explanation.comparison.places import Places, boxes_of, inside, places

DIMENSIONS = {"near": ("false", "true"), "pace": ("0", "1", "2")}


def situations(*rows):
    return np.array(rows, np.int64).reshape(-1, len(rows[0]))


def where(cells, which, visits=None):
    visits = np.ones(len(cells), np.int64) if visits is None else np.array(visits)
    return places(cells, np.array(which, np.bool_), visits, DIMENSIONS)


def test_only_what_tells_situations_apart_is_named():
    cells = situations((0, 0), (0, 1), (1, 0))
    assert where(cells, [0, 0, 1]) == Places(("near",), 0)
    assert where(cells, [0, 1, 0]) == Places(("pace is 1",), 0)
    assert where(cells, [1, 0, 0]) == Places(("not near and pace is 0",), 0)


def test_what_is_all_that_was_met_is_everywhere():
    assert where(situations((0, 0), (1, 2)), [1, 1]) == Places(("",), 0)


def test_the_most_visited_comes_first():
    cells = situations((0, 0), (0, 1), (1, 0), (1, 1))
    assert where(cells, [1, 0, 0, 1], [1, 9, 9, 5]).where == ("near and pace is 1", "not near and pace is 0")


def test_one_condition_serves_for_several_situations():
    cells = situations((0, 0), (0, 1), (1, 1), (1, 2))
    assert where(cells, [1, 0, 0, 1]).where == ("pace is not 1",)


def test_what_too_few_conditions_leave_is_counted(monkeypatch):
    monkeypatch.setattr(module, "MOST", 1)
    cells = situations((0, 0), (0, 1), (1, 0), (1, 1), (1, 1))
    assert where(cells, [1, 0, 0, 1, 1], [9, 1, 1, 1, 1]) == Places(("not near and pace is 0",), 1)


def test_without_inputs_there_is_one_place():
    assert places(np.zeros((1, 0), np.int64), np.array([True]), np.array([3]), {}) == Places(("",), 0)
    assert places(np.zeros((1, 0), np.int64), np.array([False]), np.array([3]), {}) == Places((), 0)


@pytest.mark.parametrize("seed", range(60))
def test_boxes_hold_all_that_is_meant_and_nothing_else_that_was_met(seed, monkeypatch):
    monkeypatch.setattr(module, "MOST", 1000)
    rng = np.random.default_rng(seed)
    sizes = rng.integers(2, 5, rng.integers(1, 6)).tolist()
    cells = np.stack(np.unravel_index(np.arange(np.prod(sizes)), sizes), axis=1)
    cells = cells[rng.permutation(len(cells))[: max(1, len(cells) // 2)]]
    which = rng.random(len(cells)) < 0.4
    boxes = boxes_of(cells, which, rng.integers(1, 100, len(cells)), sizes)
    held = np.any([inside(box, cells) for box in boxes], axis=0) if boxes else np.zeros(len(cells), np.bool_)
    assert np.array_equal(held, which)
    assert len(boxes) <= which.sum()
    for box in boxes:  # each has something of its own, and names no cell in vain
        assert all(set(own) <= set(cells[which & inside(box, cells), at].tolist()) or len(own) == sizes[at]
                   for at, own in enumerate(box))  # fmt: skip
