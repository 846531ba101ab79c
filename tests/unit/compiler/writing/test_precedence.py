import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.compiler.writing.precedence import (
    ATOM,
    COMPARISON,
    grouped,
    infix,
    number_text,
    sum_of,
    times,
)
from bbsd.expression.operations import BINDING

A, B, C = (("a", ATOM), ("b", ATOM), ("c", ATOM))


def test_what_binds_less_tightly_stands_in_parentheses():
    comparison = infix("<", A, B)
    assert comparison == ("a < b", COMPARISON)
    assert grouped(comparison, COMPARISON) == "a < b"
    assert grouped(comparison, ATOM) == "(a < b)"
    assert infix("<", comparison, C)[0] == "(a < b) < c"
    assert infix("!=", A, comparison)[0] == "a != (a < b)"
    assert infix("&", comparison, comparison)[0] == "(a < b) & (a < b)"


TEXTS = st.recursive(
    st.sampled_from([(str(number), ATOM) for number in range(1, 9)]),
    lambda texts: st.builds(infix, st.sampled_from(["&", "*", "+", "-", "|"]), texts, texts),
    max_leaves=8,
)


@given(st.sampled_from(["&", "*", "+", "-", "|"]), TEXTS, TEXTS)
def test_parentheses_keep_what_a_text_means(operation, left, right):
    text, _ = infix(operation, left, right)
    assert eval(text) == eval(f"({left[0]}) {operation} ({right[0]})")


def test_sums_leave_zeros_out():
    zero = ("0", ATOM)
    assert sum_of([zero, A, zero, times(3, B)]) == ("a + 3 * b", BINDING["+"])
    assert sum_of([A]) == A
    assert sum_of([zero, zero]) == zero


def test_multiples():
    assert [times(factor, A)[0] for factor in (0, 1, 2)] == ["0", "a", "2 * a"]
    assert times(2, infix("+", A, B))[0] == "2 * (a + b)"


@pytest.mark.parametrize("value", [0.0, -0.0, 0.1, -1e300, 5e-324, math.inf, -math.inf, math.nan])
def test_numbers_are_read_back(value):
    text, _ = number_text(value)
    read = eval(text, {"np": math})
    assert math.copysign(1, read) == math.copysign(1, value)
    assert read == value or math.isnan(read) is math.isnan(value) is True
