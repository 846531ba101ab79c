import pytest
from hypothesis import given
from hypothesis import strategies as st

from bbsd.expression.syntax.mistakes import ExpressionError, Mistake
from bbsd.expression.syntax.parsing import MAX_DEPTH, MAX_LENGTH, parse
from bbsd.expression.syntax.tree import (
    Binary,
    Call,
    Comparison,
    Conditional,
    Generator,
    Index,
    Logical,
    Name,
    Number,
    Span,
    Unary,
)


def refused(text: str) -> Mistake:
    with pytest.raises(ExpressionError) as caught:
        parse(text)
    return caught.value.mistake


@pytest.mark.slow
@given(st.one_of(st.text(), st.text("abx01 .()[]+-*/%<>=!&|^~,:'\"#\\{}@;ifornot\n\t", max_size=40)))
def test_any_text_is_read_or_refused(text: str) -> None:
    try:
        parse(text)
    except ExpressionError as error:
        start, length = error.mistake.span
        assert 0 <= start <= len(text)
        assert length >= 1


def test_operators_bind_as_in_python() -> None:
    tree = parse("-a ** 2 + b * c < d and not e or f")
    assert isinstance(tree, Logical)
    assert tree.operator == "or"
    conjunction = tree.operands[0]
    assert isinstance(conjunction, Logical)
    comparison, negation = conjunction.operands
    assert isinstance(comparison, Comparison)
    assert isinstance(negation, Unary)
    total = comparison.operands[0]
    assert isinstance(total, Binary)
    assert isinstance(total.left, Unary)  # the sign is outside of the power


def test_spans_count_characters_of_the_text_as_it_is() -> None:
    tree = parse("  a +\n  max(b, c)")
    assert isinstance(tree, Binary)
    assert tree.right == Call("max", (Name("b", Span(12, 1)), Name("c", Span(15, 1))), Span(8, 9))


def test_chained_comparisons_keep_all_operands() -> None:
    tree = parse("1 < a <= 2")
    assert isinstance(tree, Comparison)
    assert tree.operators == ("<", "<=")
    assert len(tree.operands) == 3


def test_conditionals_indices_and_generators() -> None:
    assert isinstance(parse("a if b else c"), Conditional)
    assert isinstance(parse("a[1][b]"), Index)
    tree = parse("sum(a * x for x, y in table)")
    assert isinstance(tree, Call)
    (each,) = tree.arguments
    assert isinstance(each, Generator)
    assert each.names == ("x", "y")


@pytest.mark.parametrize(("text", "value"), [("3", 3.0), ("1e-3", 0.001), ("0.5", 0.5), ("1_000", 1000.0)])
def test_numbers(text: str, value: float) -> None:
    tree = parse(text)
    assert isinstance(tree, Number)
    assert tree.value == value


@pytest.mark.parametrize(
    "text",
    [
        "a.b",
        "[1, 2]",
        "(1, 2)",
        "{1}",
        "{a: 1}",
        "lambda: 1",
        "a[1:2]",
        "'a'",
        "f'{a}'",
        "1j",
        "a := 1",
        "(a := 1)",
        "*a",
    ],
)
def test_what_python_has_and_the_language_does_not(text: str) -> None:
    assert refused(text).code in {"BB050", "BB051"}


@pytest.mark.parametrize(
    ("text", "part"),
    [("a + B", "B"), ("a in b", "a in b"), ("a is b", "a is b"), ("a + (b @ c)", "@"), ("x(1)(2)", "x(1)(2)"),
     ("f(a=1)", "f(a=1)"), ("a + True", "True"), ("1 + 1e999", "1e999"), ("a << 2", "<<"),
     ("(a) ^ (b)", "^"), ("1 + ~a", "~")],
)  # fmt: skip
def test_what_is_refused_is_marked(text: str, part: str) -> None:
    mistake = refused(text)
    assert mistake.code == "BB051"
    assert text[mistake.span.start :][: mistake.span.length] == part


@pytest.mark.parametrize(
    "text", ["any(a for a in b if a)", "any(a for a in b for c in d)", "any(a for a[0] in b)", "sum(a for a, a in b)",
             "sum(step for step in team)", "(a for a in b)"],
)  # fmt: skip
def test_generators_have_one_for_new_names_and_no_filter(text: str) -> None:
    assert refused(text).code == "BB062"


@pytest.mark.parametrize(
    ("text", "advice"),
    [
        ("a if b", "a conditional has three parts: x if ... else y"),
        ("class > 3", "class cannot be a name in expressions"),
        ("a = 3", "equality is written =="),
    ],
)
def test_what_cannot_be_read_gets_advice(text: str, advice: str) -> None:
    mistake = refused(text)
    assert mistake.code == "BB050"
    assert mistake.advice == advice


def test_an_argument_by_name_was_meant_as_a_comparison() -> None:
    assert refused("abs(a=1)").advice == "equality is written =="


@pytest.mark.parametrize("text", ["", "  ", "\n", "a # b", "ä", "a\x00", "a\u00a0+ b", "\\"])
def test_what_is_no_expression_at_all(text: str) -> None:
    assert refused(text).code == "BB050"


@pytest.mark.parametrize(
    "text", ["-" * 3000 + "1", "(" * 150 + "1" + ")" * 150 + "+ a" * 50, "not " * 900 + "a"]
)
def test_nothing_is_too_deep_to_be_refused(text: str) -> None:
    assert refused(text).code in {"BB050", "BB060"}


def test_bounds_of_depth_and_length() -> None:
    parse("-" * MAX_DEPTH + "a")
    assert refused("-" * (MAX_DEPTH + 1) + "a").code == "BB060"
    parse("a" * MAX_LENGTH)
    assert refused("a" * (MAX_LENGTH + 1)).code == "BB060"
