import pytest

from bbsd.expression.forms import kind_by_form
from bbsd.expression.kinds import Kind
from bbsd.expression.syntax.parsing import parse


@pytest.mark.parametrize("text", ["1", "a + b", "-a", "+a", "degrees(a)", "sum(a)", "argmin(x for x in a)"])
def test_numbers(text: str) -> None:
    assert kind_by_form(parse(text)) is Kind.NUMBER


@pytest.mark.parametrize("text", ["true", "a < b", "a and b", "not a", "any(a)"])
def test_truths(text: str) -> None:
    assert kind_by_form(parse(text)) is Kind.TRUTH


@pytest.mark.parametrize("text", ["a", "a[0]", "a if b else c", "list(a)", "max(a)", "own(a)"])
def test_what_depends_on_the_parts(text: str) -> None:
    assert kind_by_form(parse(text)) is Kind.UNKNOWN
