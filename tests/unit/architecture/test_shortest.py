"""Shortest rules, against the table itself and against a search that knows nothing of groups, masks or levels."""

from itertools import chain, combinations, product
from math import prod

import numpy as np
import pytest

from bbsd.architecture.boxes import FREE, KEEP, first_match, n_words
from bbsd.architecture.shortest import MOST_DECIDED, rule_list, shortest_cover, unordered_cover


def random_table(number, most_inputs=5, largest=5, most_cells=None, lowest=FREE):
    """A table of two to five inputs, of one kind or another: with many free cells, few decisions, or structure."""
    rng = np.random.default_rng(number)
    while True:
        sizes = [int(rng.integers(2, largest)) for _ in range(rng.integers(2, most_inputs + 1))]
        if most_cells is None or prod(sizes) <= most_cells:
            break
    n_cells, n_values = prod(sizes), int(rng.integers(1, 4))
    values = rng.integers(0, n_values + 1, n_cells)
    if rng.random() < 0.5:  # as a designer's: a few rules
        values = np.zeros(n_cells, np.int64)
        for _ in range(rng.integers(1, 5)):
            box = [rng.random(size) < 0.6 for size in sizes]
            values.reshape(sizes)[np.ix_(*(np.flatnonzero(each) for each in box))] = rng.integers(
                0, n_values + 1
            )
    free = rng.random(n_cells) < rng.choice([0, 0.2, 0.6])
    return np.where(free, FREE, values), sizes


def words(boxes, sizes):
    return sum(n_words(box, sizes) for box, _ in boxes)


def assert_equal_to_table(values, sizes, boxes):
    found = first_match([box for box, _ in boxes], sizes)
    decided = np.array([value for _, value in boxes])[found]
    assert np.array_equal(decided[values >= 0], values[values >= 0])
    assert (found >= 0).all()


def all_boxes(sizes):
    """All boxes of a table as (words, cells)."""
    subsets = [
        list(chain.from_iterable(combinations(range(size), count) for count in range(1, size + 1)))
        for size in sizes
    ]
    cells = np.arange(prod(sizes)).reshape(sizes)
    return [
        (
            1 + sum(len(part) for part, size in zip(box, sizes, strict=True) if len(part) < size),
            frozenset(cells[np.ix_(*box)].ravel().tolist()),
        )
        for box in product(*subsets)
    ]


def fewest_words(values, sizes, most):
    """The fewest words of any list of rules, by trying all of fewer than `most` words; `most` if there is none."""
    boxes = all_boxes(sizes)
    known = {}

    def least(undecided, allowed):
        if not undecided:
            return 0
        if allowed < 1:
            return 99
        if known.get(undecided, (0, 99))[0] >= allowed:
            return known[undecided][1]
        found = 99
        for cost, cells in boxes:
            decided = undecided & cells
            if cost <= min(allowed, found - 1) and len({int(values[cell]) for cell in decided}) == 1:
                found = min(found, cost + least(undecided - decided, min(allowed, found - 1) - cost))
        known[undecided] = allowed, found
        return found

    return min(most, max(1, least(frozenset(np.flatnonzero(values >= 0).tolist()), most - 1)))


@pytest.mark.parametrize("number", range(150))
def test_rules_say_what_the_table_says_wherever_it_counts(number):
    values, sizes = random_table(number)
    assert_equal_to_table(values, sizes, rule_list(values, sizes).boxes)


@pytest.mark.parametrize("number", range(60))
def test_no_list_is_shorter_than_the_shortest(number):
    values, sizes = random_table(number, 3, 4, most_cells=8)
    found = rule_list(values, sizes)
    assert found.is_shortest
    assert fewest_words(values, sizes, words(found.boxes, sizes)) == words(found.boxes, sizes)


def assert_tables_are_explained(count):
    """Hold rules against their tables, and those of small tables, which are half of them, against all other lists."""
    n_exact = 0
    for number in range(count):
        is_small = number % 2 == 0
        values, sizes = random_table(number, 4, 4, 8) if is_small else random_table(number)
        found = rule_list(values, sizes)
        assert_equal_to_table(values, sizes, found.boxes)
        n_exact += found.is_shortest
        if is_small:
            assert found.is_shortest
            assert fewest_words(values, sizes, words(found.boxes, sizes)) == words(found.boxes, sizes)
    assert n_exact > 0.6 * count


@pytest.mark.slow
def test_many_tables():
    # python -m tests.unit.architecture.test_shortest does so with 10,000, which takes minutes
    assert_tables_are_explained(300)


@pytest.mark.parametrize("number", range(40))
def test_a_cover_leaves_what_no_box_may_hold(number):
    values, sizes = random_table(number, 3, 4)
    values = np.where(values == 0, KEEP, values)
    boxes = shortest_cover(values, sizes).boxes
    found = first_match([box for box, _ in boxes], sizes)
    assert (found[values == KEEP] == -1).all()
    decided = np.array([*(value for _, value in boxes), KEEP])[found]
    assert np.array_equal(decided[values >= 0], values[values >= 0])


@pytest.mark.parametrize("number", range(30))
def test_an_unordered_cover_says_the_same_in_any_order(number):
    values, sizes = random_table(number, 4, 5)
    values = np.where(values == 0, KEEP, values)
    boxes = unordered_cover(values, sizes)
    for order in (boxes, boxes[::-1]):
        found = first_match([box for box, _ in order], sizes)
        decided = np.array([*(value for _, value in order), KEEP])[found]
        assert np.array_equal(decided[values >= 0], values[values >= 0])
        assert (found[values == KEEP] == -1).all()


def test_rules_that_say_nothing_come_last_where_that_is_as_short():
    assert rule_list(np.array([0, 1]), [2]).boxes == [(((1,),), 1), (((0, 1),), 0)]


def test_cells_that_rules_need_not_tell_apart_count_once():
    values = np.zeros((40, 2), np.int64)
    values[7:9] = 1
    found = rule_list(values.ravel(), [40, 2])
    assert found.is_shortest
    assert found.boxes[0] == (((7, 8), (0, 1)), 1)


def test_free_cells_make_rules_shorter():
    # The greedy writer begins with the largest box; a shortest list may begin with a smaller one.
    assert rule_list(np.array([1, FREE, FREE, 0]), [2, 2]).boxes[-1] == (((0, 1), (0, 1)), 0)
    assert rule_list(np.array([FREE] * 4), [2, 2]).boxes == [(((0, 1), (0, 1)), 0)]


def test_a_large_table_is_covered_greedily():
    values = np.random.default_rng(0).integers(0, 3, 5**3)
    found = rule_list(values, [5, 5, 5])
    assert not found.is_shortest
    assert_equal_to_table(values, [5, 5, 5], found.boxes)
    assert len(values) > MOST_DECIDED


def test_the_search_gives_up_in_time(monkeypatch):
    values, sizes = np.random.default_rng(0).integers(0, 3, 16), [4, 4]
    shortest = rule_list(values, sizes)
    monkeypatch.setattr("bbsd.architecture.shortest.MOST_WORK", 10)
    greedy = rule_list(values, sizes)
    assert (shortest.is_shortest, greedy.is_shortest) == (True, False)
    assert words(shortest.boxes, sizes) <= words(greedy.boxes, sizes)


def test_a_table_without_inputs_is_one_rule():
    assert rule_list(np.array([2]), []).boxes == [((), 2)]


def test_one_decision_for_all_cells_is_the_shortest_however_many_there_are():
    sizes = [30, 40]
    found = rule_list(np.where(np.arange(1200) % 7, 2, FREE), sizes)
    assert found == ([((tuple(range(30)), tuple(range(40))), 2)], True)


if __name__ == "__main__":
    assert_tables_are_explained(10_000)
