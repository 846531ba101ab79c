import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.compiler.writing.precedence import (
    ATOM,
    COMPARISON,
    Text,
    call,
    grouped,
    infix,
    join,
    name_text,
    number_text,
    sum_of,
    times,
)
from bbsd.expression.operations import BINDING

A, B, C = map(name_text, "abc")


def test_what_binds_less_tightly_stands_in_parentheses():
    comparison = infix("<", A, B)
    assert comparison == ("a < b", COMPARISON, {"a", "b"}, False)
    assert grouped(comparison, COMPARISON) == "a < b"
    assert grouped(comparison, ATOM) == "(a < b)"
    assert infix("<", comparison, C)[0] == "(a < b) < c"
    assert infix("!=", A, comparison)[0] == "a != (a < b)"
    assert infix("&", comparison, comparison)[0] == "(a < b) & (a < b)"


TEXTS = st.recursive(
    st.sampled_from([Text(str(number)) for number in range(1, 9)]),
    lambda texts: st.builds(infix, st.sampled_from(["&", "*", "+", "-", "|"]), texts, texts),
    max_leaves=8,
)


@given(st.sampled_from(["&", "*", "+", "-", "|"]), TEXTS, TEXTS)
def test_parentheses_keep_what_a_text_means(operation, left, right):
    source = infix(operation, left, right).source
    assert eval(source) == eval(f"({left.source}) {operation} ({right.source})")


def test_sums_leave_zeros_out():
    zero = Text("0")
    assert sum_of([zero, A, zero, times(3, B)]) == ("a + 3 * b", BINDING["+"], {"a", "b"}, False)
    assert sum_of([A]) == A
    assert sum_of([zero, zero]) == zero


def test_a_text_knows_the_names_that_it_uses():
    both = call("minimum", [infix("+", A, times(2, B)), Text("x[lane]"), A])
    assert both == ("minimum(a + 2 * b, x[lane], a)", ATOM, {"a", "b"}, False)
    assert join("&", [A, B, C]).uses == {"a", "b", "c"}
    assert number_text(math.inf).uses == frozenset()


@pytest.mark.parametrize(("function", "expensive"), [("atan", True), ("normal", True), ("floor", False)])
def test_a_text_is_expensive_if_anything_in_it_is(function, expensive):
    inner = call(function, [A])
    assert [text.expensive for text in (inner, infix("<", B, inner), call("floor", [B, inner]))] == [
        expensive
    ] * 3


def test_multiples():
    assert [times(factor, A)[0] for factor in (0, 1, 2)] == ["0", "a", "2 * a"]
    assert times(2, infix("+", A, B))[0] == "2 * (a + b)"


@pytest.mark.parametrize("value", [0.0, -0.0, 0.1, -1e300, 5e-324, math.inf, -math.inf, math.nan])
def test_numbers_are_read_back(value):
    read = eval(number_text(value).source, {"np": math})
    assert math.copysign(1, read) == math.copysign(1, value)
    assert read == value or math.isnan(read) is math.isnan(value) is True
