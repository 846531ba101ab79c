import numpy as np
import pytest

from bbsd.compiler.tables import TableShape, packed_tables, unpacked_tables


def shape(n_cells, n_actions, given=None):
    return TableShape("b", n_cells, n_actions, np.array(given or [255] * n_cells, np.uint8))


@pytest.mark.parametrize(
    ("n_cells", "n_actions", "bits", "packed"),
    [(64, 1, 1, True), (65, 1, 1, False), (32, 2, 2, True), (32, 3, 2, True), (33, 3, 2, False), (8, 200, 8, True)],
)  # fmt: skip
def test_a_table_fits_into_a_word_of_64_bits_or_not(n_cells, n_actions, bits, packed):
    layout = shape(n_cells, n_actions)
    assert (layout.bits, layout.mask, layout.packed) == (bits, 2**bits - 1, packed)


def test_only_open_cells_are_searched():
    layout = shape(4, 9, [255, 0, 3, 255])
    assert layout.n_open == 2
    assert layout.decades == 2  # 10 x 10 tables


@pytest.mark.parametrize("n_actions", [1, 2, 3, 7, 200])
def test_words_hold_every_cell(n_actions):
    layout = shape(64 // n_actions.bit_length(), n_actions)
    pool = np.random.default_rng(0).integers(0, n_actions + 1, (5, layout.n_cells), dtype=np.uint8)
    pool[0] = n_actions  # every bit of the word may be set, that of the sign too
    [words] = packed_tables([layout], [pool])
    read = [
        [int(word) >> cell * layout.bits & layout.mask for cell in range(layout.n_cells)] for word in words
    ]
    np.testing.assert_array_equal(read, pool)


def test_words_of_small_pools_are_padded_and_large_tables_have_none():
    small, large = shape(2, 1), shape(65, 1)
    pools = [np.array([[1, 1]], np.uint8), np.ones((3, 65), np.uint8)]
    np.testing.assert_array_equal(packed_tables([small, large], pools), [[3, 0, 0], [0, 0, 0]])


def test_cells_of_large_tables_stand_one_after_the_other():
    small, large, larger = shape(2, 1), shape(65, 1), shape(70, 2)
    pools = [np.ones((1, 2), np.uint8), np.full((2, 65), 1, np.uint8), np.full((2, 70), 2, np.uint8)]
    cells, offsets = unpacked_tables([small, large, larger], pools)
    assert offsets.tolist() == [0, 0, 130]
    assert cells[:-1].tolist() == [1] * 130 + [2] * 140


def test_without_large_tables_there_is_still_an_array():
    cells, offsets = unpacked_tables([shape(2, 1)], [np.ones((1, 2), np.uint8)])
    assert (cells.size, offsets.tolist()) == (1, [0])
