from collections import Counter

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.kernel.streams import fold
from bbsd.solver.draws import below, marks, shuffle

WORDS = st.integers(0, 2**64 - 1)


def dealt(key, n_cards, n_dealt):
    cards = np.arange(n_cards)
    shuffle(np.uint64(key), cards, n_dealt, marks(n_dealt))
    return cards


@pytest.mark.parametrize(
    ("bits", "n", "expected"),
    [
        (0, 7, 0),
        (2**64 - 1, 7, 6),
        (2**63, 10, 5),  # half of 10
        (2**62, 10, 2),  # a quarter of 10 is 2.5
        (2**64 - 1, 1, 0),
    ],
)
def test_below_takes_the_upper_bits_as_a_fraction_of_n(bits, n, expected):
    assert below(np.uint64(bits), n) == expected


@given(WORDS, st.integers(1, 2**31))
def test_below_stays_below(bits, n):
    assert 0 <= below(np.uint64(bits), n) < n


@given(WORDS, st.integers(1, 12), st.data())
def test_shuffling_keeps_every_card(key, n_cards, data):
    n_dealt = data.draw(st.integers(0, n_cards))
    assert sorted(dealt(key, n_cards, n_dealt)) == list(range(n_cards))


def test_what_is_dealt_first_does_not_depend_on_how_many_are_dealt():
    for key in range(50):
        np.testing.assert_array_equal(dealt(key, 9, 9)[:4], dealt(key, 9, 4)[:4])


def test_all_ordered_selections_are_equally_likely():
    n = 24_000
    counts = Counter(tuple(dealt(fold(1, key), 4, 3)[:3]) for key in range(n))
    # 4 * 3 * 2 = 24 selections, 1000 expected of each, standard deviation 31
    assert len(counts) == 24
    assert all(abs(count - 1000) < 5 * 31 for count in counts.values())
