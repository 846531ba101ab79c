import numpy as np
import pytest

from bbsd.environments.spaces.kinds import Box, Discrete, Mapping, MultiDiscrete, Several
from bbsd.environments.spaces.reading import MOST_TABULATED, WrongObservationError, digits, reader_of
from bbsd.language.outside import Field

NUMBERS = Box((2, 2), (0.0,) * 4, (9.0,) * 4, "float32")


def fields(*names, **sized):
    return (*map(Field, names), *(Field(name, size) for name, size in sized.items()))


def read(observation, space, *told):
    return list(reader_of(told, space)(observation))


def test_an_array_is_read_in_c_order():
    assert read(np.array([[1, 2], [3, 4]]), NUMBERS, *fields("a", "b", "c", "d")) == [1.0, 2.0, 3.0, 4.0]


def test_without_those_that_are_not_used():
    assert read(np.array([[1, 2], [3, 4]]), NUMBERS, *fields("_", "b", "_", "d")) == [2.0, 4.0]


def test_an_array_of_another_shape_is_refused():
    with pytest.raises(WrongObservationError, match=r"the shape \(4,\), not \(2, 2\)"):
        read(np.zeros(4), NUMBERS, *fields("a", "b", "c", "d"))


def test_one_number_may_have_one_name():
    assert read(7, Discrete(9), *fields("place")) == [7.0]


def test_a_number_is_taken_apart_as_taxi_packs_it():
    gymnasium = pytest.importorskip("gymnasium")
    taxi = gymnasium.make("Taxi-v4").unwrapped
    told = fields(row=5, column=5, passenger=5, goal=4)
    for state in range(500):
        assert read(state, Discrete(500), *told) == list(map(float, taxi.decode(state)))


def test_sizes_count_from_the_start():
    assert read(12, Discrete(6, start=10), *fields(a=2, b=3)) == [0.0, 2.0]


@pytest.mark.parametrize("wrong", [-1, 6, 2.5])
def test_a_number_that_is_not_in_the_space_is_refused(wrong):
    with pytest.raises(WrongObservationError, match="is not in Discrete"):
        read(wrong, Discrete(6), *fields(a=2, b=3))


def test_large_numbers_are_taken_apart_without_a_table():
    sizes = {"a": 1000, "b": 1000}
    assert MOST_TABULATED < 1000 * 1000
    assert read(123_456, Discrete(1_000_000), *fields(**sizes)) == [123.0, 456.0]


def test_digits_are_the_inverse_of_packing():
    assert digits(((3 * 5 + 4) * 7) + 6, (9, 5, 7)) == (3, 4, 6)


def test_several_whole_numbers_have_their_own_sizes():
    space = MultiDiscrete((3, 4), (0, 0), (2,))
    assert read(np.array([2, 3]), space, *fields(a=3, b=4)) == [2.0, 3.0]
    assert read((2, 3), Several((Discrete(3), Discrete(4))), *fields(a=3, b=4)) == [2.0, 3.0]


@pytest.mark.parametrize("wrong", [3, -1, 0.5])
def test_those_are_kept_to(wrong):
    """The proofs of the language rely on them."""
    with pytest.raises(WrongObservationError, match="number 1 of an observation"):
        read(np.array([wrong, 0]), MultiDiscrete((3, 4), (0, 0), (2,)), *fields(a=3, b=4))


def test_paths_lead_through_mappings_tuples_and_arrays():
    space = Mapping((("a", Several((Discrete(2), NUMBERS))), ("n", Discrete(3))))
    told = (
        Field("x", path=("a", 1, 1, 0)),
        Field("_", path=("n",)),
        Field("y", path=("n",)),
        Field("z", path=("a", 0)),
    )
    assert read({"a": (1, np.array([[1, 2], [3, 4]])), "n": 2}, space, *told) == [3.0, 2.0, 1.0]


def test_what_has_parts_may_be_read_as_a_list():
    space = Several((Discrete(32), Discrete(11), Discrete(2)))
    assert read((14, 10, 1), space, *fields("own", "shown", "ace")) == [14.0, 10.0, 1.0]


def test_values_that_are_not_finite_are_read_as_they_are():
    assert read(np.array([np.inf, -np.inf]), Box((2,), (0.0,) * 2, (1.0,) * 2, "f8"), *fields("a", "b")) == [
        np.inf,
        -np.inf,
    ]
