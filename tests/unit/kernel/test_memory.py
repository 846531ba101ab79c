"""A kernel's working memory is the same for compiled code as for plain Python."""

import numpy as np
import pytest

from bbsd.kernel.modules import load_kernel

SOURCE = """
from bbsd.kernel.memory import as_integers, as_words, part, zeros

def filled(size, first, of_part):
    numbers = zeros(size)
    view = part(numbers, first, of_part)
    of_view = part(view, 1, of_part - 1)
    for index in range(len(view)):
        view[index] = index + 1.5
    for index in range(len(of_view)):
        of_view[index] = -of_view[index]
    words = as_words(view)
    words[0] = 1 << 63
    as_integers(of_view)[1] = -1
    return numbers, view, of_view, words, as_integers(view)

def outliving(size):
    return part(part(zeros(size), 1, size - 1), 1, size - 2)
"""


@pytest.fixture(params=[False, True], ids=["plain", "compiled"])
def kernel(request, tmp_path, monkeypatch):
    monkeypatch.setenv("BBSD_CACHE_DIR", str(tmp_path))
    return load_kernel(SOURCE, "memory", ("filled", "outliving"), request.param)


def test_views_are_of_the_same_memory(kernel):
    numbers, view, of_view, words, integers = kernel.filled(7, 2, 4)
    expected = np.array([0, 0, -0.0, -2.5, np.nan, -4.5, 0])
    assert np.array_equal(numbers, expected, equal_nan=True)
    assert np.signbit(numbers).tolist() == [False, False, True, True, True, True, False]
    assert [len(each) for each in (numbers, view, of_view, words, integers)] == [7, 4, 3, 4, 4]
    assert [each.dtype.str[1:] for each in (view, words, integers)] == ["f8", "u8", "i8"]
    assert integers[2] == -1
    assert words[2] == 2**64 - 1
    assert all(np.shares_memory(numbers, each) for each in (view, of_view, words, integers))


def test_a_view_keeps_its_memory(kernel):
    views = [kernel.outliving(1000) for _ in range(200)]
    for number, view in enumerate(views):
        view[:] = number
    assert [set(view.tolist()) for view in views] == [{number} for number in range(200)]
