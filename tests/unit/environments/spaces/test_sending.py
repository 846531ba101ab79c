import numpy as np
import pytest

from bbsd.environments.spaces.kinds import Box, Discrete, Mapping, MultiDiscrete, Other, Several
from bbsd.environments.spaces.sending import WrongValueError, n_sent, sender_of, taken_text, takes

TENTH = float(np.float32(0.1))
UNIT = Box((2,), (-TENTH, 0.0), (TENTH, 1.0), "float32")


def refused(space, *values):
    with pytest.raises(WrongValueError) as error:
        sender_of(space, len(values))(values)
    return error.value.index, error.value.value, error.value.taken


def test_a_whole_number_is_sent_as_one():
    sent = sender_of(Discrete(3, start=1), 1)([3.0])
    assert sent == 3
    assert isinstance(sent, int)


@pytest.mark.parametrize("value", [0.0, 4.0, 1.5, float("nan"), float("inf"), -float("inf")])
def test_any_other_is_refused_and_never_rounded(value):
    index, given, taken = refused(Discrete(3, start=1), value)
    assert (index, str(given)) == (0, str(value))
    assert taken == "a whole number from 1 to 3"


def test_an_array_is_sent_in_its_own_type():
    sent = sender_of(UNIT, 2)([0.1, 0.5])
    assert sent.dtype == np.float32
    assert sent.shape == (2,)


def test_bounds_are_those_of_the_type_in_which_it_is_sent():
    """0.1 in float32 is more than 0.1."""
    assert TENTH > 0.1
    assert takes(UNIT, 0, 0.1)
    assert takes(UNIT, 0, TENTH)
    assert not takes(UNIT, 0, 0.1001)


@pytest.mark.parametrize(("values", "index"), [((0.2, 0.5), 0), ((0.0, -0.5), 1), ((0.0, float("nan")), 1)])
def test_what_is_outside_of_it_is_refused(values, index):
    assert refused(UNIT, *values)[0] == index


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 1e39])
def test_what_is_not_finite_is_refused_even_without_bounds(value):
    refused(Box((1,), (-np.inf,), (np.inf,), "float32"), value)


def test_an_array_of_whole_numbers_takes_whole_ones():
    space = Box((1,), (0.0,), (255.0,), "uint8")
    assert sender_of(space, 1)([7.0]).dtype == np.uint8
    assert refused(space, 7.5)[2] == "a whole number from 0 to 255"


def test_shapes_are_kept():
    assert sender_of(Box((2, 2), (0.0,) * 4, (1.0,) * 4, "float64"), 4)([0, 1, 0, 1]).tolist() == [
        [0, 1],
        [0, 1],
    ]
    assert sender_of(Box((), (0.0,), (1.0,), "float64"), 1)([0.5]).shape == ()
    assert sender_of(MultiDiscrete((3, 4), (0, 5), (1, 2)), 2)([2.0, 8.0]).tolist() == [[2, 8]]
    assert refused(MultiDiscrete((3, 4), (0, 5), (2,)), 2.0, 4.0) == (1, 4.0, "a whole number from 5 to 8")


def test_several_numbers_are_sent_as_a_tuple():
    space = Several((Discrete(2), Box((1,), (0.0,), (1.0,), "float32")))
    first, second = sender_of(space, 2)([1.0, 0.5])
    assert (first, second.tolist()) == (1, [0.5])
    assert refused(space, 1.0, 1.5) == (1, 1.5, "a number from 0 to 1")


def test_where_no_space_is_named_values_are_floats():
    assert sender_of(None, 1)([2.0]) == 2.0
    assert sender_of(None, 2)([2.0, 3.0]).dtype == np.float64


def test_how_many_values_are_sent():
    assert n_sent(None) is None
    assert n_sent(Discrete(2)) == 1
    assert n_sent(Box((2, 3), (0.0,) * 6, (1.0,) * 6, "float32")) == 6
    assert n_sent(MultiDiscrete((2, 2), (0, 0), (2,))) == 2
    assert n_sent(Several((Discrete(2), Discrete(2)))) == 2
    assert n_sent(Several((UNIT, UNIT))) == 0
    assert n_sent(Mapping((("a", Discrete(2)),))) == 0
    assert n_sent(Other("Text")) == 0


def test_a_choice_of_one_is_said_as_such():
    assert taken_text(Discrete(1, start=4), 0) == "4 alone"
