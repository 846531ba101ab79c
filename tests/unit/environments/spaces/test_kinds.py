import numpy as np
import pytest

from bbsd.environments.spaces.kinds import (
    Box,
    Discrete,
    Mapping,
    MultiDiscrete,
    Other,
    Several,
    count,
    leaves,
    path_text,
    space_of,
    space_of_value,
)
from bbsd.language.outside import read_path

spaces = pytest.importorskip("gymnasium").spaces


def test_spaces_of_gymnasium_become_plain_data():
    assert space_of(spaces.Discrete(5, start=2)) == Discrete(5, 2)
    box = spaces.Box(np.float32([[0, -np.inf]]), np.float32([[1, np.inf]]), dtype=np.float32)
    assert space_of(box) == Box((1, 2), (0.0, -np.inf), (1.0, np.inf), "float32")
    assert space_of(spaces.MultiDiscrete([2, 3])) == MultiDiscrete((2, 3), (0, 0), (2,))
    assert space_of(spaces.MultiDiscrete([[2], [3]], start=[[1], [4]])) == MultiDiscrete(
        (2, 3), (1, 4), (2, 1)
    )
    assert space_of(spaces.MultiBinary((2, 2))) == MultiDiscrete((2,) * 4, (0,) * 4, (2, 2), "int8")
    assert space_of(spaces.Text(5)) == Other("Text")


def test_so_do_those_that_have_parts():
    space = spaces.Dict({"b": spaces.Discrete(2), "a": spaces.Tuple([spaces.Discrete(3), spaces.Text(2)])})
    plain = space_of(space)
    assert set(plain.parts) == {("a", Several((Discrete(3), Other("Text")))), ("b", Discrete(2))}
    assert count(plain) is None
    assert count(space_of(spaces.Dict({"a": spaces.Discrete(2), "b": spaces.Box(0, 1, (2, 3))}))) == 7


def test_they_are_written_as_gymnasium_writes_them():
    assert str(space_of(spaces.Discrete(5))) == str(spaces.Discrete(5))
    assert str(space_of(spaces.MultiBinary(3))) == str(spaces.MultiBinary(3))
    assert str(space_of(spaces.MultiDiscrete([2, 3]))) == "MultiDiscrete([2, 3])"
    assert (
        str(Box((8,), tuple(range(8)), (9.0,) * 8, "float32"))
        == "Box([0, 1, 2, 3, 4, 5, ...], 9, (8,), float32)"
    )


def test_what_an_observation_suggests_has_no_bounds():
    assert space_of_value(3.5) == Box((), (-np.inf,), (np.inf,), "float64")
    assert space_of_value([1, 2]).shape == (2,)
    assert space_of_value((1.0, 2.0)).shape == (2,)
    assert space_of_value((np.zeros(2), np.zeros(3))).parts[1].shape == (3,)
    assert space_of_value({"a": 1, "b": "text"}).parts[1] == ("b", Other("str"))


def test_leaves_have_paths():
    space = Mapping(
        (("a", Several((Discrete(2), Discrete(3)))), ("b", Box((2,), (0.0,) * 2, (1.0,) * 2, "float32")))
    )
    found = list(leaves(space))
    assert found[:2] == [(("a", 0), Discrete(2)), (("a", 1), Discrete(3))]
    assert [path for path, _ in found] == [("a", 0), ("a", 1), ("b",)]


@pytest.mark.parametrize("text", ["a", "image[3,5,0]", "[0]", "a.b[2].c", "[1,2]"])
def test_paths_are_written_as_they_are_read(text):
    assert path_text(read_path(text)) == text
