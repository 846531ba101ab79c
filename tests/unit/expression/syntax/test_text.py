from dataclasses import fields
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.expression.syntax.parsing import MAX_DEPTH, parse
from bbsd.expression.syntax.text import number_text, render
from bbsd.expression.syntax.tree import (
    Binary,
    Call,
    Comparison,
    Conditional,
    Expr,
    Generator,
    Index,
    Logical,
    Name,
    Number,
    Span,
    Truth,
    Unary,
)

NOWHERE = Span(0, 0)
NAMES = st.sampled_from(["a", "b", "height", "x_1"])
LEAVES = st.one_of(
    st.floats(0, allow_infinity=False, allow_nan=False).map(lambda value: Number(value, NOWHERE)),
    st.booleans().map(lambda value: Truth(value, NOWHERE)),
    NAMES.map(lambda name: Name(name, NOWHERE)),
)


def _larger(parts: st.SearchStrategy[Expr]) -> st.SearchStrategy[Expr]:
    some = st.lists(parts, min_size=1, max_size=3).map(tuple)
    return st.one_of(
        st.builds(Unary, st.sampled_from(["-", "+", "not"]), parts, st.just(NOWHERE)),
        st.builds(
            Binary, st.sampled_from(["+", "-", "*", "/", "//", "%", "**"]), parts, parts, st.just(NOWHERE)
        ),
        st.builds(Conditional, parts, parts, parts, st.just(NOWHERE)),
        st.builds(Call, NAMES, some, st.just(NOWHERE)),
        st.builds(Index, parts, parts, st.just(NOWHERE)),
        st.tuples(st.sampled_from(["and", "or"]), st.lists(parts, min_size=2, max_size=3)).map(
            lambda found: Logical(found[0], tuple(found[1]), NOWHERE)
        ),
        st.lists(
            st.tuples(st.sampled_from(["<", "<=", ">", ">=", "==", "!="]), parts), min_size=2, max_size=3
        ).map(
            lambda found: Comparison(
                tuple(symbol for symbol, _ in found[1:]), tuple(part for _, part in found), NOWHERE
            )
        ),
        st.tuples(parts, parts).map(
            lambda found: Call("sum", (Generator(found[0], ("v", "w"), found[1], NOWHERE),), NOWHERE)
        ),
    )


TREES = st.recursive(LEAVES, _larger, max_leaves=12)


@given(TREES)
def test_a_rendered_tree_reads_as_itself(tree: Expr) -> None:
    text = render(tree)
    again = parse(text)
    assert render(again) == text
    assert _without_spans(again) == _without_spans(tree)


def _without_spans(tree: Any) -> Any:
    if isinstance(tree, Span):
        return None
    if isinstance(tree, tuple):
        return [_without_spans(item) for item in tree]
    if isinstance(tree, str | float | bool):
        return tree
    return [type(tree), *(_without_spans(getattr(tree, each.name)) for each in fields(tree))]


@pytest.mark.parametrize(
    ("text", "rendered"),
    [("((a))+(b*c)", "a + b * c"), ("(a+b)*c", "(a + b) * c"), ("a-(b-c)", "a - (b - c)"), ("a-b-c", "a - b - c"),
     ("(-a)**2", "(-a) ** 2"), ("-a**2", "-a ** 2"), ("2**(-b)", "2 ** -b"), ("not (a<b)", "not a < b"),
     ("(not a) == b", "(not a) == b"), ("(a or b) and c", "(a or b) and c"), ("1.50", "1.5"), ("300.0", "300"),
     ("(a if b else c) if d else e", "(a if b else c) if d else e"), ("max( a,b )", "max(a, b)"),
     ("sum(x for x in list(1,2))", "sum(x for x in list(1, 2))")],
)  # fmt: skip
def test_parentheses_stand_where_they_are_needed(text: str, rendered: str) -> None:
    assert render(parse(text)) == rendered


@pytest.mark.parametrize(("value", "text"), [(3.0, "3"), (-0.5, "-0.5"), (1e300, "1e+300"), (1e-7, "1e-07")])
def test_numbers_are_as_short_as_they_can_be(value: float, text: str) -> None:
    assert number_text(value) == text
    assert float(text) == value


def test_what_was_as_deep_as_allowed_is_so_when_rendered() -> None:
    text = "-" * MAX_DEPTH + "a"
    assert render(parse(text)) == text
