from keyword import iskeyword

import pytest

from bbsd.expression.reserved import RESERVED, Use, another_name
from bbsd.expression.syntax.parsing import parse
from bbsd.expression.syntax.tree import Name
from bbsd.expression.vocabulary import AGGREGATES, DRAWS, FUNCTIONS, PARTITIONS, WORDS
from bbsd.language.field_types import is_value_name


@pytest.mark.parametrize(
    "word", sorted({*FUNCTIONS, *AGGREGATES, *DRAWS, *PARTITIONS, "range", "before", "no", "on"})
)
def test_what_needs_brackets_or_means_nothing_in_expressions_is_free_for_values(word: str) -> None:
    assert is_value_name(word)
    assert isinstance(parse(word), Name)


def test_functions_of_numbers_may_be_defined_anew_and_nothing_else_that_is_called() -> None:
    assert RESERVED[Use.FUNCTION].keys().isdisjoint(FUNCTIONS)
    assert {*AGGREGATES, *DRAWS, *PARTITIONS, "range", "before"} <= RESERVED[Use.FUNCTION].keys()


def test_what_is_taken_means_something_or_could_not_be_read() -> None:
    for taken in RESERVED.values():
        assert all(word in WORDS or iskeyword(word) for word in taken)
        assert all(taken.values())


def test_what_is_advised_instead_is_free_everywhere() -> None:
    for taken in RESERVED.values():
        assert not any(another_name(word) in other for word in taken for other in RESERVED.values())
