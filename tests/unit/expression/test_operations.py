import pytest

from bbsd.expression.operations import (
    BINDING,
    BY_AGGREGATE,
    BY_WORD,
    COMPARISONS,
    EXPENSIVE,
    MIRRORED,
    OPERATIONS,
)
from bbsd.expression.vocabulary import AGGREGATES, FUNCTIONS


@pytest.mark.parametrize("name", [name for name, function in FUNCTIONS.items() if function.operation])
def test_every_function_of_the_language_is_an_operation(name):
    operation = OPERATIONS[FUNCTIONS[name].operation]
    assert operation.word == name
    assert operation.is_expensive is FUNCTIONS[name].is_expensive
    assert operation.wholeness is FUNCTIONS[name].wholeness
    assert BY_WORD[name] == FUNCTIONS[name].operation


def test_no_word_means_two_operations():
    words = [operation.word for operation in OPERATIONS.values() if operation.word]
    assert len(words) == len(set(words)) == len(BY_WORD)


def test_aggregates_join_by_an_operation_that_is_done_from_left_to_right():
    assert BY_AGGREGATE == {"any": "|", "all": "&", "sum": "+", "min": "minimum", "max": "maximum"}
    assert BY_AGGREGATE.keys() <= AGGREGATES.keys()


def test_comparisons_bind_least_of_all_operators():
    assert {BINDING[comparison] for comparison in COMPARISONS} == {min(BINDING.values())}


@pytest.mark.parametrize("comparison", MIRRORED)
@pytest.mark.parametrize(("left", "right"), [(1, 2), (2, 1), (1, 1)])
def test_mirrored_comparisons_say_the_same_of_exchanged_operands(comparison, left, right):
    mirrored = OPERATIONS[MIRRORED[comparison]].compute
    assert OPERATIONS[comparison].compute(left, right) == mirrored(right, left)


def test_what_takes_long_has_a_line_of_its_own_in_kernels():
    assert {"sin", "atan2", "exp", "power"} <= EXPENSIVE
    assert EXPENSIVE.isdisjoint({"sqrt", "floor", "whole_power", "+", "select"})
