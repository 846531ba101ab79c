import numpy as np

from bbsd.kernel.keys import folded, keys, own_keys, units
from bbsd.kernel.streams import fold, unit

KEYS = [0, 1, 2**63, 2**64 - 1]


def test_keys_of_many_streams_are_those_of_each():
    for key in KEYS:
        found = keys(key, 3, 5)
        assert found.dtype == np.uint64
        assert found.tolist() == [fold(key, word) for word in range(3, 8)]


def test_parts_of_a_range_of_keys_are_the_keys_of_its_parts():
    np.testing.assert_array_equal(np.concatenate([keys(7, 0, 4), keys(7, 4, 3)]), keys(7, 0, 7))


def test_each_owner_has_keys_of_its_own():
    found = own_keys(7, 3, 4)
    assert found.shape == (3, 4)
    np.testing.assert_array_equal(found.ravel(), keys(7, 0, 12))


def test_no_keys():
    assert keys(7, 5, 0).tolist() == []


def test_a_word_is_folded_into_each_stream():
    streams = np.array(KEYS, np.uint64)
    for word in KEYS:
        found = folded(streams, word)
        assert found.dtype == np.uint64
        assert found.tolist() == [fold(key, word) for key in KEYS]


def test_units_are_those_of_each_stream():
    assert units(np.array(KEYS, np.uint64)).tolist() == [unit(key) for key in KEYS]
