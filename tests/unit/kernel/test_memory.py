"""A kernel's working memory is the same for compiled code as for plain Python."""

import numpy as np
import pytest

from bbsd.kernel.memory import CACHE_LINE, zeros
from bbsd.kernel.modules import load_kernel

SOURCE = """
from bbsd.kernel.memory import as_integers, as_words, part

def fill(numbers, lengths, first, size):
    view = part(numbers, first, size)
    of_view = part(view, 1, size - 1)
    lengths[0] = len(view)
    lengths[1] = len(of_view)
    for index in range(len(view)):
        view[index] = index + 1.5
    for index in range(len(of_view)):
        of_view[index] = -of_view[index]
    words = as_words(view)
    words[0] = 1 << 63
    integers = as_integers(of_view)
    integers[1] = -1
    lengths[2] = len(words)
    lengths[3] = len(integers)
    lengths[4] = integers[1]
    lengths[5] = words[2] >> 63
"""


@pytest.mark.parametrize("compiled", [False, True], ids=["plain", "compiled"])
def test_views_are_of_the_same_memory(compiled, tmp_path, monkeypatch):
    monkeypatch.setenv("BBSD_CACHE_DIR", str(tmp_path))
    kernel = load_kernel(SOURCE, "memory", ("fill",), compiled)
    numbers, lengths = zeros(7), np.zeros(6, np.int64)
    kernel.fill(numbers, lengths, 2, 4)
    assert np.array_equal(numbers, [0, 0, -0.0, -2.5, np.nan, -4.5, 0], equal_nan=True)
    assert np.signbit(numbers).tolist() == [False, False, True, True, True, True, False]
    assert lengths.tolist() == [4, 3, 4, 3, -1, 1]


@pytest.mark.parametrize("size", [1, 7, 8, 1000])
def test_memory_begins_with_a_line_of_the_cache(size):
    for _ in range(10):
        numbers = zeros(size)
        assert numbers.shape == (size,)
        assert not numbers.any()
        assert numbers.__array_interface__["data"][0] % CACHE_LINE == 0
